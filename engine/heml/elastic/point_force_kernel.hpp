#pragma once
// The point kernel of every law (point_kernels.hpp), for files compiled for one instruction set. Each lane of a pack is
// an element of its own:
//
//   records of nodes ──transposed──► at[10] ──► for each point: virtual corners ──► law ──► forces ──► out[10] ──► back
#include <heml/elastic/fours_of_lanes.hpp>
#include <heml/elastic/point_kernels.hpp>
#include <heml/elastic/tension.hpp>
#include <heml/materials/law_packs.hpp>
#include <heml/materials/laws.hpp>

namespace heml {
namespace {  // internal linkage: not merged with code for other processors

template <class P, class L>
struct PointForceKernel {
  using Real = Lane<P>;
  using Block = PointBlock<Real>;
  using Fours = FoursOfLanes<P>;
  static constexpr std::size_t lanes = P::lanes, parts = Fours::parts, constants = L::uses_I4 ? 10 : 7;
  static constexpr std::size_t max_parameters = std::size(L::parameters);
  static_assert(max_parameters <= max_point_parameters);

  /// Quantities of the elements in the lanes.
  struct Elements {
    const std::uint16_t* index[lanes];
    const Real* constant[constants];  ///< A, V, then m: of 4 points an element, [element][point]
    const Real* parameter[max_parameters];  ///< that differ between elements, likewise
    P at[10][3];                      ///< positions relative to the first node
    P shared[4][3];                   ///< what corner i of every point shares (quadratic_map.hpp)
  };

  [[gnu::always_inline]] static inline void read_positions(const Real* records, Elements& of) {
    for (std::size_t a = 0; a < 10; ++a) {
      P place[4];
      Fours::read([&](std::size_t lane) { return records + of.index[lane][a]; }, place);
#pragma GCC unroll 3
      for (std::size_t i = 0; i < 3; ++i) of.at[a][i] = a == 0 ? place[i] : place[i] - of.at[0][i];
    }
#pragma GCC unroll 3
    for (std::size_t i = 0; i < 3; ++i) of.at[0][i] = P(0);
    constexpr Real of_corner = corner_weight, of_midedge = midedge_weight;
#pragma GCC unroll 4
    for (std::size_t c = 0; c < 4; ++c)
#pragma GCC unroll 3
      for (std::size_t i = 0; i < 3; ++i) {
        P midedges(0);
#pragma GCC unroll 4
        for (std::size_t d = 0; d < 4; ++d)
          if (d != c) midedges += of.at[node_between[c][d]][i];
        of.shared[c][i] = of_corner * of.at[c][i] + of_midedge * midedges;
      }
  }

  [[gnu::always_inline]] static inline void virtual_corners(const Elements& of, std::size_t q, P (&y)[4][3]) {
    constexpr Real own = own_weight;
#pragma GCC unroll 4
    for (std::size_t c = 0; c < 4; ++c)
#pragma GCC unroll 3
      for (std::size_t i = 0; i < 3; ++i) y[c][i] = of.shared[c][i] + own * of.at[node_between[q][c]][i];
  }

  /// κ̄ (J̄ − 1).
  [[gnu::always_inline]] static inline P mean_pressure(const Elements& of, const RestShape<P> (&rest)[4],
                                                       const P& kappa) {
    P whole(0), deformed(0);
#pragma GCC unroll 1
    for (std::size_t q = 0; q < 4; ++q) {
      P y[4][3];
      virtual_corners(of, q, y);
      whole += rest[q].volume;
      deformed += rest[q].volume * element_kinematics<false, true, false, false>(y[0], y[1], y[2], y[3], rest[q]).at.J;
    }
    return kappa * (deformed / whole - P(1));
  }

  [[gnu::always_inline]] static inline void read_rest(const Elements& of, RestShape<P> (&rest)[4]) {
    for (std::size_t c = 0; c < constants; ++c) {
      P of_point[4];
      Fours::read(of.constant[c], of_point);
#pragma GCC unroll 4
      for (std::size_t q = 0; q < 4; ++q)
        (c < 6 ? rest[q].A[c] : c == 6 ? rest[q].volume : rest[q].fibre[c - 7]).v = of_point[q].v;
    }
  }

  [[gnu::always_inline]] static inline void read_parameters(const Elements& of, std::size_t count,
                                                            P (&value)[max_parameters][4]) {
    for (std::size_t k = 0; k < count; ++k) Fours::read(of.parameter[k], value[k]);
  }

  [[gnu::always_inline]] static inline void add_four(const Real (&of_lane)[10][4][lanes], const Elements& of,
                                                     std::size_t k, std::size_t count, Real* records) {
    for (std::size_t a = 0; a < 10; ++a)
#pragma GCC unroll 4
      for (std::size_t l = 0; l < count; ++l) {
        Real* const force = records + of.index[4 * k + l][a] + 4;
        write_four(read_four(force) + read_four(of_lane[a][l] + 4 * k), force);
      }
  }

  /// Adds what the points pull at the ten nodes to their records, four lanes after the other four: sums do not depend
  /// on the number of lanes.
  [[gnu::always_inline]] static inline void add(const P (&out)[10][3], const Elements& of, std::size_t count,
                                                Real* records) {
    alignas(64) Real of_lane[10][4][lanes];
    for (std::size_t a = 0; a < 10; ++a) {
      const P rows[4] = {out[a][0], out[a][1], out[a][2], P(0)};
      Fours::write(rows, of_lane[a]);
    }
    for (std::size_t k = 0; k < parts && 4 * k < count; ++k)
      if (4 * k + 4 <= count)
        add_four(of_lane, of, k, 4, records);
      else
        add_four(of_lane, of, k, count - 4 * k, records);
  }

  /// Adds the forces of `count` elements, at most one a lane; `of`: their nodes and constants, of every lane.
  /// Parameters that differ are set in the law.
  [[gnu::always_inline]] static inline void add_forces(L& law, const Block& block, Elements& of, const Real* kappa,
                                                       std::size_t count, Mask<P>& valid, Real* records) {
    read_positions(records, of);
    RestShape<P> rest[4];
    read_rest(of, rest);
    P parameter[max_parameters][4];
    read_parameters(of, block.parameters, parameter);
    P pressure(0);
    if constexpr (L::has_volume_term)
      if (kappa) pressure = mean_pressure(of, rest, Fours::pack_at(kappa));
    P out[10][3], sum[4][3];
    for (auto& of_node : out)
      for (P& value : of_node) value = P(0);
    for (auto& of_corner : sum)
      for (P& value : of_corner) value = P(0);
    constexpr Real own = own_weight;
#pragma GCC unroll 1
    for (std::size_t q = 0; q < 4; ++q) {
      P y[4][3], f[12];
      virtual_corners(of, q, y);
      for (std::size_t k = 0; k < block.parameters; ++k)
        law.*L::parameters[block.parameter_at[k]].member = parameter[k][q];
      const ElementKinematics<P> at_point =
          element_kinematics<L::uses_I2, L::uses_J, L::uses_I4, FibreShearLaw<L>>(y[0], y[1], y[2], y[3], rest[q]);
      valid = valid && law.valid(at_point.at);
      Tensions<P> t = tensions(law, at_point, rest[q]);
      if constexpr (L::has_volume_term) t.wJ += pressure;
      forces_from_tensions<L::uses_J>(t, at_point.e, at_point.cross, f);
#pragma GCC unroll 4
      for (std::size_t c = 0; c < 4; ++c)
#pragma GCC unroll 3
        for (std::size_t i = 0; i < 3; ++i) {
          sum[c][i] += f[3 * c + i];
          out[node_between[q][c]][i] += own * f[3 * c + i];
        }
    }
    constexpr Real of_corner = corner_weight, of_midedge = midedge_weight;
#pragma GCC unroll 3
    for (std::size_t i = 0; i < 3; ++i) {
#pragma GCC unroll 4
      for (std::size_t c = 0; c < 4; ++c) {
        out[c][i] += of_corner * sum[c][i];
#pragma GCC unroll 4
        for (std::size_t d = c + 1; d < 4; ++d) out[node_between[c][d]][i] += of_midedge * (sum[c][i] + sum[d][i]);
      }
    }
    add(out, of, count, records);
  }

  /// Begins the records of nodes whose places ascend. It reads four numbers of a node, of the last, which may end the
  /// array, three.
  [[gnu::always_inline]] static inline void read_nodes(const std::uint32_t* place, std::size_t count, const Real* x,
                                                       Real* record) {
#pragma GCC unroll 4
    for (std::size_t n = 0; n < count; ++n, record += 8) {
      write_four(n + 1 < count ? read_four(x + place[n]) : read_three(x + place[n]), record);
      write_four(Four<Real>{}, record + 4);
    }
  }

  static bool run(L law, const Block& block, const Real* x, Real* f) {
    alignas(64) Real records[8 * 10 * max_point_block_elements];
    read_nodes(block.place, block.own, x, records);
    read_nodes(block.place + block.own, block.nodes - block.own, x, records + 8 * block.own);
    Mask<P> valid = true;
    for (std::size_t first = 0; first < block.elements; first += lanes) {
      Elements of;
      const std::size_t left = block.elements - first, count = left < lanes ? left : lanes;
      // Lanes to spare repeat the last element.
      const auto in_lane = [count](std::size_t l) { return l < count ? l : count - 1; };
      for (std::size_t l = 0; l < lanes; ++l) of.index[l] = block.index + 10 * (first + in_lane(l));
      for (std::size_t c = 0; c < constants; ++c)
        of.constant[c] = (c < 6 ? block.A[c] : c == 6 ? block.volume : block.fibre[c - 7]) + 4 * first;
      for (std::size_t k = 0; k < block.parameters; ++k) of.parameter[k] = block.parameter[k] + 4 * first;
      Real last[constants + max_parameters][4 * lanes], kappa[lanes];
      const auto pad = [&](const Real*& values, Real(&padded)[4 * lanes]) {
        for (std::size_t s = 0; s < 4 * lanes; ++s) padded[s] = values[4 * in_lane(s / 4) + s % 4];
        values = padded;
      };
      if (count < lanes) {  // what is read must exist
        for (std::size_t c = 0; c < constants; ++c) pad(of.constant[c], last[c]);
        for (std::size_t k = 0; k < block.parameters; ++k) pad(of.parameter[k], last[constants + k]);
      }
      if (block.kappa)
        for (std::size_t l = 0; l < lanes; ++l) kappa[l] = block.kappa[4 * (first + in_lane(l))];
      add_forces(law, block, of, block.kappa ? kappa : nullptr, count, valid, records);
    }
    for (std::size_t n = 0; n < block.nodes; ++n) {
      Real* const to = n < block.own ? f + block.place[n] : block.shared_force + 3 * (n - block.own);
      for (std::size_t i = 0; i < 3; ++i) to[i] = records[8 * n + 4 + i];
    }
    return L::always_valid || valid.all();
  }
};

/// Kernel of the law with that index in LawList, on packs of `bytes`.
template <class Real, class Family, std::size_t bytes>
PointKernel<Real> point_force_kernel(std::size_t law, bool continued) {
  constexpr int lanes = bytes / sizeof(Real);
  using P = Pack<Real, lanes, Family>;
  PointKernel<Real> kernel = nullptr;
  visit_law(law, continued, [&]<class Tag, bool with>(Tag, std::bool_constant<with>) {
    using One = typename Tag::template Law<Real, with>;
    using Many = typename Tag::template Law<P, with>;
    kernel = [](const void* scalar, const PointBlock<Real>& block, const Real* x, Real* f) {
      return PointForceKernel<P, Many>::run(broadcast<Many, P>(*static_cast<const One*>(scalar)), block, x, f);
    };
  });
  return kernel;
}

}  // namespace
}  // namespace heml
