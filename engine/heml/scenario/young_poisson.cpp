#include <fmt/format.h>

#include <cmath>
#include <heml/base/error.hpp>
#include <heml/scenario/scene_keys.hpp>
#include <heml/scenario/young_poisson.hpp>

namespace heml {
namespace {

Quantity checked(const JsonCursor& key, std::string (*problem)(double)) {
  const Quantity quantity = quantity_from(key);
  if (!quantity.field.empty()) return quantity;
  if (const std::string text = problem(quantity.value); !text.empty()) key.refuse(text);
  return quantity;
}

}  // namespace

Quantity quantity_from(const JsonCursor& key) {
  if (!key.json().is_object()) {
    if (!key.json().is_number()) key.refuse("must be a number, or {\"field\": ...} of the mesh");
    return {key.number(), ""};
  }
  const std::string field = ObjectReader(key, keys_of("materials[].young")).get<std::string>("field");
  if (field.empty()) key["field"].refuse("must be the name of a field of the mesh");
  return {1, field};
}

Json quantity_json(const Quantity& quantity) {
  return quantity.field.empty() ? Json(quantity.value) : Json{{"field", quantity.field}};
}

std::string young_problem(double young) { return young > 0 && std::isfinite(young) ? "" : "must be greater than 0"; }

std::string poisson_problem(double poisson) {
  if (poisson == 0.5) return "incompressible has no finite lambda: use a value close to it, like 0.49";
  return poisson > -1 && poisson < 0.5 ? "" : "must be greater than -1 and less than 0.5";
}

YoungPoisson young_poisson_from(const JsonCursor& entry) {
  return {checked(entry["young"], young_problem), checked(entry["poisson"], poisson_problem)};
}

std::string lame_field(std::string_view parameter, const YoungPoisson& pair) {
  const Json json = {{"young", quantity_json(pair.young)}, {"poisson", quantity_json(pair.poisson)}};
  return fmt::format("{} {}", parameter, json_text(json, ""));
}

std::optional<YoungPoisson> young_poisson_behind(std::string_view field) {
  const std::size_t json_begin = field.find('{');
  if (!field.starts_with("lambda {") && !field.starts_with("mu {")) return std::nullopt;
  try {
    const Json json = parse_json(field.substr(json_begin), "");
    const JsonCursor key(json, "");
    key.allow({"young", "poisson"});
    return young_poisson_from(key);
  } catch (const InputError&) {  // a field of the file with a similar name
    return std::nullopt;
  }
}

}  // namespace heml
