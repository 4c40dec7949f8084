#include <algorithm>
#include <heml/elastic/active_term.hpp>
#include <heml/elastic/avx2_dispatch.hpp>

namespace heml {
namespace {

template <class Real>
[[gnu::always_inline]] inline void active_forces(Real stress, const ElementGroup<Real>& group, const Real* x,
                                                 std::size_t begin, std::size_t end, Real* corner, bool add) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  for (std::size_t p = begin; p < end; ++p) {
    const Packet<Real, true> packet(group, x, p * lanes);
    Real out[12][lanes];
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      const Corners<Real> at(packet.x, l);
      const RestShape<Real> rest = packet.rest(l);
      Real pull[3];
      for (std::size_t a = 0; a < 3; ++a) pull[a] = stress * rest.volume * rest.fibre[a];
      for (std::size_t i = 0; i < 3; ++i) {
        Real along = 0, sum = 0;  // component i of F a0
        for (std::size_t a = 0; a < 3; ++a) along += rest.fibre[a] * (at.x[a + 1][i] - at.x[0][i]);
        for (std::size_t a = 0; a < 3; ++a) {
          out[3 * (a + 1) + i][l] = -pull[a] * along;
          sum += pull[a] * along;
        }
        out[i][l] = sum;
      }
    }
    write_packet_corners(out, corner + 3 * (group.first_corner + 4 * p * lanes), add);
  }
}

template <class Real>
HEML_WIDE void wide_active_forces(Real stress, const ElementGroup<Real>& group, const Real* x, std::size_t begin,
                                  std::size_t end, Real* corner, bool add) {
  active_forces(stress, group, x, begin, end, corner, add);
}

}  // namespace

template <class Real>
Tensions<Real> ActiveTerm<Real>::tensions(const Group&, std::size_t, const ElementKinematics<Real>&,
                                          const RestShape<Real>& rest) const {
  Tensions<Real> t{};
  outer3(rest.fibre, t.T);
  for (Real& value : t.T) value *= rest.volume * stress_;
  return t;
}

template <class Real>
double ActiveTerm<Real>::energy(const Group&, std::size_t, const ElementKinematics<Real>& kinematics,
                                const RestShape<Real>& rest) const {
  return static_cast<double>(rest.volume * stress_ / 2 * (kinematics.at.I4 - 1));
}

template <class Real>
bool ActiveTerm<Real>::forces(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real* corner,
                              bool add) const {
  if (has_avx2())
    wide_active_forces(stress_, group, x, begin, end, corner, add);
  else
    active_forces(stress_, group, x, begin, end, corner, add);
  return true;
}

template <class Real>
void ActiveTerm<Real>::stiffness(const Group& group, const Real*, std::size_t begin, std::size_t end, Real scale,
                                 Real* K, bool add) const {
  for (std::size_t s = begin * Group::lanes; s < end * Group::lanes; ++s) {
    const auto rest = rest_shape(group, s);
    Real k[edge_entries] = {};
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b <= a; ++b)
        for (int i = 0; i < 3; ++i)
          k[edge_entry(3 * a + i, 3 * b + i)] = scale * (rest.volume * stress_ * rest.fibre[a] * rest.fibre[b]);
    write_edge_stiffness(k, s, K, add);
  }
}

/// Exact: K of an element is V Ta m mᵀ ⊗ I over its four corners, its mass ρV/4 z_a on each.
template <class Real>
Real ActiveTerm<Real>::slot_bound(const Group& group, std::size_t s, const CornerWeights<Real>& weights) const {
  const auto rest = rest_shape(group, s);
  const Real total = rest.fibre[0] + rest.fibre[1] + rest.fibre[2];
  Real sum = weights.w[0] * total * total;
  for (std::size_t a = 0; a < 3; ++a) sum += weights.w[a + 1] * rest.fibre[a] * rest.fibre[a];
  return 4 / group.density * stress_ * sum;
}

template <class Real>
void ActiveTerm<Real>::frequency_bounds(const Group& group, const Real* weights, const Real*, std::size_t begin,
                                        std::size_t end, Real* bounds, bool add) const {
  for (std::size_t s = begin * Group::lanes; s < end * Group::lanes; ++s, ++bounds)
    *bounds = (add ? *bounds : 0) + slot_bound(group, s, weights_of_slot(group, weights, s));
}

template class ActiveTerm<float>;
template class ActiveTerm<double>;

}  // namespace heml
