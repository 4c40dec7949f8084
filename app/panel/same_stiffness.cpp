#include <algorithm>
#include <app/panel/same_stiffness.hpp>
#include <map>

namespace heml::panel {

SmallStrain small_strain(const LawInfo& law, const std::vector<double>& parameters) {
  std::map<std::string_view, double> by_name;
  for (std::size_t i = 0; i < law.parameters.size() && i < parameters.size(); ++i)
    by_name[law.parameters[i].name] = parameters[i];
  const auto get = [&](std::string_view name) { return by_name.count(name) ? by_name[name] : 0.0; };
  const double shear = get("mu") + 2 * (get("K1") + get("K2"));
  return {shear, by_name.count("kappa") ? get("kappa") : get("lambda") + 2 * shear / 3};
}

Material same_stiffness(const Material& material, const LawInfo& from, const LawInfo& to) {
  const SmallStrain moduli = small_strain(from, material.parameters);
  const bool two_terms =
      std::any_of(to.parameters.begin(), to.parameters.end(), [](const auto& p) { return p.name == "K2"; });
  // Mooney and Rivlin's second term usually carries about a fifth of a soft tissue's stiffness.
  const double first_share = two_terms ? 0.8 : 1.0;
  const auto value = [&](std::string_view name) {
    if (name == "mu") return moduli.shear;
    if (name == "lambda") return moduli.bulk - 2 * moduli.shear / 3;
    if (name == "kappa") return moduli.bulk;
    if (name == "K1") return first_share * moduli.shear / 2;
    if (name == "K2") return (1 - first_share) * moduli.shear / 2;
    if (name == "k1") return moduli.shear;
    return 1.0;
  };
  Material result{std::string(to.name), {}, material.density};
  for (const ParameterInfo& parameter : to.parameters) result.parameters.push_back(value(parameter.name));
  return result;
}

}  // namespace heml::panel
