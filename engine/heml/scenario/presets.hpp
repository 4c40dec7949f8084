#pragma once
// Presets: materials with published parameters, one file each in assets/materials/. `"preset": "NAME"` in an entry of a
// scene's `materials` replaces law and parameters.
#include <filesystem>
#include <heml/materials/material.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace heml {

/// Source of published parameters. Empty texts and a year of 0: unknown.
struct Citation {
  std::string authors, title;
  int year = 0;
  std::string published_in;  ///< journal, volume, pages
  std::string doi, url;
  std::string place;  ///< table or page with the numbers
};
/// "Authors (year): Title. Journal. doi:..." without the unknown parts, on one line.
std::string to_text(const Citation& citation);
/// "Miller & Chinzei 2002", "Carter et al. 2001".
std::string short_text(const Citation& citation);

struct StretchRange {
  double low, high;
};

struct Preset {
  std::string name;  ///< file name without .json
  std::string title, tissue, species;
  Material material;
  std::vector<std::pair<std::string, double>> published;  ///< parameters as printed, SI, in the source's convention
  std::string convention;                                 ///< how they are converted to the material's parameters
  std::vector<std::string> ours;  ///< keys of the material that were not published but chosen by this project
  double shear_modulus = 0;       ///< Pa, at rest, from the file
  std::string test;               ///< kind of measurement
  std::optional<StretchRange> stretch_range;  ///< of the measurement; empty: unknown
  Citation source;
  std::string seen;       ///< which part of the source was read when the file was written
  std::string note;       ///< empty: none
  bool verified = false;  ///< whether a person compared the parameters with the source itself
};

/// Reads one preset. Throws InputError naming file and key, also where the law's shear modulus is not the file's.
Preset read_preset(const std::filesystem::path& path);

/// All presets of assets/materials, ordered by tissue and name; read once. Throws InputError for an invalid file.
const std::vector<Preset>& presets();

/// nullptr when there is no preset of that name.
const Preset* find_preset(std::string_view name);

class JsonCursor;
struct RegionMaterial;

/// Reads an entry of `materials` with a `preset`: the preset's law and parameters with the entry's other keys (region,
/// density, fibre, viscosity, ...). Throws InputError for an unknown name and for keys that the preset sets.
RegionMaterial preset_entry(const JsonCursor& entry);

/// The preset with a material's law, parameters and volume term; nullptr if there is none.
const Preset* preset_of(const Material& material);

}  // namespace heml
