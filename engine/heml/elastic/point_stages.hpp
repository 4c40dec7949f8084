#pragma once
// The kernel of points (point_kernels.hpp), for files compiled for one instruction set. Each lane of a pack is an
// element of its own. What no law decides is compiled once for each instruction set and scalar:
//
//   records of nodes ──transposed──► at[10] ──► virtual corners, edges, G and J of four points
//     ──► tensions of the law ──► + terms ──► forces at the virtual corners ──► at ten nodes ──► back
//                                 │  ▲
//        next state, kept by ◄────┘  └──── state of the step's beginning
//        ViscoelasticTerm::advance()
#include <heml/elastic/added_volume.hpp>
#include <heml/elastic/deviator_square.hpp>
#include <heml/elastic/fours_of_lanes.hpp>
#include <heml/elastic/point_kernels.hpp>
#include <heml/elastic/remembered_tensions.hpp>

namespace heml {
namespace {  // internal linkage: not merged with code for other processors

/// One point of the elements in the lanes.
template <class P>
struct PackedPoint {
  ElementKinematics<P> of;  ///< edges, G, cross products and J; the rest is the law's
  RestShape<P> rest;
  Tensions<P> t;
};

template <class P>
struct PointStages {
  using Real = Lane<P>;
  using Block = PointBlock<Real>;
  using Terms = PointTerms<Real>;
  using Fours = FoursOfLanes<P>;
  using Point = PackedPoint<P>;
  static constexpr std::size_t lanes = P::lanes, parts = Fours::parts;
  static constexpr std::size_t max_constants = 10;

  /// Quantities of the elements in the lanes.
  struct Elements {
    std::size_t count;  ///< of lanes; those to spare repeat the last element
    const std::uint16_t* index[lanes];
    std::size_t slot[lanes];  ///< the first of its four
    P at[10][3];              ///< positions relative to the first node
    P shared[4][3];           ///< what corner i of every point shares (quadratic_map.hpp)
    Point point[4];
    P parameter[max_point_parameters][4];  ///< that differ between elements, of each point
  };

  /// What a law does: writes the tensions of the points, and whether it is defined there.
  using LawTensions = void (*)(void* law, const Block& block, Elements& of, Mask<P>& valid);
  struct PackedLaw {
    void* law;
    LawTensions tensions;
    bool uses_J, uses_fibre;
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

  /// Reads a number of every slot into the four points.
  [[gnu::always_inline]] static inline void read_slots(const Real* of_slots, const Elements& of, P (&value)[4]) {
    if (of.count == lanes)
      Fours::read(of_slots + of.slot[0], value);
    else  // what is read must exist
      Fours::read([&](std::size_t lane) { return of_slots + of.slot[lane]; }, value);
  }

  [[gnu::always_inline]] static inline void read_rest(const Block& block, bool with_fibre, Elements& of) {
    for (std::size_t c = 0; c < (with_fibre ? max_constants : 7); ++c) {
      P of_point[4];
      read_slots(c < 6 ? block.A[c] : c == 6 ? block.volume : block.fibre[c - 7], of, of_point);
#pragma GCC unroll 4
      for (std::size_t q = 0; q < 4; ++q) {
        RestShape<P>& rest = of.point[q].rest;
        (c < 6 ? rest.A[c] : c == 6 ? rest.volume : rest.fibre[c - 7]).v = of_point[q].v;
      }
    }
    for (std::size_t k = 0; k < block.parameters; ++k) read_slots(block.parameter[k], of, of.parameter[k]);
  }

  template <bool with_J>
  [[gnu::always_inline]] static inline void put_kinematics(Elements& of) {
#pragma GCC unroll 1
    for (std::size_t q = 0; q < 4; ++q) {
      P y[4][3];
      virtual_corners(of, q, y);
      put_edges<with_J>(y[0], y[1], y[2], y[3], of.point[q].rest.volume, of.point[q].of);
    }
  }

  /// Adds κ̄ψ'(J̄) to every wJ.
  static void add_mean_pressure(const Block& block, const Terms& terms, Elements& of, Mask<P>& valid) {
    P kappa[4], whole(0), deformed(0);
    read_slots(block.kappa, of, kappa);
    for (const Point& point : of.point) {
      whole += point.rest.volume;
      deformed += point.rest.volume * point.of.at.J;
    }
    const P pressure =
        kappa[0] * added_volume_derivative(terms.mean_volume, terms.is_continued, deformed / whole, valid);
    for (Point& point : of.point) point.t.wJ += pressure;
  }

  /// Numbers k to k + 5 of each lane's slot of point q.
  [[gnu::always_inline]] static inline void read_six(const Real* state, std::size_t each, const Elements& of,
                                                     std::size_t q, std::size_t k, P (&value)[6]) {
    P low[4], high[4];
    const auto from = [&](std::size_t lane) { return state + each * (of.slot[lane] + q) + k; };
    Fours::read(from, low);
    Fours::read([&](std::size_t lane) { return from(lane) + 2; }, high);
    for (std::size_t i = 0; i < 4; ++i) value[i].v = low[i].v;
    value[4].v = high[2].v, value[5].v = high[3].v;
  }
  [[gnu::always_inline]] static inline void write_six(const P (&value)[6], std::size_t each, const Elements& of,
                                                      std::size_t q, std::size_t k, Real* state) {
    alignas(64) Real low[4][lanes], high[4][lanes];
    Fours::write({value[0], value[1], value[2], value[3]}, low);
    Fours::write({value[2], value[3], value[4], value[5]}, high);
    for (std::size_t lane = 0; lane < of.count; ++lane) {
      Real* const to = state + each * (of.slot[lane] + q) + k;
      write_four(read_four(low[lane % 4] + lane / 4 * 4), to);
      write_four(read_four(high[lane % 4] + lane / 4 * 4), to + 2);
    }
  }

  static void add_viscosity(const Terms& terms, Elements& of) {
    for (std::size_t q = 0; q < 4; ++q) {
      Point& point = of.point[q];
      P dG[6];
      read_six(terms.before, terms.state, of, q, 0, dG);
      write_six(point.of.G, terms.state, of, q, 0, terms.next);
      for (std::size_t i = 0; i < 6; ++i) dG[i] = point.of.G[i] - dG[i];
      add_viscous_tensions<P>(dG, point.rest, terms.eta, terms.zeta, terms.per_step, point.t.T);
    }
  }

  /// T += Σ_branches (decay Q + gain (T − T0)); the next state is Q⁺ = decay Q + gain (T − T0), T0⁺ = T.
  static void add_relaxation(const Terms& terms, Elements& of) {
    const P whole = terms.weight + Real(1);
    for (std::size_t q = 0; q < 4; ++q) {
      Point& point = of.point[q];
      P total[6], before[6], fixed[6];
      put_total_tensions<P>(point.t, point.of.cross, point.of.at.J, point.rest.volume, total);
      read_six(terms.before, terms.state, of, q, 6, before);
      write_six(total, terms.state, of, q, 6, terms.next);
      for (P& value : fixed) value = P(0);
      for (std::size_t b = 0; b < terms.branch_count; ++b) {
        const P decay = terms.branches[b].decay, gain = terms.branches[b].gain;
        P Q[6];
        read_six(terms.before, terms.state, of, q, 12 + 6 * b, Q);
        for (std::size_t i = 0; i < 6; ++i) {
          const P left = decay * Q[i] - gain * before[i];
          fixed[i] += left;
          Q[i] = left + gain * total[i];
        }
        write_six(Q, terms.state, of, q, 12 + 6 * b, terms.next);
      }
      for (std::size_t i = 0; i < 6; ++i) point.t.T[i] = whole * point.t.T[i] + fixed[i];
      point.t.wJ *= whole;
    }
  }

  static void add_volume(const Terms& terms, Elements& of, Mask<P>& valid) {
    P kappa[4] = {terms.kappa, terms.kappa, terms.kappa, terms.kappa};
    if (terms.kappa_of) read_slots(terms.kappa_of, of, kappa);
    for (std::size_t q = 0; q < 4; ++q)
      of.point[q].t.wJ +=
          kappa[q] * added_volume_derivative(terms.volume, terms.is_continued, of.point[q].of.at.J, valid);
  }

  static void add_active(const Terms& terms, Elements& of) {
    for (Point& point : of.point) {
      P mm[6];
      outer3(point.rest.fibre, mm);
      const P scale = terms.active * point.rest.volume;
      for (std::size_t i = 0; i < 6; ++i) point.t.T[i] += scale * mm[i];
    }
  }

  static void put_mises(const Elements& of, Real* mises) {
    P stress[4];
    for (std::size_t q = 0; q < 4; ++q) {
      const Point& point = of.point[q];
      const P per_volume = P(1) / point.rest.volume;
      P T[6];
      for (std::size_t i = 0; i < 6; ++i) T[i] = per_volume * point.t.T[i];
      stress[q] = sqrt(P(1.5) * deviator_square(T, point.of.G));
    }
    alignas(64) Real of_lane[4][lanes];
    Fours::write(stress, of_lane);
    for (std::size_t lane = 0; lane < of.count; ++lane)
      write_four(read_four(of_lane[lane % 4] + lane / 4 * 4), mises + of.slot[lane]);
  }

  static void add_terms(const Terms& terms, Elements& of, Mask<P>& valid) {
    if (terms.mises) put_mises(of, terms.mises);
    if (terms.branch_count > 0) add_relaxation(terms, of);
    if (terms.is_viscous()) add_viscosity(terms, of);
    if (terms.has_volume) add_volume(terms, of, valid);
    if (terms.active != 0) add_active(terms, of);
  }

  /// Adds what the points pull at the ten nodes to `out`.
  template <bool with_J>
  [[gnu::always_inline]] static inline void forces_at_nodes(const Elements& of, P (&out)[10][3]) {
    P sum[4][3];
    for (auto& of_node : out)
      for (P& value : of_node) value = P(0);
    for (auto& of_corner : sum)
      for (P& value : of_corner) value = P(0);
    constexpr Real own = own_weight;
#pragma GCC unroll 1
    for (std::size_t q = 0; q < 4; ++q) {
      const Point& point = of.point[q];
      P f[12];
      forces_from_tensions<with_J>(point.t, point.of.e, point.of.cross, f);
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
  [[gnu::always_inline]] static inline void add(const P (&out)[10][3], const Elements& of, Real* records) {
    alignas(64) Real of_lane[10][4][lanes];
    for (std::size_t a = 0; a < 10; ++a) {
      const P rows[4] = {out[a][0], out[a][1], out[a][2], P(0)};
      Fours::write(rows, of_lane[a]);
    }
    for (std::size_t k = 0; k < parts && 4 * k < of.count; ++k)
      if (4 * k + 4 <= of.count)
        add_four(of_lane, of, k, 4, records);
      else
        add_four(of_lane, of, k, of.count - 4 * k, records);
  }

  /// Adds the forces of the elements to the records.
  template <bool with_J>
  static void add_forces(const PackedLaw& law, const Block& block, const Terms& terms, Elements& of, Mask<P>& valid,
                         Real* records) {
    read_positions(records, of);
    read_rest(block, law.uses_fibre || terms.active != 0, of);
    put_kinematics<with_J>(of);
    law.tensions(law.law, block, of, valid);
    if (terms.any()) add_terms(terms, of, valid);
    if (block.kappa) add_mean_pressure(block, terms, of, valid);
    P out[10][3];
    forces_at_nodes<with_J>(of, out);
    add(out, of, records);
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

  template <bool with_J>
  static void add_elements(const PackedLaw& law, const Block& block, const Terms& terms, Mask<P>& valid,
                           Real* records) {
    Elements of;
    for (std::size_t first = 0; first < block.elements; first += lanes) {
      const std::size_t left = block.elements - first;
      of.count = left < lanes ? left : lanes;
      for (std::size_t l = 0; l < lanes; ++l) {
        const std::size_t element = first + (l < of.count ? l : of.count - 1);
        of.index[l] = block.index + 10 * element;
        of.slot[l] = 4 * element;
      }
      add_forces<with_J>(law, block, terms, of, valid, records);
    }
  }

  static bool run(const PackedLaw& law, const Block& block, const Terms& terms, const Real* x, Real* f) {
    alignas(64) Real records[8 * 10 * max_point_block_elements];
    read_nodes(block.place, block.own, x, records);
    read_nodes(block.place + block.own, block.nodes - block.own, x, records + 8 * block.own);
    Mask<P> valid = true;
    if (law.uses_J || block.kappa || terms.any())
      add_elements<true>(law, block, terms, valid, records);
    else
      add_elements<false>(law, block, terms, valid, records);
    for (std::size_t n = 0; n < block.nodes; ++n) {
      Real* const to = n < block.own ? f + block.place[n] : block.shared_force + 3 * (n - block.own);
      for (std::size_t i = 0; i < 3; ++i) to[i] = records[8 * n + 4 + i];
    }
    return valid.all();
  }
};

}  // namespace
}  // namespace heml
