#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/materials/energy_law.hpp>
#include <heml/materials/parameter_slots.hpp>
#include <heml/scenario/energy_json.hpp>
#include <heml/scenario/material_json.hpp>
#include <heml/scenario/presets.hpp>
#include <heml/scenario/scene_keys.hpp>
#include <heml/scenario/vector_json.hpp>
#include <heml/scenario/young_poisson.hpp>

namespace heml {
namespace {

/// Reads `law`, and with "energy" its expression and parameters.
const LawInfo& law_from(const JsonCursor& entry, Material& material) {
  std::vector<std::string_view> names;
  for (const LawInfo& law : laws()) names.push_back(law.name);
  names.push_back("energy");
  const std::size_t which = entry["law"].one_of(names);
  if (which < laws().size())
    material.law = laws()[which].name;
  else
    read_energy(entry, material);
  return *find_law(material.law);
}

bool is_energy(const LawInfo& law) { return law.name == "energy"; }

/// Keys that only some laws accept: the last of `materials[]`.
struct ParticularKey {
  std::string_view name;
  bool (*taken_by)(const LawInfo&);
};
constexpr ParticularKey particular_keys[] = {
    {"expression", is_energy},
    {"parameters", is_energy},
    {"fibre", [](const LawInfo& law) { return law.has_fibre || is_energy(law); }},
    {"active_stress", [](const LawInfo& law) { return law.is_continuum; }},
    {"volume_term", [](const LawInfo& law) { return law.has_volume_term; }},
    {"viscosity", [](const LawInfo& law) { return law.is_continuum; }},
    {"bulk_viscosity", [](const LawInfo& law) { return law.is_continuum; }},
    {"relaxation", [](const LawInfo& law) { return law.has_volume_term; }},
    {"plasticity", [](const LawInfo& law) { return law.has_volume_term && !law.has_fibre; }},
};
constexpr std::span<const KeyInfo> material_keys = keys_of("materials[]");
static_assert(std::equal(std::begin(particular_keys), std::end(particular_keys),
                         material_keys.last(std::size(particular_keys)).begin(),
                         [](const ParticularKey& key, const KeyInfo& info) { return key.name == info.name; }));

/// Refuses keys that the law does not accept.
ObjectReader entry_of(const LawInfo& law, const JsonCursor& entry) {
  std::vector<std::string_view> names;
  for (const KeyInfo& key : material_keys.first(material_keys.size() - std::size(particular_keys)))
    if (takes_key(law, key.name)) names.push_back(key.name);
  if (!is_energy(law))
    for (const ParameterInfo& info : law.parameters) names.push_back(info.name);
  for (const ParticularKey& key : particular_keys) {
    const bool fibre_of_muscle = key.name == "fibre" && law.is_continuum && entry.has("active_stress");
    if (key.taken_by(law) || fibre_of_muscle) {
      names.push_back(key.name);
    } else if (const auto given = entry.find(key.name)) {
      std::vector<std::string_view> others;
      for (const LawInfo& other : laws())
        if (key.taken_by(other)) others.push_back(other.name);
      if (others.empty()) others.push_back("energy");
      given->fail(fmt::format("does not go with the law '{}'", law.name),
                  fmt::format("it goes with {}", fmt::join(others, ", ")));
    }
  }
  return ObjectReader(entry, material_keys, names);
}

void add_scalar(const Quantity& quantity, Material& material) {
  if (!quantity.field.empty()) material.fields.push_back({material.parameters.size(), quantity.field});
  material.parameters.push_back(quantity.value);
}

/// Adds λ and μ computed from young and poisson; as fields where one of the two is a field.
void add_young_poisson(const YoungPoisson& pair, Material& material) {
  if (pair.young.field.empty() && pair.poisson.field.empty()) {
    const LameParameters lame = lame_parameters(pair.young.value, pair.poisson.value);
    material.parameters = {lame.lambda, lame.mu};
  } else {
    for (const char* parameter : {"lambda", "mu"}) add_scalar({1, lame_field(parameter, pair)}, material);
  }
}

/// Whether the entry gives young and poisson rather than lambda and mu.
bool is_engineering(const JsonCursor& entry) {
  const bool engineering = entry.has("young") || entry.has("poisson");
  const bool lame = entry.has("lambda") || entry.has("mu");
  if (engineering && lame) entry.fail("mixes young, poisson with lambda, mu", "give one pair only");
  if (!engineering && !lame) entry.fail("'young' is missing", "give young and poisson, or lambda and mu");
  return engineering;
}

void read_parameters(const JsonCursor& entry, const LawInfo& law, Material& material) {
  if (law.takes_young_poisson && is_engineering(entry)) return add_young_poisson(young_poisson_from(entry), material);
  const ParameterInfo* first_list = nullptr;
  for (const ParameterInfo& info : law.parameters) {
    const JsonCursor key = entry[info.name];
    if (!info.is_list()) {
      add_scalar(quantity_from(key), material);
      continue;
    }
    if (!first_list) first_list = &info;
    if (key.size() == 0) key.fail("is empty", "give one number a term");
    if (const std::size_t length = entry[first_list->name].size(); key.size() != length)
      key.fail(fmt::format("has {} numbers, '{}' has {}", key.size(), first_list->name, length),
               "give as many of each");
    key.each([&](const JsonCursor& number) { material.parameters.push_back(number.number()); });
  }
}

void read_fibre(const JsonCursor& key, Material& material) {
  if (key.json().is_object())
    material.fibre_field = quantity_from(key).field;
  else
    material.fibre = key.direction();
}

/// Reads viscosity, relaxation and plasticity.
void read_memory(const ObjectReader& entry, Material& material) {
  entry.read("viscosity", material.viscosity);
  entry.read("bulk_viscosity", material.bulk_viscosity);
  if (const auto relaxation = entry.find("relaxation"))
    relaxation->each([&](const JsonCursor& key) {
      const ObjectReader term(key, keys_of("materials[].relaxation[]"));
      const double gamma = term.get<double>("gamma");
      material.relaxation.push_back({gamma, term.get<double>("tau")});
    });
  if (const auto key = entry.find("plasticity")) {
    const ObjectReader plasticity(*key, keys_of("materials[].plasticity"));
    material.plasticity = {plasticity.get<double>("yield"), 0};
    plasticity.read("hardening", material.plasticity->hardening);
  }
}

/// Checks the parameters together. Materials with fields are checked by resolve_fields().
void check_values(const JsonCursor& entry, const Material& material) {
  if (!material.fields.empty()) return;
  for (const double value : material.parameters)
    if (!std::isfinite(value)) entry.fail("its parameters overflow", "use smaller values");
  if (const auto problem = material_problem(material)) {
    if (const auto key = entry.find(problem->first)) key->fail(problem->second, "");
    entry.fail(fmt::format("{}: {}", problem->first, problem->second), "");
  }
}

Json parameters_json(const Material& material, const LawInfo& law) {
  std::vector<Quantity> quantities;
  for (const double value : material.parameters) quantities.push_back({value, ""});
  for (const FieldParameter& field : material.fields) quantities.at(field.parameter).field = field.field;
  Json json = Json::object();
  const std::vector<ParameterSlot> slots = parameter_slots(material, law);
  if (law.takes_young_poisson)
    if (const auto pair = young_poisson_behind(quantities.at(0).field))
      if (lame_field("lambda", *pair) == quantities.at(0).field && lame_field("mu", *pair) == quantities.at(1).field)
        return {{"young", quantity_json(pair->young)}, {"poisson", quantity_json(pair->poisson)}};
  for (std::size_t i = 0; i < slots.size(); ++i) {
    Json& value = json[std::string(slots[i].info->name)];
    if (slots[i].info->is_list())
      value.push_back(quantities.at(i).value);
    else
      value = quantity_json(quantities.at(i));
  }
  return json;
}

}  // namespace

bool uses_fields(const Material& material) { return !material.fields.empty() || !material.fibre_field.empty(); }

bool takes_key(const LawInfo& law, std::string_view name) {
  for (const ParticularKey& key : particular_keys)
    if (key.name == name) return key.taken_by(law);
  return law.takes_young_poisson || (name != "young" && name != "poisson");
}

RegionMaterial material_from(const JsonCursor& key) {
  if (key.has("preset")) return preset_entry(key);
  RegionMaterial result;
  Material& material = result.material;
  const LawInfo& law = law_from(key, material);
  const ObjectReader entry = entry_of(law, key);
  entry.read("region", result.region);
  entry.read("density", material.density);
  if (!is_energy(law)) read_parameters(key, law, material);
  entry.read("active_stress", material.active_stress);
  const bool needs_fibre = law.has_fibre || entry.find("active_stress");
  if (needs_fibre) read_fibre(key["fibre"], material);
  // An expression without I4 may have a fibre all the same.
  if (const auto fibre = key.find("fibre"); fibre && !needs_fibre) fibre->direction();
  entry.read("volume_term", material.volume_term);
  read_memory(entry, material);
  check_values(key, material);
  if (is_energy(law) && material.fibre_field.empty()) warn_energy(key, material);
  return result;
}

Material lone_material_from(const JsonCursor& key) {
  Material material = material_from(key).material;
  if (uses_fields(material))
    throw InputError(key.file(), key.place(), "takes a field of a mesh, and there is no mesh here", "give numbers");
  return material;
}

Json material_json(const RegionMaterial& entry) {
  const Material& material = entry.material;
  Json json;
  if (entry.region) json["region"] = *entry.region;
  const LawInfo* law = find_law(material.law);
  json["law"] = law && is_energy(*law) ? law->name : std::string_view(material.law);
  if (law) {
    json.update(is_energy(*law) ? energy_json(material) : parameters_json(material, *law));
    if (!material.fibre_field.empty())
      json["fibre"] = {{"field", material.fibre_field}};
    else if (material.gives_fibre())
      json["fibre"] = vector_json(material.fibre);
    if (material.active_stress > 0 || (material.gives_fibre() && !law->has_fibre))
      json["active_stress"] = material.active_stress;
  }
  if (material.volume_term != VolumeTerm::quadratic)
    json["volume_term"] = volume_term_names()[static_cast<std::size_t>(material.volume_term)];
  if (material.viscosity > 0) json["viscosity"] = material.viscosity;
  if (material.bulk_viscosity > 0) json["bulk_viscosity"] = material.bulk_viscosity;
  for (const PronyTerm& term : material.relaxation)
    json["relaxation"].push_back({{"gamma", term.gamma}, {"tau", term.tau}});
  if (material.plasticity)
    json["plasticity"] = {{"yield", material.plasticity->yield}, {"hardening", material.plasticity->hardening}};
  json["density"] = material.density;
  return json;
}

}  // namespace heml
