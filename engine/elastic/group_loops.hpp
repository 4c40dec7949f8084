#pragma once
// The loops over a group of elements. Each is written once for every law and scalar; the law is a value of its own
// type, so what a law does not use is not in the loop.
#include <heml/elastic/element_group.hpp>
#include <heml/elastic/step_bound.hpp>
#include <heml/elastic/tension.hpp>
#include <heml/materials/law.hpp>

namespace heml {

/// The elements of one slot's nodes in an array of positions x (3 #V).
template <class Real>
struct SlotNodes {
  const Real *x0, *x1, *x2, *x3;
  SlotNodes(const ElementGroup<Real>& group, const Real* x, std::size_t s)
      : x0(x + 3 * group.node[0][s]),
        x1(x + 3 * group.node[1][s]),
        x2(x + 3 * group.node[2][s]),
        x3(x + 3 * group.node[3][s]) {}
};

/// What the loops read of one packet, gathered apart so that the compiler can vectorise what is computed from it.
template <class Real>
struct Packet {
  static constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  Real x[12][lanes], A[6][lanes], volume[lanes];

  [[gnu::always_inline]] inline Packet(const ElementGroup<Real>& group, const Real* positions, std::size_t first) {
    for (std::size_t l = 0; l < lanes; ++l) {
      for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t i = 0; i < 3; ++i)
          x[3 * c + i][l] = positions[3 * group.node[c][first + l] + static_cast<int>(i)];
      for (std::size_t i = 0; i < 6; ++i) A[i][l] = group.A[i][first + l];
      volume[l] = group.volume[first + l];
    }
  }
};

/// One lane of a packet, as the functions of one element take it.
template <class Real>
struct Lane {
  Real x[4][3], A[6];
  [[gnu::always_inline]] inline Lane(const Packet<Real>& packet, std::size_t l) {
    for (std::size_t i = 0; i < 12; ++i) x[i / 3][i % 3] = packet.x[i][l];
    for (std::size_t i = 0; i < 6; ++i) A[i] = packet.A[i][l];
  }
};

/// Corner forces of packets [begin, end) into corner (3 reals a corner). Returns whether the law is defined in all of
/// them.
template <class Real, Law<Real> L>
[[gnu::always_inline]] inline bool group_forces(const L& law, const ElementGroup<Real>& group, const Real* x,
                                                std::size_t begin, std::size_t end, Real* corner) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  bool valid = true;
  for (std::size_t p = begin; p < end; ++p) {
    const Packet<Real> packet(group, x, p * lanes);
    Real out[12][lanes], defined[lanes];
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      const Lane<Real> in(packet, l);
      Real f[12];
      const bool is_defined = corner_forces(law, in.x[0], in.x[1], in.x[2], in.x[3], in.A, packet.volume[l], f);
      defined[l] = is_defined ? Real(1) : Real(0);
      for (int i = 0; i < 12; ++i) out[i][l] = f[i];
    }
    Real* to = corner + 3 * (group.first_corner + 4 * p * lanes);
    for (std::size_t l = 0; l < lanes; ++l)
      for (std::size_t i = 0; i < 12; ++i) to[12 * l + i] = out[i][l];
    if constexpr (!L::always_valid)
      for (std::size_t l = 0; l < lanes; ++l) valid = valid && defined[l] == 1;
  }
  return valid;
}

/// Largest element_frequency_bound() of packets [begin, end), 1/s²; not a number where one is not.
template <class Real, Law<Real> L>
[[gnu::always_inline]] inline Real group_frequency_bound(const L& law, const ElementGroup<Real>& group, const Real* x,
                                                         std::size_t begin, std::size_t end) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  Real largest = 0;
  for (std::size_t p = begin; p < end; ++p) {
    const Packet<Real> packet(group, x, p * lanes);
    Real bound[lanes];
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      const Lane<Real> in(packet, l);
      const auto link = read_link<true, true>(in.x[0], in.x[1], in.x[2], in.x[3], in.A, packet.volume[l]);
      bound[l] = element_frequency_bound(law, link, in.A, packet.volume[l], group.gamma[p * lanes + l], group.density);
    }
    for (std::size_t l = 0; l < lanes; ++l) largest = bound[l] > largest || std::isnan(bound[l]) ? bound[l] : largest;
  }
  return largest;
}

/// Calls visit(element, Link) for every element of the group, in order, with all invariants.
template <class Real, class Visit>
void for_each_link(const ElementGroup<Real>& group, const Real* x, std::size_t begin, std::size_t end,
                   const Visit& visit) {
  for (std::size_t s = begin; s < end; ++s) {
    const SlotNodes<Real> n(group, x, s);
    const Real A[6] = {group.A[0][s], group.A[1][s], group.A[2][s], group.A[3][s], group.A[4][s], group.A[5][s]};
    visit(s, A, read_link<true, true>(n.x0, n.x1, n.x2, n.x3, A, group.volume[s]));
  }
}

}  // namespace heml
