#include <fmt/format.h>

#include <charconv>
#include <heml/base/error.hpp>
#include <heml/scenario/scene_numbers.hpp>
#include <regex>
#include <variant>
#include <vector>

namespace heml {
namespace {

using PathToken = std::variant<std::string, std::size_t>;  // a key, or an index

[[noreturn]] void refuse_path(const std::string& path, const std::string& problem) {
  throw InputError(path, "", problem,
                   "give a path to one number of materials, loads, gravity or boundary, or mesh.scale, as "
                   "materials[0].young or gravity[1]");
}

std::vector<PathToken> tokens_of(const std::string& path) {
  std::vector<PathToken> tokens;
  const auto is_key = [](char c) { return c == '_' || (c >= '0' && c <= '9') || ((c | 32) >= 'a' && (c | 32) <= 'z'); };
  for (std::size_t at = 0; at < path.size();) {
    if (path[at] == '[') {
      std::size_t index = 0;
      const auto [end, error] = std::from_chars(path.data() + at + 1, path.data() + path.size(), index);
      if (error != std::errc() || end == path.data() + path.size() || *end != ']')
        refuse_path(path, fmt::format("is no path at column {}", at + 1));
      tokens.emplace_back(index);
      at = static_cast<std::size_t>(end - path.data()) + 1;
      continue;
    }
    if (!tokens.empty() && path[at] == '.') ++at;
    const std::size_t begin = at;
    while (at < path.size() && is_key(path[at])) ++at;
    if (at == begin) refuse_path(path, fmt::format("is no path at column {}", at + 1));
    tokens.emplace_back(path.substr(begin, at - begin));
  }
  if (tokens.empty()) refuse_path(path, "is empty");
  return tokens;
}

/// Null where there is nothing.
Json* entry_at(Json& scene, const std::vector<PathToken>& tokens) {
  Json* at = &scene;
  for (const PathToken& token : tokens) {
    if (const auto* key = std::get_if<std::string>(&token)) {
      if (!at->is_object() || !at->contains(*key)) return nullptr;
      at = &(*at)[*key];
    } else {
      const std::size_t index = std::get<std::size_t>(token);
      if (!at->is_array() || index >= at->size()) return nullptr;
      at = &(*at)[index];
    }
  }
  return at;
}

/// Whether an equilibrium may depend on the number: not on selections, times and what says how to solve.
bool moves_equilibrium(const std::string& path) {
  static const std::regex pattern(
      R"(materials\[\d+\]\.(?!region$)\w.*|loads\[\d+\]\.((force|traction)\[\d+\]|pressure)|gravity\[\d+\]|)"
      R"(boundary\[\d+\]\.(translate\[\d+\]|rotate\.((axis|origin)\[\d+\]|degrees))|mesh\.scale)");
  return std::regex_match(path, pattern);
}

}  // namespace

double number_at(const Json& scene, const std::string& path) {
  const Json* found = entry_at(const_cast<Json&>(scene), tokens_of(path));
  if (!found && path == "mesh.scale") return 1;
  if (!found) refuse_path(path, "is not in the scene");
  if (!found->is_number()) refuse_path(path, fmt::format("is {}, no number", shown(*found)));
  if (!moves_equilibrium(path)) refuse_path(path, "cannot be fitted");
  return found->get<double>();
}

void set_number(Json& scene, const std::string& path, double value) {
  if (path == "mesh.scale")
    scene["mesh"]["scale"] = value;
  else
    *entry_at(scene, tokens_of(path)) = value;
}

void name_moduli(Json& scene, const std::string& path) {
  std::vector<PathToken> tokens = tokens_of(path);
  if (tokens.size() != 3 || tokens[0] != PathToken("materials") || tokens[2].index() != 0) return;
  const std::string wanted = std::get<std::string>(tokens[2]);
  tokens.pop_back();
  Json* material = entry_at(scene, tokens);
  if (!material || !material->is_object()) return;
  const auto numbers = [&](const char* first, const char* second) {
    return material->contains(first) && material->contains(second) && (*material)[first].is_number() &&
           (*material)[second].is_number();
  };
  if ((wanted == "young" || wanted == "poisson") && numbers("lambda", "mu")) {
    const double lambda = (*material)["lambda"], mu = (*material)["mu"];
    material->erase("lambda"), material->erase("mu");
    (*material)["young"] = mu * (3 * lambda + 2 * mu) / (lambda + mu);
    (*material)["poisson"] = lambda / (2 * (lambda + mu));
  } else if ((wanted == "lambda" || wanted == "mu") && numbers("young", "poisson")) {
    const double young = (*material)["young"], poisson = (*material)["poisson"];
    material->erase("young"), material->erase("poisson");
    (*material)["lambda"] = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
    (*material)["mu"] = young / (2 * (1 + poisson));
  }
}

}  // namespace heml
