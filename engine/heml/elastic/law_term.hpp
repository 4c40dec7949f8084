#pragma once
// A law as a term of a group's energy.
#include <heml/elastic/avx2_dispatch.hpp>
#include <heml/elastic/group_term.hpp>
#include <heml/elastic/law_source.hpp>

namespace heml {

// The vectorised loops. Their own pack family keeps their inline code apart from that of files compiled for other
// processors (math/pack.hpp).
struct WideFamily {};
template <class Real>
using WidePack = Pack<Real, static_cast<int>(32 / sizeof(Real)), WideFamily>;

template <class Real, class L>
HEML_WIDE void wide_stiffness(const LawSource<Real, L>& law, const ElementGroup<Real>& group, const Real* x,
                              std::size_t begin, std::size_t end, Real scale, Real* K, bool add) {
  group_stiffness<WidePack<Real>, L>({law, group}, group, x, begin, end, scale, K, add);
}
template <class Real, class L>
HEML_WIDE void wide_energy(const LawSource<Real, L>& law, const ElementGroup<Real>& group, const Real* x,
                           std::size_t begin, std::size_t end, double scale, double* of_packet, bool add) {
  group_energy<WidePack<Real>, L>({law, group}, group, x, begin, end, scale, of_packet, add);
}
template <class Real, class L>
HEML_WIDE void wide_mises_bounds(const LawSource<Real, L>& law, const ElementGroup<Real>& group, const Real* x,
                                 std::size_t begin, std::size_t end, Real* bounds) {
  group_mises_bounds<WidePack<Real>, L>({law, group}, group, x, begin, end, bounds);
}
template <class Real, class L>
HEML_WIDE void wide_frequency_bounds(const LawSource<Real, L>& law, const ElementGroup<Real>& group,
                                     const Real* weights, const Real* x, std::size_t begin, std::size_t end,
                                     Real* bounds, bool add) {
  if constexpr (InvariantLaw<L, Real>)
    group_frequency_bounds<L>(PacketLaws<Real, L>(law), group, weights, x, begin, end, bounds, add);
  else
    group_frequency_bounds<L>(SameLaw<Real, L>{law.uniform_law()}, group, weights, x, begin, end, bounds, add);
}

template <class Real, Law<Real> L>
class LawTerm final : public GroupTerm<Real> {
 public:
  using Group = ElementGroup<Real>;
  explicit LawTerm(LawSource<Real, L> source) : source_(std::move(source)) {}

  Tensions<Real> tensions(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                          const RestShape<Real>& rest) const override {
    return heml::tensions(source_.at(group, s), kinematics, rest);
  }

  Tensions<Real> tension_differential(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                                      const RestShape<Real>& rest,
                                      const KinematicsDifferential<Real>& change) const override {
    return heml::tension_differential(source_.at(group, s), kinematics, rest, change);
  }

  Real slot_frequency_bound(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                            const RestShape<Real>& rest, const CornerWeights<Real>& weights) const override {
    return element_frequency_bound(source_.at(group, s), kinematics, rest, weights, group.density);
  }

  double energy(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                const RestShape<Real>& rest) const override {
    return static_cast<double>(rest.volume) * static_cast<double>(law_energy(source_.at(group, s), kinematics, rest));
  }

  bool valid(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics) const override {
    return L::always_valid || source_.at(group, s).valid(kinematics.at);
  }

  DeviatoricStress<Real> deviatoric_stress(const Group& group, std::size_t s, const Real c[3], Real J) const override {
    return heml::deviatoric_stress(source_.at(group, s), c, J);
  }

  SlotStates<Real> slot_states() override { return {}; }

  void stiffness(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real scale, Real* K,
                 bool add) const override {
    if (has_avx2()) return wide_stiffness(source_, group, x, begin, end, scale, K, add);
    for (std::size_t s = begin * Group::lanes; s < end * Group::lanes; ++s) {
      const auto rest = rest_shape(group, s);
      Real k[edge_entries] = {};
      add_edge_stiffness(source_.at(group, s), full_kinematics(group, x, s, rest), rest, k);
      for (Real& entry : k) entry *= scale;
      write_edge_stiffness(k, s, K, add);
    }
  }

  void energies(const Group& group, const Real* x, std::size_t begin, std::size_t end, double scale, double* of_packet,
                bool add) const override {
    if (!has_avx2()) return GroupTerm<Real>::energies(group, x, begin, end, scale, of_packet, add);
    wide_energy(source_, group, x, begin, end, scale, of_packet, add);
  }

  void mises_bounds(const Group& group, const Real* x, std::size_t begin, std::size_t end,
                    Real* bounds) const override {
    if constexpr (InvariantLaw<L, Real>)
      if (has_avx2()) return wide_mises_bounds(source_, group, x, begin, end, bounds);
    GroupTerm<Real>::mises_bounds(group, x, begin, end, bounds);
  }

  void frequency_bounds(const Group& group, const Real* weights, const Real* x, std::size_t begin, std::size_t end,
                        Real* bounds, bool add) const override {
    if (!has_avx2() || !(source_.uniform() || InvariantLaw<L, Real>))
      return GroupTerm<Real>::frequency_bounds(group, weights, x, begin, end, bounds, add);
    wide_frequency_bounds<Real>(source_, group, weights, x, begin, end, bounds, add);
  }

 private:
  LawSource<Real, L> source_;
};

}  // namespace heml
