#pragma once
// Laws given by an expression (energy_expression.hpp). Their definition is their name: Material::law is
// "energy(C1,kappa)=C1*(I1b-3) + kappa/2*(J-1)^2", so that materials compare, copy and travel like all others.
//
//   definition ──parse──► expression ──parameters──► graph, derivatives ──► programs ──► a law on numbers or packs
#include <array>
#include <heml/materials/energy_program.hpp>
#include <heml/materials/material.hpp>
#include <heml/materials/ogden.hpp>

namespace heml {

/// A law by expression.
struct EnergyLaw {
  std::string definition, text;
  std::vector<std::string> names;  ///< of the parameters
  EnergyExpression expression;
  std::vector<ParameterInfo> parameters;
  LawInfo info;
};

/// The definition of a law with these parameters.
std::string energy_definition(std::string_view text, const std::vector<std::string>& names);

/// The law of a definition, which lives as long as the program; null for any other name. Thread-safe.
const EnergyLaw* find_energy_law(std::string_view definition);

/// The programs of a material whose law is an EnergyLaw. Throws EnergyError if they are too large. Thread-safe.
template <class Real>
std::shared_ptr<const EnergyPrograms<Real>> energy_programs(const Material& material);

/// Whether every lane of a value is a finite number.
template <class P>
[[gnu::always_inline]] inline Mask<P> is_finite(P value) {
  return value - value == P(0);
}

/// What both kinds of law by expression have in common: their programs, which the law for packs borrows.
template <class Real>
struct EnergyLawBase {
  static constexpr bool has_volume_term = false, uses_I2 = true, uses_J = true, always_valid = false;
  static constexpr std::array<int, 0> parameters{};

  EnergySteps<Lane<Real>> W, first, second;
  std::conditional_t<std::is_same_v<Real, Lane<Real>>, std::shared_ptr<const EnergyPrograms<Real>>, NoOwner> owner = {};

  void set(std::shared_ptr<const EnergyPrograms<Real>> programs) {
    owner = std::move(programs);
    W = EnergySteps(owner->energy), first = EnergySteps(owner->first), second = EnergySteps(owner->second);
  }
  template <class Law>
  [[gnu::always_inline]] Law borrowed() const {
    Law law;
    law.W = W, law.first = first, law.second = second;
    return law;
  }
};

/// A law by expression of invariants: an InvariantLaw.
template <class Real, bool continued, bool with_fibre>
struct InvariantEnergy : EnergyLawBase<Real> {
  static constexpr bool uses_I4 = with_fibre;

  template <class Pack>
  [[gnu::always_inline]] InvariantEnergy<Pack, continued, with_fibre> broadcast() const {
    return this->template borrowed<InvariantEnergy<Pack, continued, with_fibre>>();
  }

  /// Without the check that the values are finite (see is_defined()).
  Mask<Real> valid(const Invariants<Real>& at) const { return at.J > min_volume_ratio<Real>; }

  [[gnu::always_inline]] Real energy(const Invariants<Real>& at) const {
    Real r[max_energy_registers];
    run(this->W, at, r);
    return r[this->W.results[0]];
  }
  [[gnu::always_inline]] FirstDerivatives<Real> first_derivatives(const Invariants<Real>& at) const {
    Real r[max_energy_registers];
    run(this->first, at, r);
    const std::uint16_t* k = this->first.results;
    return {r[k[0]], r[k[1]], r[k[2]], r[k[3]]};
  }
  [[gnu::always_inline]] SecondDerivatives<Real> second_derivatives(const Invariants<Real>& at) const {
    Real r[max_energy_registers];
    run(this->second, at, r);
    const std::uint16_t* k = this->second.results;  // 11 12 1J 14 22 2J 24 JJ J4 44
    return {r[k[0]], r[k[1]], r[k[4]], r[k[2]], r[k[5]], r[k[7]], r[k[3]], r[k[6]], r[k[8]], r[k[9]]};
  }

 private:
  [[gnu::always_inline]] static void run(const EnergySteps<Lane<Real>>& program, const Invariants<Real>& at, Real* r) {
    using enum EnergyInput;
    r[static_cast<int>(J)] = at.J, r[static_cast<int>(I4)] = at.I4;
    r[static_cast<int>(I1)] = at.I1, r[static_cast<int>(I2)] = at.I2, r[static_cast<int>(c3)] = Real(0);
    run_energy(program, r);
  }
};

/// Calls use(law) with the material's law as a struct of Real; the law is an EnergyLaw.
template <class Real, class Use>
void with_invariant_energy(const Material& material, const Use& use) {
  const auto programs = energy_programs<Real>(material);
  const auto call = [&](auto law) {
    law.set(programs);
    use(law);
  };
  find_energy_law(material.law)->expression.uses_fibre() ? call(InvariantEnergy<Real, false, true>{})
                                                         : call(InvariantEnergy<Real, false, false>{});
}

}  // namespace heml
