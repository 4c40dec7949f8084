#pragma once
// The kernels of fronts, generic in the pack. Every entry sums its products in the order of the pivots, whatever the
// tile it is computed in.
#include <algorithm>
#include <cstring>
#include <heml/dynamics/front_kernels.hpp>
#include <heml/math/pack.hpp>

namespace heml {
namespace {  // internal linkage: not merged with code for other processors

/// P: a pack of doubles. A tile of tile_strips × tile_columns is kept in registers.
template <class P, std::size_t tile_strips, std::size_t tile_columns>
struct FrontCode {
  static constexpr std::size_t packs = strip_rows / P::lanes;
  static constexpr std::size_t max_chunk = 256;  ///< pivots whose part of a strip stays in the first-level cache

  [[gnu::always_inline]] static inline P load(const double* from) {
    P p;
    std::memcpy(&p.v, from, sizeof(p.v));
    return p;
  }
  [[gnu::always_inline]] static inline void store(P p, double* to) { std::memcpy(to, &p.v, sizeof(p.v)); }

  /// c −= a bᵀ of strips of rows and columns. a: count columns, strips a_stride apart. b: a strip of count columns.
  template <std::size_t strips, std::size_t columns>
  [[gnu::always_inline]] static inline void multiply(const double* a, std::size_t a_stride, const double* b,
                                                     std::size_t count, double* const* c) {
    P sum[strips][packs][columns];
    for (std::size_t s = 0; s < strips; ++s)
      for (std::size_t j = 0; j < columns; ++j)
        for (std::size_t p = 0; p < packs; ++p) sum[s][p][j] = load(c[s] + strip_rows * j + P::lanes * p);
    for (std::size_t k = 0; k < count; ++k) {
      P left[strips][packs];
      for (std::size_t s = 0; s < strips; ++s)
        for (std::size_t p = 0; p < packs; ++p) left[s][p] = load(a + s * a_stride + strip_rows * k + P::lanes * p);
      for (std::size_t j = 0; j < columns; ++j) {
        const P right = b[strip_rows * k + j];
        for (std::size_t s = 0; s < strips; ++s)
          for (std::size_t p = 0; p < packs; ++p) sum[s][p][j] -= left[s][p] * right;
      }
    }
    for (std::size_t s = 0; s < strips; ++s)
      for (std::size_t j = 0; j < columns; ++j)
        for (std::size_t p = 0; p < packs; ++p) store(sum[s][p][j], c[s] + strip_rows * j + P::lanes * p);
  }

  /// The same of whole 8×8 blocks.
  template <std::size_t strips>
  static void multiply_blocks(const double* a, std::size_t a_stride, const double* b, std::size_t count,
                              double* const* c) {
    double* at[strips];
    for (std::size_t j = 0; j + tile_columns <= strip_rows; j += tile_columns) {
      for (std::size_t s = 0; s < strips; ++s) at[s] = c[s] + strip_rows * j;
      multiply<strips, tile_columns>(a, a_stride, b + j, count, at);
    }
    constexpr std::size_t rest = strip_rows % tile_columns, first = strip_rows - rest;
    if constexpr (rest > 0) {
      for (std::size_t s = 0; s < strips; ++s) at[s] = c[s] + strip_rows * first;
      multiply<strips, rest>(a, a_stride, b + first, count, at);
    }
  }

  /// Subtracts the products of pivots [from, to) from the blocks of rows and columns at or below the diagonal. rows,
  /// columns: strips of the panel. block(row, column): the place of an 8×8 block.
  template <class Block>
  static void subtract_products(const Front& f, StripRange rows, StripRange columns, std::size_t from, std::size_t to,
                                const Block& block) {
    constexpr std::size_t group = 8 / tile_strips * tile_strips;  // strips whose chunk of L stays in the cache
    const std::size_t size = f.strip_size();
    for (; from < to; from += std::min(max_chunk, to - from)) {
      const std::size_t count = std::min(max_chunk, to - from);
      for (std::size_t first = rows.first; first < rows.last; first += group) {
        const std::size_t last = std::min(first + group, rows.last);
        for (std::size_t column = columns.first; column < std::min(columns.last, last); ++column) {
          const double* b = f.scaled + column * size + strip_rows * from;
          std::size_t row = std::max(first, column);
          for (; row + tile_strips <= last; row += tile_strips) {
            double* c[tile_strips];
            for (std::size_t t = 0; t < tile_strips; ++t) c[t] = block(row + t, column);
            multiply_blocks<tile_strips>(f.panel + row * size + strip_rows * from, size, b, count, c);
          }
          for (; row < last; ++row) {
            double* c = block(row, column);
            multiply_blocks<1>(f.panel + row * size + strip_rows * from, size, b, count, &c);
          }
        }
      }
    }
  }

  static void reduce(const Front& f, StripRange columns, StripRange rows) {
    subtract_products(f, rows, columns, 0, strip_rows * columns.first, [&](std::size_t row, std::size_t column) {
      return f.panel + row * f.strip_size() + strip_rows * strip_rows * column;
    });
  }

  static void subtract(const Front& f, StripRange rows) {
    const std::size_t above = f.pivot_strips;
    subtract_products(f, {above + rows.first, above + rows.last}, {above, f.strips()}, 0, f.pivots,
                      [&](std::size_t row, std::size_t column) {
                        return f.update + triangle_size(row - above) + strip_rows * strip_rows * (column - above);
                      });
  }

  static void factor_diagonal(const Front& f, std::size_t from, std::size_t strip) {
    const std::size_t done = strip_rows * strip, count = std::min(strip_rows, f.pivots - done);
    double* block = f.panel + strip * f.strip_size() + strip_rows * done;
    subtract_products(f, {strip, strip + 1}, {strip, strip + 1}, strip_rows * from, done,
                      [&](std::size_t, std::size_t) { return block; });
    for (std::size_t c = 0; c < count; ++c) {
      double* column = block + strip_rows * c;
      const double d = column[c], inverse = 1 / d;
      f.pivot[done + c] = d;
      double before[strip_rows];
      std::copy_n(column, strip_rows, before);
      for (std::size_t r = 0; r < strip_rows; ++r) column[r] *= inverse;
      for (std::size_t next = c + 1; next < count; ++next)
        for (std::size_t r = 0; r < strip_rows; ++r) block[strip_rows * next + r] -= before[r] * column[next];
    }
  }

  /// Of one strip whose earlier pivots are eliminated: the triangular solve with the diagonal block.
  static void solve_below(const Front& f, std::size_t strip, const double* inverse, std::size_t below) {
    const std::size_t done = strip_rows * strip;
    const double* block = f.panel + strip * f.strip_size() + strip_rows * done;
    double* row = f.panel + below * f.strip_size() + strip_rows * done;
    double* scaled = f.scaled + below * f.strip_size() + strip_rows * done;
    P x[strip_rows][packs];
    for (std::size_t c = 0; c < strip_rows; ++c) {
      for (std::size_t p = 0; p < packs; ++p) x[c][p] = load(row + strip_rows * c + P::lanes * p);
      for (std::size_t d = 0; d < c; ++d) {
        const P l = block[strip_rows * d + c];
        for (std::size_t p = 0; p < packs; ++p) x[c][p] -= x[d][p] * l;
      }
      for (std::size_t p = 0; p < packs; ++p) {
        store(x[c][p], scaled + strip_rows * c + P::lanes * p);
        store(x[c][p] * P(inverse[c]), row + strip_rows * c + P::lanes * p);
      }
    }
  }

  static void factor_below(const Front& f, std::size_t from, std::size_t strip, StripRange rows) {
    const std::size_t done = strip_rows * strip;
    double inverse[strip_rows] = {};
    for (std::size_t c = 0; c < std::min(strip_rows, f.pivots - done); ++c) inverse[c] = 1 / f.pivot[done + c];
    for (std::size_t first = rows.first; first < rows.last; first += tile_strips) {
      const StripRange tile{first, std::min(first + tile_strips, rows.last)};
      subtract_products(f, tile, {strip, strip + 1}, strip_rows * from, done, [&](std::size_t row, std::size_t) {
        return f.panel + row * f.strip_size() + strip_rows * done;
      });
      for (std::size_t row = tile.first; row < tile.last; ++row) solve_below(f, strip, inverse, row);
    }
  }

  static void subtract_product(const double* row, const double* x, std::size_t count, double* z) {
    P sum[packs];
    for (std::size_t p = 0; p < packs; ++p) sum[p] = load(z + P::lanes * p);
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t p = 0; p < packs; ++p) sum[p] -= load(row + strip_rows * k + P::lanes * p) * P(x[k]);
    for (std::size_t p = 0; p < packs; ++p) store(sum[p], z + P::lanes * p);
  }

  static void forward(const Front& f, double* z) {
    for (std::size_t s = 0; s < f.strips(); ++s) {
      const double* row = f.panel + s * f.strip_size();
      const std::size_t done = strip_rows * s;
      subtract_product(row, z, std::min(done, f.pivots), z + done);
      if (s >= f.pivot_strips) continue;
      const double* block = row + strip_rows * done;
      for (std::size_t c = 0; c < std::min(strip_rows, f.pivots - done); ++c)
        for (std::size_t r = c + 1; r < strip_rows; ++r) z[done + r] -= block[strip_rows * c + r] * z[done + c];
    }
  }

  static void backward(const Front& f, double* z) {
    constexpr std::size_t columns = 4;
    for (std::size_t s = f.pivot_strips; s-- > 0;) {
      const std::size_t done = strip_rows * s;
      for (std::size_t first = 0; first < strip_rows; first += columns) {
        P sum[columns][packs];
        for (auto& column : sum) std::fill_n(column, packs, P(0));
        for (std::size_t below = s + 1; below < f.strips(); ++below) {
          const double* block = f.panel + below * f.strip_size() + strip_rows * (done + first);
          for (std::size_t p = 0; p < packs; ++p) {
            const P right = load(z + strip_rows * below + P::lanes * p);
            for (std::size_t c = 0; c < columns; ++c) sum[c][p] += load(block + strip_rows * c + P::lanes * p) * right;
          }
        }
        for (std::size_t c = 0; c < columns; ++c)
          for (std::size_t p = 0; p < packs; ++p)
            for (int lane = 0; lane < P::lanes; ++lane) z[done + first + c] -= sum[c][p].v[lane];
      }
      const double* block = f.panel + s * f.strip_size() + strip_rows * done;
      for (std::size_t c = std::min(strip_rows, f.pivots - done); c-- > 0;)
        for (std::size_t r = c + 1; r < strip_rows; ++r) z[done + c] -= block[strip_rows * c + r] * z[done + r];
    }
  }

  static constexpr FrontKernels kernels = {reduce, factor_diagonal, factor_below, subtract, forward, backward};
};

}  // namespace
}  // namespace heml
