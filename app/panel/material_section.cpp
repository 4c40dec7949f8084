#include <fmt/format.h>

#include <algorithm>
#include <app/panel/material_section.hpp>
#include <app/panel/parameter_rows.hpp>
#include <app/panel/quantity.hpp>
#include <app/panel/region_section.hpp>
#include <app/panel/tissue_choice.hpp>
#include <cmath>
#include <heml/materials/match_moduli.hpp>
#include <iterator>
#include <utility>

namespace heml::panel {
namespace {

constexpr double max_active_stress = 200;  // kPa, of the slider
constexpr float tall_picture = 54;  // em: in images at least this high the curve starts open

void warn_in_panel(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, colours::warning);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

}  // namespace

void MaterialSection::sync(const SetMaterial& command) {
  for (RegionMaterial& entry : materials_)
    if (entry.region == command.region) entry.material = command.material;
  ++changes_;
}

void MaterialSection::sync(const SetActiveStress& command) {
  for (RegionMaterial& entry : materials_)
    if (entry.region == command.region) entry.material.active_stress = command.stress;
  ++changes_;
}

void MaterialSection::take(const std::vector<RegionMaterial>& materials, const std::map<int, std::string>& names,
                           std::vector<int> regions) {
  names_ = names;
  regions_ = std::move(regions);
  std::vector<RegionMaterial> before = std::exchange(materials_, materials);
  bool changed = before.size() != materials_.size();
  for (RegionMaterial& entry : materials_) {
    const auto old = std::find_if(before.begin(), before.end(),
                                  [&](const RegionMaterial& other) { return other.region == entry.region; });
    if (old == before.end()) {
      chosen_ = static_cast<int>(&entry - materials_.data());
      continue;
    }
    if (!entry.material.fields.empty()) entry.material = old->material;
    changed |= !(entry.material == old->material);
  }
  if (chosen_ >= std::ssize(materials_)) chosen_ = 0;
  if (changed) ++changes_;
}

void MaterialSection::show(int region) {
  for (std::size_t k = 0; k < materials_.size(); ++k)
    if (materials_[k].region == region) chosen_ = static_cast<int>(k);
}

void MaterialSection::draw(Rows& rows, double stretched, PanelActions& out) {
  if (materials_.empty()) return;
  if (materials_.size() > 1) draw_region(rows);
  RegionMaterial& entry = materials_[static_cast<std::size_t>(chosen_)];
  Material edited = entry.material;
  bool changed = choose_tissue(rows, edited);
  changed |= draw_law(rows, edited);
  const LawInfo* law = find_law(edited.law);
  if (!law) return;
  changed |= draw_numbers(rows, edited, *law);
  if (changed) {
    const auto problem = material_problem(edited);
    problem_ = problem ? fmt::format("{} {}", problem->first, problem->second) : std::string();
    if (!problem) {
      entry.material = edited;
      ++changes_;
      out.commands.emplace_back(SetMaterial{entry.region, edited});
    }
  }
  draw_contraction(rows, entry, out);
  draw_outcome(rows, entry.material, stretched);
  if (!problem_.empty()) warn_in_panel(problem_);
}

void MaterialSection::draw_region(Rows& rows) {
  std::vector<std::string> names;
  for (const RegionMaterial& entry : materials_) names.push_back(name_of(entry));
  if (rows.choice({"Region", "The region of the mesh to edit. Other regions: all without a material of their own."},
                  chosen_, names))
    problem_.clear();
}

/// The entry for regions without one of their own is named after the region, where that is one alone.
std::string MaterialSection::name_of(const RegionMaterial& entry) const {
  if (entry.region) return region_name(*entry.region, names_);
  std::vector<int> others;
  std::copy_if(regions_.begin(), regions_.end(), std::back_inserter(others), [&](int region) {
    return std::none_of(materials_.begin(), materials_.end(),
                        [&](const RegionMaterial& other) { return other.region == region; });
  });
  return others.size() == 1 ? region_name(others.front(), names_) : std::string("Other regions");
}

bool MaterialSection::draw_law(Rows& rows, Material& material) {
  std::vector<std::string> titles, hints;
  int chosen = -1;
  for (const LawInfo& law : laws()) {
    if (law.name == material.law) chosen = static_cast<int>(titles.size());
    titles.emplace_back(law.title);
    hints.push_back(fmt::format("W = {}\n\n{}", law.formula, law.source));
  }
  const LawInfo* before = find_law(material.law);
  if (chosen < 0 && before) {  // an expression of the scene's own
    chosen = static_cast<int>(titles.size());
    titles.emplace_back(before->title);
    hints.push_back(fmt::format("W = {}\n\n{}", before->formula, before->source));
  }
  const bool changed = rows.choice({"Law", "Constitutive law. Switching keeps shape, motion and small-strain moduli."},
                                   chosen, titles, hints);
  if (!changed || !before || static_cast<std::size_t>(chosen) == laws().size()) return false;
  material = match_moduli(material, *before, laws()[static_cast<std::size_t>(chosen)]);
  return true;
}

bool MaterialSection::draw_numbers(Rows& rows, Material& material, const LawInfo& law) {
  const bool has_pair = law.takes_young_poisson && material.fields.empty();
  if (has_pair) {
    static const std::string variants[] = {"E and ν", "λ and μ"};
    int direction = engineering_ ? 0 : 1;
    rows.choice({"Parameters",
                 "Young's modulus and Poisson's ratio, or the two Lamé parameters: the same material either way."},
                direction, variants);
    engineering_ = direction == 0;
  }
  bool changed = has_pair && engineering_ ? engineering_rows(rows, material) : parameter_rows(rows, material, law);
  if (law.has_fibre) changed |= fibre_rows(rows, material);
  changed |= rows.slider({"Density", "Mass per volume at rest, kg/m³. Water has 1000."}, material.density,
                         {100, 10000, "%.0f kg/m³", true});
  return changed;
}

/// A command of its own, so that fields of the mesh and internal state stay.
void MaterialSection::draw_contraction(Rows& rows, RegionMaterial& entry, PanelActions& out) {
  if (!entry.material.gives_fibre() || entry.material.plasticity) return;
  double kilopascal = 1e-3 * entry.material.active_stress;
  if (!rows.slider({"Active stress",
                    "Contraction of muscle along its fibres, kPa, on the cross section at rest. Heart muscle reaches "
                    "about 60 to 120."},
                   kilopascal, {0, max_active_stress, "%.4g kPa", false}))
    return;
  entry.material.active_stress = 1e3 * kilopascal;
  ++changes_;
  out.commands.emplace_back(SetActiveStress{entry.region, entry.material.active_stress});
}

void MaterialSection::draw_outcome(Rows& rows, const Material& material, double stretched) {
  const SmallStrainModuli rest = small_strain_moduli(material);
  const bool tall = ImGui::GetIO().DisplaySize.y >= em(tall_picture);
  const std::string hint = fmt::format(
      "Shear stress per shear strain under small strains, Pa; across the fibres where there are any. Bulk "
      "modulus: {}.\n\nClick to show the uniaxial stress curve.",
      quantity(rest.bulk, "Pa"));
  if (rest.shear > 0 && rows.folding_value({"Shear modulus at rest", hint}, quantity(rest.shear, "Pa"), tall)) {
    curve_.draw(material);
    rows.explain({"Curve",
                  "Nominal stress (force per rest area) against stretch in uniaxial tension and compression. "
                  "Shaded: range in which the parameters were measured."});
  }
  if (stretched > 0)
    warn_in_panel(
        fmt::format("{:.0f} % of the surface (hatched) is stretched beyond the measured range of this tissue.",
                    std::max(1.0, std::round(100 * stretched))));
}

}  // namespace heml::panel
