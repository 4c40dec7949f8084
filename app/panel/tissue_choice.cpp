#include <fmt/format.h>

#include <app/panel/quantity.hpp>
#include <app/panel/tissue_choice.hpp>

namespace heml::panel {
namespace {

Material with_preset(const Material& material, const Preset& preset) {
  Material result = preset.material;
  result.density = material.density;
  result.fibre_field = material.fibre_field;
  if (find_law(result.law)->has_fibre && !material.fibre.isZero()) result.fibre = material.fibre;
  return result;
}

}  // namespace

std::string tissue_hint(const Preset& preset) {
  std::string text = preset.species.empty() ? preset.tissue : fmt::format("{}, {}", preset.tissue, preset.species);
  text += fmt::format("\nMeasured in: {}.", preset.test);
  text += fmt::format("\nShear modulus at rest: {}.", quantity(preset.shear_modulus, "Pa"));
  if (preset.stretch_range)
    text += fmt::format("\nStretches from {:.3g} to {:.3g}.", preset.stretch_range->low, preset.stretch_range->high);
  else
    text += "\nThe range of stretches is not known.";
  text += "\n\n" + to_text(preset.source);
  text += preset.verified ? "\n\nVerified against the source." : "\n\nNot verified against the source.";
  if (!preset.note.empty()) text += "\n" + preset.note;
  return text;
}

bool choose_tissue(Rows& rows, Material& material) {
  if (presets().empty()) return false;
  std::vector<std::string> titles, hints;
  const Preset* now = preset_of(material);
  int chosen = now ? static_cast<int>(now - presets().data()) : -1;
  for (const Preset& preset : presets()) {
    titles.push_back(preset.title);
    hints.push_back(tissue_hint(preset));
  }
  const bool changed =
      rows.choice({"Tissue", "Tissue preset: law and parameters from the literature. –: custom parameters."}, chosen,
                  titles, hints);
  if (changed) material = with_preset(material, presets()[static_cast<std::size_t>(chosen)]);
  if (const Preset* preset = preset_of(material))
    rows.value({"Source", tissue_hint(*preset)},
               fmt::format("{}, {}", short_text(preset->source), preset->verified ? "verified" : "not verified"), 0,
               preset->verified ? colours::text : colours::warning);
  return changed;
}

}  // namespace heml::panel
