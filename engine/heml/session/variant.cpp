#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <heml/base/error.hpp>
#include <heml/materials/energy_law.hpp>
#include <heml/materials/match_moduli.hpp>
#include <heml/session/variant.hpp>
#include <string_view>

namespace heml {
namespace {

/// Changes a variant by one word. Returns whether the word is known.
bool apply_word(std::string_view word, Variant& variant) {
  SolverSettings& solver = variant.setup.solver;
  if (const LawInfo* law = find_law(word); law && !find_energy_law(word)) {
    variant.has_law = true;
    for (RegionMaterial& entry : variant.setup.materials)
      if (entry.material.law != law->name)
        entry.material = match_moduli(entry.material, *find_law(entry.material.law), *law);
    return true;
  }
  if (const auto integrator = find_integrator(std::string(word))) {
    if (*integrator == Integrator::static_equilibrium) return false;
    variant.has_integrator = true;
    solver.integrator = *integrator;
    return true;
  }
  if (word == "float" || word == "double") {
    solver.single_precision = word == "float";
    return true;
  }
  const bool is_linear = word == "p1" || word == "nodal_pressure", is_quadratic = word == "p2" || word == "p2_pressure";
  if (solver.quadratic ? is_quadratic : is_linear) {
    solver.nodal_pressure = word.ends_with("pressure");
    return true;
  }
  return false;
}

}  // namespace

std::vector<std::string> variant_words() {
  std::vector<std::string> words;
  for (const LawInfo& law : laws()) words.emplace_back(law.name);
  for (const IntegratorInfo& info : all_integrators())
    if (info.kind != IntegratorKind::equilibrium) words.emplace_back(info.name);
  for (const char* word : {"float", "double", "p1", "nodal_pressure", "p2", "p2_pressure"}) words.emplace_back(word);
  return words;
}

std::string variant_name(const WorldSetup& setup) {
  std::vector<std::string> words;
  for (const RegionMaterial& entry : setup.materials)
    if (std::find(words.begin(), words.end(), entry.material.law) == words.end()) words.push_back(entry.material.law);
  return fmt::format("{}, {}", fmt::join(words, " and "), integrator_name(setup.solver.integrator));
}

Variant variant_of(WorldSetup setup, const std::string& words) {
  Variant variant{words, false, false, std::move(setup)};
  const bool was_static = variant.setup.solver.is_static();
  std::string_view rest = words;
  while (true) {
    const std::size_t end = std::min(rest.find('+'), rest.size());
    if (!apply_word(rest.substr(0, end), variant))
      throw InputError("beside", words, fmt::format("\"{}\" is no variant of a body", rest.substr(0, end)),
                       fmt::format("take of these, joined by +: {}", fmt::join(variant_words(), ", ")));
    if (end == rest.size()) break;
    rest.remove_prefix(end + 1);
  }
  if (was_static && variant.has_integrator)
    throw InputError("beside", words, "moves in time, and the scene does not", "name laws alone");
  return variant;
}

}  // namespace heml
