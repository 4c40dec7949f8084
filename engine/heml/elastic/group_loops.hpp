#pragma once
// Loops over a group of elements, written once for every law and scalar. The law is a template argument, so a loop
// computes only what its law uses. P: a pack of lanes; law: PackedLaw<P, L>.
#include <algorithm>
#include <heml/elastic/edge_stiffness.hpp>
#include <heml/elastic/element_group.hpp>
#include <heml/elastic/four.hpp>
#include <heml/elastic/law_source.hpp>
#include <heml/elastic/step_bound.hpp>
#include <heml/elastic/tension.hpp>
#include <heml/materials/law.hpp>
#include <limits>

namespace heml {

/// The positions of one slot's nodes in an array x (3 #V).
template <class Real>
struct SlotNodes {
  const Real *x0, *x1, *x2, *x3;
  SlotNodes(const ElementGroup<Real>& group, const Real* x, std::size_t s)
      : x0(x + 3 * group.node[0][s]),
        x1(x + 3 * group.node[1][s]),
        x2(x + 3 * group.node[2][s]),
        x3(x + 3 * group.node[3][s]) {}
};

template <class Real>
RestShape<Real> rest_shape(const ElementGroup<Real>& group, std::size_t s) {
  RestShape<Real> rest;
  for (std::size_t i = 0; i < 6; ++i) rest.A[i] = group.A[i][s];
  rest.volume = group.volume[s];
  if (!group.fibre[0].empty())
    for (std::size_t i = 0; i < 3; ++i) rest.fibre[i] = group.fibre[i][s];
  return rest;
}

template <class Real>
ElementKinematics<Real> full_kinematics(const ElementGroup<Real>& group, const Real* x, std::size_t s,
                                        const RestShape<Real>& rest) {
  const SlotNodes<Real> n(group, x, s);
  return full_element_kinematics(n.x0, n.x1, n.x2, n.x3, rest);
}

/// Data of one packet, gathered first so that the compiler can vectorise the computation.
template <class Real, bool with_fibre>
struct Packet {
  static constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  Real x[12][lanes], A[6][lanes], volume[lanes], fibre[3][lanes];

  [[gnu::always_inline]] inline Packet(const ElementGroup<Real>& group, const Real* positions, std::size_t first) {
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t l = 0; l < lanes; l += 4) {
        const int* node = group.node[c].data() + first + l;
        Four<Real> of_lane[4];
        for (std::size_t k = 0; k < 4; ++k) of_lane[k] = read_three(positions + 3 * node[k]);
        transpose(of_lane);
        for (std::size_t i = 0; i < 3; ++i) write_four(of_lane[i], &x[3 * c + i][l]);
      }
    for (std::size_t l = 0; l < lanes; ++l) {
      for (std::size_t i = 0; i < 6; ++i) A[i][l] = group.A[i][first + l];
      volume[l] = group.volume[first + l];
      if constexpr (with_fibre)
        for (std::size_t i = 0; i < 3; ++i) fibre[i][l] = group.fibre[i][first + l];
    }
  }

  [[gnu::always_inline]] inline RestShape<Real> rest(std::size_t l) const {
    RestShape<Real> r;
    for (std::size_t i = 0; i < 6; ++i) r.A[i] = A[i][l];
    r.volume = volume[l];
    if constexpr (with_fibre)
      for (std::size_t i = 0; i < 3; ++i) r.fibre[i] = fibre[i][l];
    return r;
  }
};

/// Positions of the corners of one lane.
template <class Real>
struct Corners {
  Real x[4][3];
  template <std::size_t lanes>
  [[gnu::always_inline]] inline Corners(const Real (&packet)[12][lanes], std::size_t l) {
    for (std::size_t i = 0; i < 12; ++i) x[i / 3][i % 3] = packet[i][l];
  }
};

/// Writes or adds the corner forces of one packet.
template <class Real, std::size_t lanes>
[[gnu::always_inline]] inline void write_packet_corners(const Real (&out)[12][lanes], Real* to, bool add) {
  for (std::size_t l = 0; l < lanes; l += 4)
    for (std::size_t i = 0; i < 12; i += 4) {
      Four<Real> rows[4];
      for (std::size_t k = 0; k < 4; ++k) rows[k] = read_four(&out[i + k][l]);
      transpose(rows);
      for (std::size_t k = 0; k < 4; ++k) {
        Real* of_lane = to + 12 * (l + k) + i;
        write_four(add ? read_four(of_lane) + rows[k] : rows[k], of_lane);
      }
    }
}

/// As many lanes of a packet as fit one register, as packs: the law is evaluated on all of them at once.
template <class P, bool with_fibre>
struct PackedElements {
  P x[4][3];
  RestShape<P> rest;

  [[gnu::always_inline]] inline PackedElements(const Packet<Lane<P>, with_fibre>& packet, std::size_t first) {
    const auto load = [first](const Lane<P>* lanes) {
      typename P::Vector v;
      __builtin_memcpy(&v, lanes + first, sizeof v);
      return P(v);
    };
    for (std::size_t i = 0; i < 12; ++i) x[i / 3][i % 3] = load(packet.x[i]);
    for (std::size_t i = 0; i < 6; ++i) rest.A[i] = load(packet.A[i]);
    rest.volume = load(packet.volume);
    for (std::size_t i = 0; i < 3; ++i) rest.fibre[i] = with_fibre ? load(packet.fibre[i]) : P(0);
  }
};

/// Writes the stiffness of the elements in the lanes of a pack, or adds it. first: their lane in packet p.
template <class P>
[[gnu::always_inline]] inline void write_packed_stiffness(const P (&k)[edge_entries], std::size_t p, std::size_t first,
                                                          Lane<P>* K, bool add) {
  constexpr std::size_t lanes = ElementGroup<Lane<P>>::lanes;
  Lane<P>* to = K + edge_entries * lanes * p + first;
  for (std::size_t i = 0; i < edge_entries; ++i) {
    typename P::Vector before;
    __builtin_memcpy(&before, to + lanes * i, sizeof before);
    const typename P::Vector sum = add ? k[i].v + before : k[i].v;
    __builtin_memcpy(to + lanes * i, &sum, sizeof sum);
  }
}

/// `scale` times the stiffness of packets [begin, end) at x into K (elastic/edge_stiffness.hpp), overwritten or added
/// to.
template <class P, class L>
[[gnu::always_inline]] inline void group_stiffness(PackedLaw<P, L> law, const ElementGroup<Lane<P>>& group,
                                                   const Lane<P>* x, std::size_t begin, std::size_t end, Lane<P> scale,
                                                   Lane<P>* K, bool add) {
  using Real = Lane<P>;
  constexpr std::size_t lanes = ElementGroup<Real>::lanes, width = P::lanes;
  for (std::size_t p = begin; p < end; ++p) {
    const Packet<Real, L::uses_I4> packet(group, x, p * lanes);
    for (std::size_t first = 0; first < lanes; first += width) {
      const PackedElements<P, L::uses_I4> at(packet, first);
      const auto kinematics = law_kinematics<L>(at.x[0], at.x[1], at.x[2], at.x[3], at.rest);
      P k[edge_entries];
      for (P& entry : k) entry = P(0);
      add_edge_stiffness<P>(law.at(p * lanes + first), kinematics, at.rest, k);
      if (scale != Real(1))
        for (P& entry : k) entry *= P(scale);
      write_packed_stiffness(k, p, first, K, add);
    }
  }
}

/// `scale` times the energy of the law in each of packets [begin, end), J, summed in double into of_packet, overwritten
/// or added to.
template <class P, class L>
[[gnu::always_inline]] inline void group_energy(PackedLaw<P, L> law, const ElementGroup<Lane<P>>& group,
                                                const Lane<P>* x, std::size_t begin, std::size_t end, double scale,
                                                double* of_packet, bool add) {
  using Real = Lane<P>;
  constexpr std::size_t lanes = ElementGroup<Real>::lanes, width = P::lanes;
  for (std::size_t p = begin; p < end; ++p) {
    const Packet<Real, L::uses_I4> packet(group, x, p * lanes);
    Real density[lanes];
    for (std::size_t first = 0; first < lanes; first += width) {
      const PackedElements<P, L::uses_I4> at(packet, first);
      const auto kinematics = law_kinematics<L>(at.x[0], at.x[1], at.x[2], at.x[3], at.rest);
      const P W = law_energy<P>(law.at(p * lanes + first), kinematics, at.rest);
      __builtin_memcpy(density + first, &W.v, sizeof W.v);
    }
    double sum = add ? of_packet[p] : 0.0;
    const std::size_t used = std::min(lanes, group.size() - p * lanes);  // padding repeats the last element
    for (std::size_t l = 0; l < used; ++l)
      sum += scale * (static_cast<double>(packet.volume[l]) * static_cast<double>(density[l]));
    of_packet[p] = sum;
  }
}

/// T and wJ of a slot, as lists of lanes.
inline constexpr std::size_t tension_entries = 7;

/// Upper bounds of the von Mises Kirchhoff stress of a law of invariants in packets [begin, end), Pa, without its part
/// of fibres: τ' = a B − b B² but for its trace, whose powers have traces that follow from I1, I2 and J
/// (Cayley-Hamilton). They cancel in bodies near rest, so what rounding may take away is added.
template <class P, class L>
[[gnu::always_inline]] inline void group_mises_bounds(PackedLaw<P, L> law, const ElementGroup<Lane<P>>& group,
                                                      const Lane<P>* x, std::size_t begin, std::size_t end,
                                                      Lane<P>* bounds) {
  using Real = Lane<P>;
  constexpr std::size_t lanes = ElementGroup<Real>::lanes, width = P::lanes;
  constexpr Real rounding = 64 * std::numeric_limits<Real>::epsilon();
  for (std::size_t p = begin; p < end; ++p) {
    const Packet<Real, false> packet(group, x, p * lanes);
    for (std::size_t first = 0; first < lanes; first += width) {
      const PackedElements<P, false> e(packet, first);
      const auto of_element = element_kinematics<true, true, false, false>(e.x[0], e.x[1], e.x[2], e.x[3], e.rest).at;
      const P I1 = of_element.I1, I2 = of_element.I2, J = of_element.J;
      const FirstDerivatives<P> w = law.at(p * lanes + first).first_derivatives({I1, I2, J});
      const P a = 2 * (w.w1 + w.w2 * I1), b = 2 * w.w2;
      const P B2 = I1 * I1 - 2 * I2, B3 = I1 * B2 - I2 * I1 + 3 * J * J, B4 = I1 * B3 - I2 * B2 + J * J * I1;
      const P trace = a * I1 - b * B2, square = a * a * B2 - 2 * a * b * B3 + b * b * B4;
      const P size = 2 * (a * a + b * b * I1 * I1) * I1 * I1;  // no term is larger
      const P bound = sqrt(P(1.5) * (square - trace * trace / 3 + rounding * size));
      __builtin_memcpy(bounds + (p - begin) * lanes + first, &bound.v, sizeof bound.v);
    }
  }
}

/// w_a of the corners of a packet's elements (step_bound.hpp). weights: of the nodes; null: 1.
template <class Real>
struct PacketWeights {
  static constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  Real w[4][lanes];

  [[gnu::always_inline]] PacketWeights(const ElementGroup<Real>& group, const Real* weights, std::size_t packet) {
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t l = 0; l < lanes; ++l) w[a][l] = weights ? weights[group.node[a][packet * lanes + l]] : Real(1);
  }
  [[gnu::always_inline]] CornerWeights<Real> at(std::size_t lane) const {
    return {{w[0][lane], w[1][lane], w[2][lane], w[3][lane]}};
  }
};
template <class Real>
CornerWeights<Real> weights_of_slot(const ElementGroup<Real>& group, const Real* weights, std::size_t s) {
  CornerWeights<Real> of_corners;
  if (weights)
    for (std::size_t a = 0; a < 4; ++a) of_corners.w[a] = weights[group.node[a][s]];
  return of_corners;
}

/// Writes element_frequency_bound() of packets [begin, end), 1/s², into bounds (8 a packet), or adds it. laws:
/// PacketLaws or SameLaw.
template <class L, class Real, class Laws>
[[gnu::always_inline]] inline void group_frequency_bounds(Laws laws, const ElementGroup<Real>& group,
                                                          const Real* weights, const Real* x, std::size_t begin,
                                                          std::size_t end, Real* bounds, bool add) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  for (std::size_t p = begin; p < end; ++p, bounds += lanes) {
    const Packet<Real, L::uses_I4> packet(group, x, p * lanes);
    const PacketWeights<Real> of_corners(group, weights, p);
    laws.read(group, p * lanes);
    Real bound[lanes];
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      const Corners<Real> at(packet.x, l);
      const RestShape<Real> rest = packet.rest(l);
      const auto kinematics = law_kinematics<L>(at.x[0], at.x[1], at.x[2], at.x[3], rest);
      bound[l] = element_frequency_bound(laws.at(l), kinematics, rest, of_corners.at(l), group.density);
    }
    for (std::size_t l = 0; l < lanes; ++l) bounds[l] = (add ? bounds[l] : 0) + bound[l];
  }
}

}  // namespace heml
