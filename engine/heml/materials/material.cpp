#include <fmt/format.h>

#include <array>
#include <cmath>
#include <heml/materials/laws.hpp>
#include <heml/materials/point.hpp>

namespace heml {
namespace {

using Problem = std::pair<std::string, std::string>;

template <class Tag>
LawInfo info_of(Tag) {
  using L = typename Tag::template Law<double, false>;
  const bool lame = std::size(L::parameters) == 2 && L::parameters[0].name == "lambda" && L::parameters[1].name == "mu";
  return {L::name, L::title, L::formula, L::source, L::parameters, lame, L::has_volume_term, L::uses_I4, true};
}

/// The paper's degenerate case: forces along the edges of the mesh (elastic/springs.hpp).
constexpr ParameterInfo spring_parameters[] = {{"stiffness", "k", "N/m", "of the spring along every edge"}};
constexpr LawInfo mass_spring = {"mass_spring",
                                 "Mass-spring net",
                                 "Σ over mesh edges of k/2 (ℓ − L)²",
                                 "Goulette & Chendeb 2006, section 1: the degenerate case",
                                 spring_parameters,
                                 false,
                                 false,
                                 false,
                                 false};

const auto& law_table() {
  static const auto table = std::apply([](auto... tag) { return std::array{info_of(tag)..., mass_spring}; }, LawList{});
  return table;
}

std::size_t list_length(const Material& material, const LawInfo& law) {
  std::size_t lists = 0;
  for (const ParameterInfo& info : law.parameters) lists += info.list;
  return lists ? (material.parameters.size() - (law.parameters.size() - lists)) / lists : 0;
}

bool has_right_count(const Material& material, const LawInfo& law) {
  std::size_t lists = 0;
  for (const ParameterInfo& info : law.parameters) lists += info.list;
  const std::size_t scalars = law.parameters.size() - lists, given = material.parameters.size();
  if (lists == 0) return given == scalars;
  return given >= scalars + lists && (given - scalars) % lists == 0;
}

/// What is wrong with one value, beyond not being finite; empty: nothing.
std::string value_problem(const LawInfo& law, std::string_view name, double value) {
  const auto positive = [&](const char* unit) {
    return value > 0 ? std::string() : fmt::format("must be greater than 0{}, is {}", unit, value);
  };
  const auto not_negative = [&](const char* unit) {
    return value >= 0 ? std::string() : fmt::format("must be 0{} or more, is {}", unit, value);
  };
  if (name == "kappa" || name == "k1") return law.name.starts_with("paper_") ? not_negative(" Pa") : positive(" Pa");
  if (name == "gamma" || name == "beta" || name == "k2" || name == "Jm") return positive("");
  if (name == "stiffness") return positive(" N/m");
  if (name == "c1" || name == "C10" || (name == "K1" && law.name != "mooney_rivlin")) return positive(" Pa");
  if (name == "mu" && !law.takes_young_poisson && law.name != "ogden") return positive(" Pa");
  if (name == "alpha" && value == 0) return "must not be 0";
  return {};
}

std::optional<Problem> parameter_problem(const Material& material, const LawInfo& law) {
  const std::size_t length = list_length(material, law);
  std::size_t next = 0;
  for (const ParameterInfo& info : law.parameters)
    for (std::size_t k = 0; k < (info.list ? length : 1); ++k, ++next) {
      const double value = material.parameters[next];
      const std::string name = info.list ? fmt::format("{}[{}]", info.name, k) : std::string(info.name);
      if (!std::isfinite(value)) return Problem{name, fmt::format("must be finite, is {}", value)};
      if (auto text = value_problem(law, info.name, value); !text.empty()) return Problem{name, std::move(text)};
    }
  if (law.takes_young_poisson) {
    const double lambda = material.parameters[0], mu = material.parameters[1];
    if (!(mu > 0)) return Problem{"mu", fmt::format("must be greater than 0 Pa, is {}", mu)};
    if (!(3 * lambda + 2 * mu > 0))
      return Problem{"lambda", fmt::format("must be greater than -2/3 mu ({} Pa), is {}", -2 * mu / 3, lambda)};
  }
  if (law.is_continuum) {
    const double shear = ground_state(material).shear;
    if (!(shear > 0))
      return Problem{std::string(law.parameters[0].name),
                     fmt::format("the shear modulus at rest must be greater than 0 Pa, is {}", shear)};
  }
  return std::nullopt;
}

/// What is wrong with what acts beside elasticity.
std::optional<Problem> beside_problem(const Material& material, const LawInfo& law) {
  if (law.has_fibre && material.fibre_field.empty() && !(std::abs(material.fibre.norm() - 1) < 1e-9))
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
    if (!(yield > 0) || !std::isfinite(yield))
      return Problem{"plasticity.yield", fmt::format("must be greater than 0 Pa, is {}", yield)};
    if (!(hardening >= 0) || !std::isfinite(hardening))
      return Problem{"plasticity.hardening", fmt::format("must be 0 Pa or more, is {}", hardening)};
  }
  return std::nullopt;
}

}  // namespace

std::span<const LawInfo> laws() { return law_table(); }

const LawInfo* find_law(std::string_view name) {
  for (const LawInfo& law : laws())
    if (law.name == name) return &law;
  return nullptr;
}

std::span<const std::string_view> volume_term_names() {
  static constexpr std::string_view names[] = {"quadratic", "logarithmic", "simo_taylor"};
  return names;
}

std::optional<Problem> material_problem(const Material& material) {
  const LawInfo* law = find_law(material.law);
  if (!law) return Problem{"law", fmt::format("'{}' is not a law of this build", material.law)};
  if (!has_right_count(material, *law))
    return Problem{"law", fmt::format("'{}' takes {} parameters, got {} values", law->name, law->parameters.size(),
                                      material.parameters.size())};
  if (auto problem = parameter_problem(material, *law)) return problem;
  if (auto problem = beside_problem(material, *law)) return problem;
  if (!(material.density > 0) || !std::isfinite(material.density))
    return Problem{"density", fmt::format("must be greater than 0 kg/m³, is {}", material.density)};
  return std::nullopt;
}

GroundState ground_state(const Material& material) {
  const LawInfo* law = find_law(material.law);
  if (!law || !law->is_continuum) return {0, 0};
  Material plain = material;
  const Vec3 direction(0, 0, 1);
  if (law->has_fibre) plain.fibre = direction;
  const auto point = make_material_point(plain, true);
  const Mat3 I = Mat3::Identity();
  // Shear across the fibre that keeps volume, and change of volume alone: laws of the paper as printed have stress at
  // rest, which bears part of the second variation of both.
  Mat3 shear = Mat3::Zero();
  shear(0, 0) = 1, shear(1, 1) = -1;
  const double mu = point->first_piola_differential(I, shear).cwiseProduct(shear).sum() / 4;
  const double rest = point->first_piola(I)(0, 0);
  const double bulk = point->first_piola_differential(I, I).trace() / 9;
  return {mu + rest / 2, bulk - 2 * rest / 3};
}

Lame lame_from(double young, double poisson) {
  return {young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))};
}

Engineering engineering_from(const Lame& lame) {
  return {lame.mu * (3 * lame.lambda + 2 * lame.mu) / (lame.lambda + lame.mu),
          lame.lambda / (2 * (lame.lambda + lame.mu))};
}

}  // namespace heml
