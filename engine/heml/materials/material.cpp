#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <heml/materials/energy_law.hpp>
#include <heml/materials/laws.hpp>
#include <heml/materials/mass_spring.hpp>
#include <heml/materials/parameter_slots.hpp>
#include <heml/materials/point.hpp>

namespace heml {
namespace {

using Problem = std::pair<std::string, std::string>;

template <class L>
constexpr auto parameters_of = [] {
  std::array<ParameterInfo, std::size(L::parameters)> infos;
  for (std::size_t i = 0; i < infos.size(); ++i) infos[i] = L::parameters[i].info;
  return infos;
}();

template <DescribedLaw L>
constexpr LawInfo info_of() {
  const auto& infos = parameters_of<L>;
  const bool lame = infos.size() == 2 && infos.front().name == "lambda" && infos.back().name == "mu";
  const auto of_moduli = [](SmallStrainModuli rest) {
    const auto values = L::of_moduli(rest.shear, rest.bulk);
    return std::vector<double>(values.begin(), values.end());
  };
  return {L::name,
          L::title,
          L::formula,
          L::source,
          infos,
          lame,
          L::has_volume_term,
          L::uses_I4,
          PrincipalLaw<L, double>,
          L::is_stress_free,
          Law<L, double>,
          L::cost,
          L::sample,
          of_moduli};
}

template <class... Tag>
constexpr auto table_of(std::tuple<Tag...>) {
  return std::array{info_of<typename Tag::template Law<double, false>>()..., info_of<MassSpring>()};
}
constexpr auto law_table = table_of(LawList{});

static_assert(std::all_of(law_table.begin(), law_table.end(),
                          [](const LawInfo& law) { return &law == &law_table[law_index(law.name)]; }),
              "two laws of one name");

/// The problem of one value; empty if it is valid.
std::string value_problem(const ParameterInfo& info, double value) {
  const std::string unit = info.unit.empty() ? "" : fmt::format(" {}", info.unit);
  if (!std::isfinite(value)) return fmt::format("must be finite, is {}", value);
  switch (info.range) {
    case ParameterRange::any:
      return {};
    case ParameterRange::positive:
      return value > 0 ? std::string() : fmt::format("must be greater than 0{}, is {}", unit, value);
    case ParameterRange::not_negative:
      return value >= 0 ? std::string() : fmt::format("must be 0{} or more, is {}", unit, value);
    case ParameterRange::not_zero:
      return value != 0 ? std::string() : "must not be 0";
  }
  return {};
}

/// Of a law by expression, whose moduli at rest may be any.
std::optional<Problem> energy_problem(const Material& material) {
  try {
    energy_programs<double>(material);
  } catch (const EnergyError& error) {
    return Problem{"expression", error.what()};
  }
  return std::nullopt;
}

std::optional<Problem> parameter_problem(const Material& material, const LawInfo& law) {
  const std::vector<ParameterSlot> slots = parameter_slots(material, law);
  for (std::size_t i = 0; i < slots.size(); ++i)
    if (auto text = value_problem(*slots[i].info, material.parameters[i]); !text.empty())
      return Problem{slots[i].key(), std::move(text)};
  if (law.takes_young_poisson) {
    const double lambda = material.parameters[0], mu = material.parameters[1];
    if (!(3 * lambda + 2 * mu > 0))
      return Problem{"lambda", fmt::format("must be greater than -2/3 mu ({} Pa), is {}", -2 * mu / 3, lambda)};
  }
  if (find_energy_law(material.law)) return energy_problem(material);
  if (law.is_continuum) {
    const double shear = small_strain_moduli(material).shear;
    if (!(shear > 0))
      return Problem{std::string(law.parameters[0].name),
                     fmt::format("the shear modulus at rest must be greater than 0 Pa, is {}", shear)};
  }
  return std::nullopt;
}

/// The first problem of fibre, active stress, volume term, viscosity, relaxation or plasticity.
std::optional<Problem> inelastic_problem(const Material& material, const LawInfo& law) {
  const double Ta = material.active_stress;
  if (!(Ta >= 0) || !std::isfinite(Ta)) return Problem{"active_stress", fmt::format("must be 0 Pa or more, is {}", Ta)};
  if (Ta > 0 && !law.is_continuum) return Problem{"active_stress", fmt::format("the law '{}' has none", law.name)};
  const bool needs_fibre = law.has_fibre || Ta > 0 || !material.fibre.isZero(0);
  if (needs_fibre && material.fibre_field.empty() && !(std::abs(material.fibre.norm() - 1) < 1e-9))
    return Problem{"fibre", "must be a direction of length 1"};
  const auto needs_split = [&](const char* key) {
    return Problem{key, fmt::format("the law '{}' has no separate volume term", law.name)};
  };
  if (material.volume_term != VolumeTerm::quadratic && !law.has_volume_term) return needs_split("volume_term");
  for (const auto& [key, value] :
       {std::pair{"viscosity", material.viscosity}, std::pair{"bulk_viscosity", material.bulk_viscosity}}) {
    if (!(value >= 0) || !std::isfinite(value))
      return Problem{key, fmt::format("must be 0 Pa s or more, is {}", value)};
    if (value > 0 && !law.is_continuum) return Problem{key, fmt::format("the law '{}' has none", law.name)};
  }
  for (std::size_t i = 0; i < material.relaxation.size(); ++i) {
    const PronyTerm& term = material.relaxation[i];
    if (!(term.gamma > 0) || !std::isfinite(term.gamma))
      return Problem{fmt::format("relaxation[{}].gamma", i), fmt::format("must be greater than 0, is {}", term.gamma)};
    if (!(term.tau > 0) || !std::isfinite(term.tau))
      return Problem{fmt::format("relaxation[{}].tau", i), fmt::format("must be greater than 0 s, is {}", term.tau)};
  }
  if (!material.relaxation.empty() && !law.has_volume_term) return needs_split("relaxation");
  if (material.plasticity) {
    const auto& [yield, hardening] = *material.plasticity;
    if (!law.has_volume_term) return needs_split("plasticity");
    if (law.has_fibre) return Problem{"plasticity", "is for laws without fibres"};
    if (Ta > 0) return Problem{"plasticity", "is for materials without active stress"};
    if (!(yield > 0) || !std::isfinite(yield))
      return Problem{"plasticity.yield", fmt::format("must be greater than 0 Pa, is {}", yield)};
    if (!(hardening >= 0) || !std::isfinite(hardening))
      return Problem{"plasticity.hardening", fmt::format("must be 0 Pa or more, is {}", hardening)};
  }
  return std::nullopt;
}

}  // namespace

std::span<const LawInfo> laws() { return law_table; }

const LawInfo* find_law(std::string_view name) {
  for (const LawInfo& law : laws())
    if (law.name == name) return &law;
  const EnergyLaw* energy = find_energy_law(name);
  return energy ? &energy->info : nullptr;
}

Material sample_material(const LawInfo& law) { return sample_material(law, law.sample); }

Material sample_material(const LawInfo& law, SmallStrainModuli rest) {
  Material material;
  material.law = law.name;
  material.parameters = law.of_moduli(rest);
  if (law.has_fibre) material.fibre = Vec3::UnitX();
  assert(!material_problem(material));
  return material;
}

std::span<const std::string_view> volume_term_names() {
  static constexpr std::string_view names[] = {"quadratic", "logarithmic", "simo_taylor"};
  return names;
}

std::optional<Problem> material_problem(const Material& material) {
  const LawInfo* law = find_law(material.law);
  if (!law) return Problem{"law", fmt::format("'{}' is not a law of this build", material.law)};
  const std::size_t given = material.parameters.size();
  if (given < law->parameters.size() || given != parameter_slots(material, *law).size())
    return Problem{"law",
                   fmt::format("'{}' takes {} parameters, got {} values", law->name, law->parameters.size(), given)};
  if (auto problem = parameter_problem(material, *law)) return problem;
  if (auto problem = inelastic_problem(material, *law)) return problem;
  if (!(material.density > 0) || !std::isfinite(material.density))
    return Problem{"density", fmt::format("must be greater than 0 kg/m³, is {}", material.density)};
  return std::nullopt;
}

SmallStrainModuli small_strain_moduli(const Material& material) {
  const LawInfo* law = find_law(material.law);
  if (!law || !law->is_continuum) return {0, 0};
  Material plain = material;
  const Vec3 direction(0, 0, 1);
  if (law->has_fibre) plain.fibre = direction;
  const auto point = make_material_point(plain, true);
  const Mat3 I = Mat3::Identity();
  // Isochoric shear across the fibre, and change of volume alone. The stress at rest of the paper_* laws contributes to
  // both second variations, hence the terms in `rest`.
  Mat3 shear = Mat3::Zero();
  shear(0, 0) = 1, shear(1, 1) = -1;
  const double mu = point->first_piola_differential(I, shear).cwiseProduct(shear).sum() / 4;
  const double rest = point->first_piola(I)(0, 0);
  const double bulk = point->first_piola_differential(I, I).trace() / 9;
  return {mu + rest / 2, bulk - 2 * rest / 3};
}

LameParameters lame_parameters(double young, double poisson) {
  return {young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))};
}

EngineeringConstants engineering_constants(const LameParameters& lame) {
  return {lame.mu * (3 * lame.lambda + 2 * lame.mu) / (lame.lambda + lame.mu),
          lame.lambda / (2 * (lame.lambda + lame.mu))};
}

}  // namespace heml
