#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <heml/base/log.hpp>
#include <heml/materials/energy_law.hpp>
#include <heml/materials/point.hpp>
#include <heml/scenario/energy_json.hpp>
#include <heml/scenario/json_text.hpp>

namespace heml {

void read_energy(const JsonCursor& entry, Material& material) {
  std::vector<std::string> names;
  if (const auto parameters = entry.find("parameters")) {
    if (!parameters->json().is_object())
      parameters->refuse("must be an object: a number for each name of the expression");
    for (const auto& [name, value] : parameters->json().items()) {
      const JsonCursor key = (*parameters)[name];
      if (const std::string problem = energy_name_problem(name); !problem.empty())
        key.fail(fmt::format("the name {}", problem),
                 fmt::format("letters, digits and _, and none of {}, {}", fmt::join(energy_variables(), ", "),
                             fmt::join(energy_functions(), ", ")));
      names.push_back(name);
      material.parameters.push_back(key.number());
    }
  }
  const JsonCursor key = entry["expression"];
  const std::string text = key.text();
  try {
    parse_energy(text, names);
    material.law = energy_definition(text, names);
    energy_programs<double>(material);
  } catch (const EnergyError& error) {
    key.fail(fmt::format("column {}: {}", error.column, error.what()), "");
  }
}

void warn_energy(const JsonCursor& entry, const Material& material) {
  const auto point = make_material_point(material, false);
  const Mat3 I = Mat3::Identity();
  const std::string place = entry.place().empty() ? entry.file() : fmt::format("{}: {}", entry.file(), entry.place());
  if (!point->valid(I)) return warn("{}: the energy is not defined at rest", place);
  const SmallStrainModuli moduli = small_strain_moduli(material);
  const double stress = point->first_piola(I).cwiseAbs().maxCoeff();
  if (stress > 1e-9 * (std::abs(moduli.shear) + std::abs(moduli.bulk)))
    warn("{}: the stress at rest is not zero: {:.3g} Pa", place, stress);
  if (!(moduli.shear > 0) || !(moduli.bulk > 0))
    warn("{}: unstable at rest: shear modulus {:.3g} Pa, bulk modulus {:.3g} Pa", place, moduli.shear, moduli.bulk);
}

std::string energy_setup_problem(const Material& material, bool continuation) {
  if (!find_energy_law(material.law)) return {};
  if (continuation) return "a law by expression has no continuation past the end of its range";
  if (material.fibre_field.empty() && !make_material_point(material, false)->valid(Mat3::Identity()))
    return "the energy is not defined at rest";
  return {};
}

Json energy_json(const Material& material) {
  const EnergyLaw& law = *find_energy_law(material.law);
  Json json = {{"law", "energy"}, {"expression", law.text}};
  json["parameters"] = Json::object();
  for (std::size_t i = 0; i < law.names.size(); ++i) json["parameters"][law.names[i]] = material.parameters[i];
  return json;
}

}  // namespace heml
