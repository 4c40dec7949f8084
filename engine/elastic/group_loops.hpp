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

/// Corner forces of packets [begin, end) into corner (3 reals a corner). Returns whether the law is defined in all of them.
template <class Real, Law<Real> L>
[[gnu::always_inline]] inline bool group_forces(const L& law, const ElementGroup<Real>& group, const Real* x,
                                                std::size_t begin, std::size_t end, Real* corner) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  bool valid = true;
  for (std::size_t p = begin; p < end; ++p) {
    const std::size_t first = p * lanes;
    // Gather, compute and scatter apart, so that the compiler can vectorise the middle one.
    Real in[12][lanes], out[12][lanes], A[6][lanes], volume[lanes], defined[lanes];
    for (std::size_t l = 0; l < lanes; ++l) {
      for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t i = 0; i < 3; ++i) in[3 * c + i][l] = x[3 * group.node[c][first + l] + static_cast<int>(i)];
      for (std::size_t i = 0; i < 6; ++i) A[i][l] = group.A[i][first + l];
      volume[l] = group.volume[first + l];
    }
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      const Real x0[3] = {in[0][l], in[1][l], in[2][l]}, x1[3] = {in[3][l], in[4][l], in[5][l]},
                 x2[3] = {in[6][l], in[7][l], in[8][l]}, x3[3] = {in[9][l], in[10][l], in[11][l]};
      const Real a[6] = {A[0][l], A[1][l], A[2][l], A[3][l], A[4][l], A[5][l]};
      Real f[12];
      defined[l] = corner_forces(law, x0, x1, x2, x3, a, volume[l], f) ? Real(1) : Real(0);
      for (int i = 0; i < 12; ++i) out[i][l] = f[i];
    }
    Real* to = corner + 3 * (group.first_corner + 4 * first);
    for (std::size_t l = 0; l < lanes; ++l)
      for (std::size_t i = 0; i < 12; ++i) to[12 * l + i] = out[i][l];
    if constexpr (!L::always_valid)
      for (std::size_t l = 0; l < lanes; ++l) valid = valid && defined[l] == 1;
  }
  return valid;
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
