#pragma once
// Four numbers of each lane of a pack, such as the coordinates of a node of the element in that lane: read from where
// each lane has them, and written back. For files compiled for one instruction set.
//
//   lanes         0 1 2 3 | 4 5 6 7 | ...         a part: four lanes, whose sixteen numbers are transposed
//   in memory     x y z · of lane 0, of lane 1, ...
//   in registers  x of all lanes, y of all, z of all, · of all
#include <cstring>
#include <heml/elastic/four.hpp>
#include <heml/math/pack.hpp>

namespace heml {
namespace {  // internal linkage: not merged with code for other processors

template <class P>
struct FoursOfLanes {
  using Real = Lane<P>;
  using Vector = typename P::Vector;
  using Part = Four<Real>;
  static constexpr std::size_t lanes = P::lanes, parts = lanes / 4;
  static_assert(parts == 1 || parts == 2 || parts == 4);

  /// from(lane): where the four numbers of a lane begin.
  template <class From>
  [[gnu::always_inline]] static inline void read(const From& from, P (&packs)[4]) {
    Vector rows[4];
#pragma GCC unroll 4
    for (std::size_t l = 0; l < 4; ++l) {
      Part row[parts];
#pragma GCC unroll 4
      for (std::size_t k = 0; k < parts; ++k) row[k] = read_four(from(4 * k + l));
      rows[l] = side_by_side(row);
    }
    transpose_parts(rows);
#pragma GCC unroll 4
    for (std::size_t i = 0; i < 4; ++i) packs[i].v = rows[i];
  }

  /// The same where each lane's follow those of the lane before.
  [[gnu::always_inline]] static inline void read(const Real* values, P (&packs)[4]) {
    if constexpr (parts == 2) {  // a tenth of a kernel in double
      const auto a = pack_at(values).v, b = pack_at(values + 8).v, c = pack_at(values + 16).v,
                 d = pack_at(values + 24).v;
      const auto ab01 = __builtin_shufflevector(a, b, 0, 4, 8, 12, 1, 5, 9, 13);
      const auto ab23 = __builtin_shufflevector(a, b, 2, 6, 10, 14, 3, 7, 11, 15);
      const auto cd01 = __builtin_shufflevector(c, d, 0, 4, 8, 12, 1, 5, 9, 13);
      const auto cd23 = __builtin_shufflevector(c, d, 2, 6, 10, 14, 3, 7, 11, 15);
      packs[0].v = __builtin_shufflevector(ab01, cd01, 0, 1, 2, 3, 8, 9, 10, 11);
      packs[1].v = __builtin_shufflevector(ab01, cd01, 4, 5, 6, 7, 12, 13, 14, 15);
      packs[2].v = __builtin_shufflevector(ab23, cd23, 0, 1, 2, 3, 8, 9, 10, 11);
      packs[3].v = __builtin_shufflevector(ab23, cd23, 4, 5, 6, 7, 12, 13, 14, 15);
    } else {
      read([values](std::size_t lane) { return values + 4 * lane; }, packs);
    }
  }

  /// The four numbers of lane 4 k + l begin at to[l][4 k].
  [[gnu::always_inline]] static inline void write(const P (&packs)[4], Real (&to)[4][lanes]) {
    Vector rows[4] = {packs[0].v, packs[1].v, packs[2].v, packs[3].v};
    transpose_parts(rows);
#pragma GCC unroll 4
    for (std::size_t l = 0; l < 4; ++l) std::memcpy(to[l], &rows[l], sizeof rows[l]);
  }

  [[gnu::always_inline]] static inline P pack_at(const Real* values) {
    P p;
    std::memcpy(&p.v, values, sizeof p.v);
    return p;
  }

 private:
  [[gnu::always_inline]] static inline Vector side_by_side(const Part (&row)[parts]) {
    if constexpr (parts == 1) {
      return static_cast<Vector>(row[0]);
    } else if constexpr (parts == 2) {
      return static_cast<Vector>(__builtin_shufflevector(row[0], row[1], 0, 1, 2, 3, 4, 5, 6, 7));
    } else {
      const auto low = __builtin_shufflevector(row[0], row[1], 0, 1, 2, 3, 4, 5, 6, 7);
      const auto high = __builtin_shufflevector(row[2], row[3], 0, 1, 2, 3, 4, 5, 6, 7);
      return static_cast<Vector>(
          __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
    }
  }

  /// In each part rows[i][j] becomes rows[j][i].
  [[gnu::always_inline]] static inline void transpose_parts(Vector (&rows)[4]) {
    if constexpr (parts == 1) {
      transpose(rows);
    } else {
      Vector even01, odd01, even23, odd23;
      pairs(rows[0], rows[1], even01, odd01);
      pairs(rows[2], rows[3], even23, odd23);
      halves(even01, even23, rows[0], rows[2]);
      halves(odd01, odd23, rows[1], rows[3]);
    }
  }

  [[gnu::always_inline]] static inline void pairs(const Vector& a, const Vector& b, Vector& even, Vector& odd) {
    if constexpr (parts == 2) {
      even = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
      odd = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
    } else {
      even = __builtin_shufflevector(a, b, 0, 16, 2, 18, 4, 20, 6, 22, 8, 24, 10, 26, 12, 28, 14, 30);
      odd = __builtin_shufflevector(a, b, 1, 17, 3, 19, 5, 21, 7, 23, 9, 25, 11, 27, 13, 29, 15, 31);
    }
  }

  [[gnu::always_inline]] static inline void halves(const Vector& a, const Vector& b, Vector& low, Vector& high) {
    if constexpr (parts == 2) {
      low = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
      high = __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
    } else {
      low = __builtin_shufflevector(a, b, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29);
      high = __builtin_shufflevector(a, b, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31);
    }
  }
};

}  // namespace
}  // namespace heml
