#include <fmt/format.h>
#include <fmt/ranges.h>

#include <heml/materials/energy_law.hpp>
#include <map>
#include <mutex>

namespace heml {
namespace {

constexpr std::string_view prefix = "energy(";

/// A law and the programs compiled last, which a body and its checks ask for several times.
struct KnownEnergy {
  EnergyLaw law;
  std::vector<double> parameters;
  std::shared_ptr<const EnergyPrograms<float>> in_float;
  std::shared_ptr<const EnergyPrograms<double>> in_double;

  template <class Real>
  auto& programs() {
    if constexpr (std::is_same_v<Real, float>)
      return in_float;
    else
      return in_double;
  }
};

/// Laws by their definitions.
class EnergyRegistry {
 public:
  /// Null if the definition is none. The caller holds the lock.
  KnownEnergy* find(std::string_view definition) {
    if (!definition.starts_with(prefix)) return nullptr;
    const auto found = known_.find(definition);
    if (found != known_.end()) return found->second.get();
    auto made = make(definition);
    if (!made) return nullptr;
    return known_.emplace(definition, std::move(made)).first->second.get();
  }

  std::mutex lock;

 private:
  static std::unique_ptr<KnownEnergy> make(std::string_view definition) {
    const std::size_t end = definition.find(")=");
    if (end == std::string_view::npos) return nullptr;
    auto known = std::make_unique<KnownEnergy>();
    EnergyLaw& law = known->law;
    law.definition = definition, law.text = definition.substr(end + 2);
    for (std::string_view left = definition.substr(prefix.size(), end - prefix.size()); !left.empty();) {
      const std::size_t comma = std::min(left.find(','), left.size());
      law.names.emplace_back(left.substr(0, comma));
      if (!energy_name_problem(law.names.back()).empty()) return nullptr;
      left.remove_prefix(std::min(comma + 1, left.size()));
    }
    try {
      law.expression = parse_energy(law.text, law.names);
    } catch (const EnergyError&) {
      return nullptr;
    }
    for (const std::string& name : law.names)
      law.parameters.push_back({name, name, "", "parameter of the expression", ParameterRange::any, 1});
    describe(law);
    return known;
  }

  static void describe(EnergyLaw& law) {
    const bool stretches = law.expression.uses_stretches();
    const double nodes = static_cast<double>(law.expression.nodes.size());
    law.info = {"energy",       "Energy by expression",
                law.text,       "the scene",
                law.parameters, false,
                false,          law.expression.uses_fibre(),
                stretches,      true,
                true,           {10 + nodes + (stretches ? 150 : 0), 5 + nodes / 2 + (stretches ? 60 : 0)},
                {1e3, 5e4},     [](SmallStrainModuli) { return std::vector<double>(); }};
  }

  std::map<std::string, std::unique_ptr<KnownEnergy>, std::less<>> known_;
};

EnergyRegistry& energy_registry() {
  static EnergyRegistry laws;
  return laws;
}

}  // namespace

std::string energy_definition(std::string_view text, const std::vector<std::string>& names) {
  return fmt::format("{}{})={}", prefix, fmt::join(names, ","), text);
}

const EnergyLaw* find_energy_law(std::string_view definition) {
  EnergyRegistry& laws = energy_registry();
  const std::lock_guard lock(laws.lock);
  const KnownEnergy* known = laws.find(definition);
  return known ? &known->law : nullptr;
}

template <class Real>
std::shared_ptr<const EnergyPrograms<Real>> energy_programs(const Material& material) {
  EnergyRegistry& laws = energy_registry();
  const std::lock_guard lock(laws.lock);
  KnownEnergy& known = *laws.find(material.law);
  if (known.parameters != material.parameters) {
    known.in_float.reset();
    known.in_double.reset();
    known.parameters = material.parameters;
  }
  auto& programs = known.template programs<Real>();
  if (!programs)
    programs =
        std::make_shared<const EnergyPrograms<Real>>(compile_energy<Real>(known.law.expression, material.parameters));
  return programs;
}

template std::shared_ptr<const EnergyPrograms<float>> energy_programs(const Material&);
template std::shared_ptr<const EnergyPrograms<double>> energy_programs(const Material&);

}  // namespace heml
