#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <heml/scenario/material_json.hpp>
#include <limits>
#include <stdexcept>

namespace heml {
namespace {

/// Laws of the scene format, whether or not this build can run them.
constexpr std::string_view known_laws[] = {"stvk",         "neo_hookean", "neo_hookean_iso", "mooney_rivlin",
                                           "fung_demiray", "ogden",       "hgo",             "mass_spring"};

const LawInfo& law_from(const Key& key) {
  const std::string name = key.text();
  if (const LawInfo* info = find_law(name)) return *info;
  std::vector<std::string_view> available;
  for (const LawInfo& info : laws()) available.push_back(info.name);
  if (std::find(std::begin(known_laws), std::end(known_laws), name) != std::end(known_laws))
    key.fail(fmt::format("the law '{}' is not part of this build", name),
             fmt::format("available: {}", fmt::join(available, ", ")));
  key.one_of(available);  // always throws: the name is none of them
  throw std::logic_error("find_law and laws disagree");
}

double poisson_from(const Key& key) {
  const double value = key.number();
  if (value == 0.5) key.refuse("incompressible has no finite lambda: use a value close to it, like 0.49");
  if (!(value > -1 && value < 0.5)) key.refuse("must be greater than -1 and less than 0.5");
  return value;
}

/// λ and μ from whichever of the two pairs is given.
Lame lame_of(const Key& entry) {
  const bool engineering = entry.has("young") || entry.has("poisson");
  const bool lame = entry.has("lambda") || entry.has("mu");
  if (engineering && lame) entry.fail("mixes young, poisson with lambda, mu", "give one pair only");
  if (!engineering && !lame) entry.fail("'young' is missing", "give young and poisson, or lambda and mu");
  if (lame) return {entry["lambda"].number(), entry["mu"].number()};
  return lame_from(entry["young"].positive(), poisson_from(entry["poisson"]));
}

std::vector<double> parameters_from(const Key& entry, const LawInfo& law) {
  const bool elastic_pair = law.takes_young_poisson;
  const Lame lame = elastic_pair ? lame_of(entry) : Lame{};
  std::vector<double> parameters;
  for (const ParameterInfo& info : law.parameters) {
    if (elastic_pair && info.name == "lambda")
      parameters.push_back(lame.lambda);
    else if (elastic_pair && info.name == "mu")
      parameters.push_back(lame.mu);
    else
      parameters.push_back(entry[info.name].number());
  }
  return parameters;
}

}  // namespace

RegionMaterial material_from(const Key& entry) {
  RegionMaterial result;
  const LawInfo& law = law_from(entry["law"]);
  std::vector<std::string_view> names = {"law", "region", "density"};
  if (law.takes_young_poisson) names.insert(names.end(), {"young", "poisson"});
  for (const ParameterInfo& info : law.parameters) names.push_back(info.name);
  entry.allow(names);

  if (const auto region = entry.find("region"))
    result.region = static_cast<int>(region->integer(std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
  if (const auto density = entry.find("density")) result.material.density = density->positive();
  result.material.law = law.name;
  result.material.parameters = parameters_from(entry, law);
  for (const double value : result.material.parameters)
    if (!std::isfinite(value)) entry.fail("its parameters overflow", "use smaller values");
  if (const auto problem = material_problem(result.material)) {
    if (const auto key = entry.find(problem->first)) key->fail(problem->second, "");
    entry.fail(fmt::format("{}: {}", problem->first, problem->second), "");
  }
  return result;
}

Json material_json(const RegionMaterial& entry) {
  Json json;
  if (entry.region) json["region"] = *entry.region;
  json["law"] = entry.material.law;
  const LawInfo* law = find_law(entry.material.law);
  for (std::size_t i = 0; law && i < law->parameters.size(); ++i)
    json[std::string(law->parameters[i].name)] = entry.material.parameters.at(i);
  json["density"] = entry.material.density;
  return json;
}

}  // namespace heml
