#include <fmt/format.h>

#include <algorithm>
#include <heml/base/error.hpp>
#include <heml/scenario/json_text.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/text_file.hpp>
#include <studies/stability/study.hpp>

namespace heml::stability {
namespace {

bool holds(Verdict verdict) { return verdict == Verdict::stable || verdict == Verdict::recovered; }

/// Single precision needs a margin of a tenth, since rounding differs between processors.
bool can_be_promised(const Cell& cell) {
  const double limit = case_numbered(cell.number).limit_of(cell.variant);
  return holds(cell.verdict) && cell.outcome.value <= (cell.variant.single ? 0.9 : 1) * limit;
}

Promise promise_from(const Json& json, const std::string& file, const std::string& place) {
  try {
    Promise promise;
    promise.number = json.at("case");
    if (json.contains("integrator")) {
      promise.integrator = find_integrator(json["integrator"].get<std::string>());
      if (!promise.integrator) throw InputError(file, place + ".integrator", "is none of this build");
    }
    promise.single = json.at("precision") == "float";
    promise.limit = json.at("limit");
    promise.laws = json.at("laws").get<std::vector<std::string>>();
    return promise;
  } catch (const Json::exception& error) {
    throw InputError(file, place, error.what(), "case, integrator, precision, limit and laws are expected");
  }
}

}  // namespace

std::filesystem::path promises_file() { return assets_folder() / "studies" / "promised.json"; }

std::vector<Promise> read_promises(const std::filesystem::path& file) {
  const Json json = parse_json(read_text_file(file), file.string());
  if (!json.is_array()) throw InputError(file.string(), "", "holds no list");
  std::vector<Promise> promises;
  for (std::size_t k = 0; k < json.size(); ++k)
    promises.push_back(promise_from(json[k], file.string(), fmt::format("[{}]", k)));
  return promises;
}

std::string promises_text(const std::vector<Cell>& cells) {
  std::vector<Promise> promises;
  for (const Case& c : cases())
    for (const bool single : {false, true}) {
      std::vector<std::optional<Integrator>> integrators(c.integrators.begin(), c.integrators.end());
      if (integrators.empty()) integrators.emplace_back();
      for (const auto& integrator : integrators) {
        Promise promise{c.number, integrator, single, single ? c.float_limit : c.limit, {}};
        for (const Cell& cell : cells)
          if (cell.number == c.number && cell.variant.integrator == integrator && cell.variant.single == single &&
              can_be_promised(cell))
            promise.laws.push_back(cell.variant.law);
        if (!promise.laws.empty()) promises.push_back(std::move(promise));
      }
    }
  std::string text = "[\n";
  for (const Promise& promise : promises) {
    Json json = {{"case", promise.number}, {"name", case_numbered(promise.number).name}};
    if (promise.integrator) json["integrator"] = integrator_name(*promise.integrator);
    json["precision"] = promise.single ? "float" : "double";
    json["limit"] = promise.limit;
    json["laws"] = promise.laws;
    text += "  " + json.dump() + (&promise == &promises.back() ? "\n" : ",\n");
  }
  return text + "]\n";
}

void check_promises(const std::vector<Promise>& promises, std::vector<Cell>& cells) {
  for (Cell& cell : cells)
    for (const Promise& promise : promises) {
      if (promise.number != cell.number || promise.integrator != cell.variant.integrator ||
          promise.single != cell.variant.single ||
          std::find(promise.laws.begin(), promise.laws.end(), cell.variant.law) == promise.laws.end())
        continue;
      cell.promised = true;
      cell.short_of_promise = !holds(cell.verdict) || !(cell.outcome.value <= promise.limit);
    }
}

}  // namespace heml::stability
