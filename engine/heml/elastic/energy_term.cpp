#include <heml/elastic/avx2_dispatch.hpp>
#include <heml/elastic/energy_term.hpp>
#include <heml/elastic/stretch_tension.hpp>

namespace heml {
namespace {

struct EnergyFamily {};
template <class Real>
using EnergyPack = Pack<Real, static_cast<int>(32 / sizeof(Real)), EnergyFamily>;

/// The derivatives of a law of invariants at one element, in place of the law; those by I4 are for evaluated_bound().
template <class Real>
struct EvaluatedEnergy {
  static constexpr bool has_volume_term = false, uses_I2 = true, uses_J = true, uses_I4 = false;
  static constexpr bool always_valid = false;
  static constexpr std::array<int, 0> parameters{};
  FirstDerivatives<Real> first;
  SecondDerivatives<Real> second;

  bool valid(const Invariants<Real>&) const { return true; }
  Real energy(const Invariants<Real>&) const { return 0; }
  FirstDerivatives<Real> first_derivatives(const Invariants<Real>&) const { return first; }
  SecondDerivatives<Real> second_derivatives(const Invariants<Real>&) const { return second; }
};

/// element_frequency_bound() of a law of invariants. The fibre's second derivatives are bounded term by term, since the
/// bound for laws of their own types takes I2 or I4, not both.
template <bool with_fibre, class Real>
[[gnu::always_inline]] inline Real evaluated_bound(const EvaluatedEnergy<Real>& law,
                                                   const ElementKinematics<Real>& kinematics,
                                                   const RestShape<Real>& rest, const CornerWeights<Real>& weights,
                                                   Real density) {
  Real bound = element_frequency_bound(law, kinematics, rest, weights, density);
  if constexpr (with_fibre) {
    const auto& s = law.second;
    const auto positive = [](Real value) { return std::max(value, Real(0)); };
    const CornerSums<Real> sums = corner_sums(kinematics, rest, weights);
    const auto N = gradient_products<EvaluatedEnergy<Real>>(kinematics, rest, sums, weights);
    const Real n44 = 4 * kinematics.at.I4 * sums.m;
    bound += 4 / density *
             (2 * positive(law.first.w4) * sums.m + positive(s.w44) * n44 +
              2 * (std::abs(s.w14) * std::sqrt(N.n11 * n44) + std::abs(s.w24) * std::sqrt(positive(N.n22) * n44) +
                   std::abs(s.w4J) * std::sqrt(N.nJJ * n44)));
  }
  return bound;
}

/// group_frequency_bounds() of a law of invariants: its derivatives on packs, then one element a lane.
template <class Real, class L>
HEML_WIDE void energy_group_bounds(const L& law, const ElementGroup<Real>& group, const Real* weights, const Real* x,
                                   std::size_t begin, std::size_t end, Real* bounds, bool add) {
  using P = EnergyPack<Real>;
  constexpr std::size_t lanes = ElementGroup<Real>::lanes, width = P::lanes;
  const auto many = law.template broadcast<P>();
  for (std::size_t p = begin; p < end; ++p, bounds += lanes) {
    const Packet<Real, L::uses_I4> packet(group, x, p * lanes);
    const PacketWeights<Real> of_corners(group, weights, p);
    Real d[14][lanes], bound[lanes];
    for (std::size_t first = 0; first < lanes; first += width) {
      const PackedElements<P, L::uses_I4> at(packet, first);
      const auto in = law_kinematics<L>(at.x[0], at.x[1], at.x[2], at.x[3], at.rest).at;
      const FirstDerivatives<P> s = many.first_derivatives(in);
      const SecondDerivatives<P> c = many.second_derivatives(in);
      const P values[14] = {s.w1,  s.w2,  s.wJ,  s.w4,  c.w11, c.w12, c.w22,
                            c.w1J, c.w2J, c.wJJ, c.w14, c.w24, c.w4J, c.w44};
      for (int i = 0; i < 14; ++i) __builtin_memcpy(d[i] + first, &values[i].v, sizeof values[i].v);
    }
    for (std::size_t l = 0; l < lanes; ++l) {
      const Corners<Real> at(packet.x, l);
      const RestShape<Real> rest = packet.rest(l);
      const EvaluatedEnergy<Real> evaluated{
          {d[0][l], d[1][l], d[2][l], d[3][l]},
          {d[4][l], d[5][l], d[6][l], d[7][l], d[8][l], d[9][l], d[10][l], d[11][l], d[12][l], d[13][l]}};
      bound[l] = evaluated_bound<L::uses_I4>(evaluated, law_kinematics<L>(at.x[0], at.x[1], at.x[2], at.x[3], rest),
                                             rest, of_corners.at(l), group.density);
    }
    for (std::size_t l = 0; l < lanes; ++l) bounds[l] = (add ? bounds[l] : 0) + bound[l];
  }
}

template <class P, class L>
[[gnu::always_inline]] inline Tensions<P> checked_tensions(const L& law, const ElementKinematics<P>& kinematics,
                                                           const RestShape<P>& rest, Mask<P>& valid) {
  const Tensions<P> t = tensions(law, kinematics, rest);
  P sum = t.wJ;
  for (const P& value : t.T) sum += value;
  valid = valid && law.valid(kinematics.at) && is_finite(sum);
  return t;
}

/// GroupTerm::forces() on packs.
template <class Real, class L>
HEML_WIDE bool energy_forces(const L& law, const ElementGroup<Real>& group, const Real* x, std::size_t begin,
                             std::size_t end, Real* corner, bool add) {
  using P = EnergyPack<Real>;
  constexpr std::size_t lanes = ElementGroup<Real>::lanes, width = P::lanes;
  const auto many = law.template broadcast<P>();
  Mask<P> valid = true;
  for (std::size_t p = begin; p < end; ++p) {
    const Packet<Real, L::uses_I4> packet(group, x, p * lanes);
    Real out[12][lanes];
    for (std::size_t first = 0; first < lanes; first += width) {
      const PackedElements<P, L::uses_I4> at(packet, first);
      const auto kinematics = law_kinematics<L>(at.x[0], at.x[1], at.x[2], at.x[3], at.rest);
      P f[12];
      forces_from_tensions<true>(checked_tensions(many, kinematics, at.rest, valid), kinematics.e, kinematics.cross, f);
      for (int i = 0; i < 12; ++i) __builtin_memcpy(out[i] + first, &f[i].v, sizeof f[i].v);
    }
    write_packet_corners(out, corner + 3 * (group.first_corner + 4 * p * lanes), add);
  }
  return valid.all();
}

template <class Real, class L>
HEML_WIDE void energy_stiffness(const L& law, const ElementGroup<Real>& group, const Real* x, std::size_t begin,
                                std::size_t end, Real scale, Real* K, bool add) {
  group_stiffness<EnergyPack<Real>, L>(PackedLaw<EnergyPack<Real>, L>(law), group, x, begin, end, scale, K, add);
}

template <class Real, class L>
HEML_WIDE void energy_energies(const L& law, const ElementGroup<Real>& group, const Real* x, std::size_t begin,
                               std::size_t end, double scale, double* of_packet, bool add) {
  group_energy<EnergyPack<Real>, L>(PackedLaw<EnergyPack<Real>, L>(law), group, x, begin, end, scale, of_packet, add);
}

template <class Real, class L>
class EnergyTerm final : public GroupTerm<Real> {
 public:
  using Group = ElementGroup<Real>;
  explicit EnergyTerm(const L& law) : law_(law) {}

  Tensions<Real> tensions(const Group&, std::size_t, const ElementKinematics<Real>& kinematics,
                          const RestShape<Real>& rest) const override {
    return heml::tensions(law_, kinematics, rest);
  }

  Tensions<Real> tension_differential(const Group&, std::size_t, const ElementKinematics<Real>& kinematics,
                                      const RestShape<Real>& rest,
                                      const KinematicsDifferential<Real>& change) const override {
    return heml::tension_differential(law_, kinematics, rest, change);
  }

  Real slot_frequency_bound(const Group& group, std::size_t, const ElementKinematics<Real>& kinematics,
                            const RestShape<Real>& rest, const CornerWeights<Real>& weights) const override {
    if constexpr (requires { L::is_of_stretches; }) {
      return element_frequency_bound(law_, kinematics, rest, weights, group.density);
    } else {
      const EvaluatedEnergy<Real> evaluated{law_.first_derivatives(kinematics.at),
                                            law_.second_derivatives(kinematics.at)};
      return evaluated_bound<L::uses_I4>(evaluated, kinematics, rest, weights, group.density);
    }
  }

  double energy(const Group&, std::size_t, const ElementKinematics<Real>& kinematics,
                const RestShape<Real>& rest) const override {
    return static_cast<double>(rest.volume) * static_cast<double>(law_energy(law_, kinematics, rest));
  }

  bool valid(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics) const override {
    bool defined = true;
    checked_tensions(law_, kinematics, rest_shape(group, s), defined);
    return defined;
  }

  SlotStates<Real> slot_states() override { return {}; }

  bool forces(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real* corner,
              bool add) const override {
    if (!has_avx2()) return GroupTerm<Real>::forces(group, x, begin, end, corner, add);
    return energy_forces<Real>(law_, group, x, begin, end, corner, add);
  }

  void stiffness(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real scale, Real* K,
                 bool add) const override {
    if (has_avx2()) return energy_stiffness<Real>(law_, group, x, begin, end, scale, K, add);
    GroupTerm<Real>::stiffness(group, x, begin, end, scale, K, add);
  }

  void energies(const Group& group, const Real* x, std::size_t begin, std::size_t end, double scale, double* of_packet,
                bool add) const override {
    if (has_avx2()) return energy_energies<Real>(law_, group, x, begin, end, scale, of_packet, add);
    GroupTerm<Real>::energies(group, x, begin, end, scale, of_packet, add);
  }

  void frequency_bounds(const Group& group, const Real* weights, const Real* x, std::size_t begin, std::size_t end,
                        Real* bounds, bool add) const override {
    if constexpr (!requires { L::is_of_stretches; })
      if (has_avx2()) return energy_group_bounds<Real>(law_, group, weights, x, begin, end, bounds, add);
    GroupTerm<Real>::frequency_bounds(group, weights, x, begin, end, bounds, add);
  }

 private:
  L law_;
};

}  // namespace

template <class Real>
std::unique_ptr<GroupTerm<Real>> make_energy_term(const Material& material) {
  std::unique_ptr<GroupTerm<Real>> term;
  with_energy<Real>(material, [&]<class L>(const L& law) { term = std::make_unique<EnergyTerm<Real, L>>(law); });
  return term;
}

bool has_kernel(const Material& material) {
  const EnergyLaw* energy = find_energy_law(material.law);
  return !energy || !energy->info.is_principal;
}

template std::unique_ptr<GroupTerm<float>> make_energy_term(const Material&);
template std::unique_ptr<GroupTerm<double>> make_energy_term(const Material&);

}  // namespace heml
