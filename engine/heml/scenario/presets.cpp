#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/scenario/material_json.hpp>
#include <heml/scenario/presets.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/text_file.hpp>
#include <tuple>

namespace heml {
namespace {

namespace fs = std::filesystem;

constexpr double modulus_tolerance = 1e-6;  // relative, between the file's shear modulus and that of its law

/// A text; empty for null, which means unknown.
std::string text_or_nothing(const JsonCursor& key) { return key.json().is_null() ? std::string() : key.text(); }

Citation citation_from(const JsonCursor& key) {
  key.allow({"authors", "year", "title", "published_in", "doi", "url", "place"});
  Citation result;
  result.authors = key["authors"].text();
  if (!key["year"].json().is_null()) result.year = static_cast<int>(key["year"].integer(1800, 3000));
  result.title = text_or_nothing(key["title"]);
  result.published_in = text_or_nothing(key["published_in"]);
  result.doi = text_or_nothing(key["doi"]);
  result.url = text_or_nothing(key["url"]);
  result.place = text_or_nothing(key["place"]);
  return result;
}

Material material_of_preset(const JsonCursor& key) {
  if (const auto name = key.find("preset")) name->fail("a preset in a preset", "give the law and its parameters");
  return material_from(key).material;
}

std::optional<StretchRange> stretch_range_from(const JsonCursor& key) {
  if (key.json().is_null()) return std::nullopt;
  if (key.size() != 2 || !(key[0].number() > 0) || !(key[1].number() > key[0].number()))
    key.refuse("must be null or [low, high], stretches with 0 < low < high");
  return StretchRange{key[0].number(), key[1].number()};
}

/// Family names out of "A. B. Name, C. Other et al.".
std::vector<std::string> family_names(std::string authors) {
  authors = authors.substr(0, authors.find(" et al."));
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin < authors.size();) {
    const std::size_t end = std::min(authors.find(", ", begin), authors.size());
    const std::string author = authors.substr(begin, end - begin);
    names.push_back(author.substr(author.find_last_of(' ') + 1));
    begin = end + 2;
  }
  return names;
}

std::vector<Preset> read_all() {
  const fs::path folder = assets_folder() / "materials";
  std::vector<Preset> result;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") result.push_back(read_preset(entry.path()));
  std::sort(result.begin(), result.end(),
            [](const Preset& a, const Preset& b) { return std::tie(a.tissue, a.name) < std::tie(b.tissue, b.name); });
  return result;
}

}  // namespace

std::string to_text(const Citation& citation) {
  std::string text = citation.authors;
  if (citation.year) text += fmt::format(" ({})", citation.year);
  const auto add = [&](const char* before, const std::string& part) {
    if (!part.empty()) text += before + part;
  };
  add(": ", citation.title);
  add(". ", citation.published_in);
  add(". doi:", citation.doi);
  add(citation.doi.empty() ? ". " : ", ", citation.url);
  add(", ", citation.place);
  return text;
}

std::string short_text(const Citation& citation) {
  const std::vector<std::string> names = family_names(citation.authors);
  const bool more = names.size() > 2 || citation.authors.ends_with("et al.");
  std::string text = names.empty() ? "" : names.front();
  if (more)
    text += " et al.";
  else if (names.size() == 2)
    text += " & " + names.back();
  if (citation.year) text += fmt::format(" {}", citation.year);
  return text;
}

Preset read_preset(const fs::path& path) {
  const std::string file = path.string();
  const Json document = parse_json(read_text_file(path), file);
  const JsonCursor key(document, file);
  key.allow({"title", "tissue", "species", "material", "published", "convention", "ours", "shear_modulus", "test",
             "stretch_range", "source", "seen", "note", "verified"});
  Preset preset;
  preset.name = path.stem().string();
  preset.title = key["title"].text();
  preset.tissue = key["tissue"].text();
  preset.species = text_or_nothing(key["species"]);
  preset.material = material_of_preset(key["material"]);
  const JsonCursor published = key["published"];
  if (!published.json().is_object()) published.refuse("must be an object { \"name\": number, ... }");
  for (const auto& [name, value] : published.json().items())
    preset.published.emplace_back(name, published[name].number());
  preset.convention = key["convention"].text();
  key["ours"].each([&](const JsonCursor& name) { preset.ours.push_back(name.text()); });
  preset.shear_modulus = key["shear_modulus"].positive();
  preset.test = key["test"].text();
  preset.stretch_range = stretch_range_from(key["stretch_range"]);
  preset.source = citation_from(key["source"]);
  preset.seen = key["seen"].text();
  preset.note = text_or_nothing(key["note"]);
  preset.verified = key["verified"].flag();
  const double shear = small_strain_moduli(preset.material).shear;
  if (!(std::abs(shear - preset.shear_modulus) <= modulus_tolerance * shear))
    key["shear_modulus"].refuse(fmt::format("the material's is {:.9g} Pa", shear));
  return preset;
}

const std::vector<Preset>& presets() {
  static const std::vector<Preset> all = read_all();
  return all;
}

const Preset* find_preset(std::string_view name) {
  const auto found = std::find_if(presets().begin(), presets().end(), [&](const Preset& p) { return p.name == name; });
  return found == presets().end() ? nullptr : &*found;
}

RegionMaterial preset_entry(const JsonCursor& entry) {
  std::vector<std::string_view> names;
  for (const Preset& preset : presets()) names.push_back(preset.name);
  if (names.empty()) entry["preset"].refuse("there are no presets beside this program: give law and parameters");
  const Preset& preset = presets()[entry["preset"].one_of(names)];
  Json whole = material_json({std::nullopt, preset.material});
  for (const auto& [name, value] : entry.json().items()) {
    if (name == "preset") continue;
    if (whole.contains(name) && name != "density" && name != "fibre")
      entry[name].fail("comes with the preset", "leave it out, or give law and parameters instead of the preset");
    whole[name] = value;
  }
  return material_from(JsonCursor(whole, entry.file(), entry.place()));
}

const Preset* preset_of(const Material& material) {
  const auto same = [&](const Preset& preset) {
    return preset.material.law == material.law && preset.material.parameters == material.parameters &&
           preset.material.volume_term == material.volume_term && material.fields.empty();
  };
  const auto found = std::find_if(presets().begin(), presets().end(), same);
  return found == presets().end() ? nullptr : &*found;
}

}  // namespace heml
