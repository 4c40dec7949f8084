#pragma once
// Tissues with published numbers: the files of assets/materials/, one a preset. `"preset": "NAME"` in a scene's
// `materials` stands for law and parameters.
#include <filesystem>
#include <heml/materials/material.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace heml {

/// Where numbers were published. Empty texts and a year of 0: not known.
struct Citation {
  std::string authors, title;
  int year = 0;
  std::string published_in;  ///< journal, volume, pages
  std::string doi, url;
  std::string place;  ///< table or page with the numbers
};
/// "Authors (year): Title. Journal. doi:...": what is known of it, in one line.
std::string to_text(const Citation& citation);
/// "Miller & Chinzei 2002", "Carter et al. 2001": short enough for a panel.
std::string short_text(const Citation& citation);

struct StretchRange {
  double low, high;
};

struct Preset {
  std::string name;  ///< the file's, without .json
  std::string title, tissue, species;
  Material material;
  std::vector<std::pair<std::string, double>> published;  ///< numbers as printed, SI, in the source's convention
  std::string convention;                                 ///< how they became the material's parameters
  std::vector<std::string> ours;  ///< keys of the material that were not published but chosen by this project
  double shear_modulus = 0;       ///< Pa, at rest, as the file says
  std::string test;               ///< what was measured
  std::optional<StretchRange> stretch_range;  ///< in which it was; none: not known
  Citation source;
  std::string seen;       ///< what of the source was read when the file was written
  std::string note;       ///< empty: none
  bool verified = false;  ///< somebody compared the numbers with the source itself
};

/// Reads one preset. Throws InputError naming file and key.
Preset read_preset(const std::filesystem::path& path);

/// All of assets/materials, in the order of tissue and name; read once. Throws InputError for a file that is wrong.
const std::vector<Preset>& presets();

/// nullptr when there is none of that name.
const Preset* find_preset(std::string_view name);

class JsonCursor;
struct RegionMaterial;

/// An entry of `materials` with a `preset`: its law and parameters, and what the entry says beside them (region,
/// density, fibre, viscosity, ...). Throws InputError for an unknown name and for a parameter that the preset has
/// already.
RegionMaterial preset_entry(const JsonCursor& entry);

/// The preset whose law and parameters a material has (fibre and density aside); nullptr for a material of its own.
const Preset* preset_of(const Material& material);

}  // namespace heml
