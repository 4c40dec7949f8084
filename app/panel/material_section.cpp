#include <fmt/format.h>

#include <algorithm>
#include <app/panel/material_section.hpp>
#include <app/panel/same_stiffness.hpp>

namespace heml::panel {
namespace {

/// A parameter in the unit the panel shows it in.
struct Shown {
  double factor;  ///< shown value = factor × SI value
  std::string format;
  SliderRange range;
};

Shown shown_as(std::string_view unit, double value) {
  if (unit == "Pa") return {1e-3, "%.4g kPa", {value > 0 ? 0.01 : 0, 1e5, nullptr, true}};
  if (unit.empty()) return {1, "%.3g", {value > 0 ? 0.01 : -10, 100, nullptr, value > 0}};
  return {1, fmt::format("%.3g {}", unit), {value > 0 ? 0.001 : 0, 1e5, nullptr, true}};
}

std::string name_of(const RegionMaterial& entry) {
  return entry.region ? fmt::format("Region {}", *entry.region) : std::string("Everywhere else");
}

bool is_name(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](unsigned char c) { return c < 128; });
}

}  // namespace

void MaterialSection::follow(const SetMaterial& command) {
  for (RegionMaterial& entry : materials_)
    if (entry.region == command.region) entry.material = command.material;
}

void MaterialSection::draw(Rows& rows, PanelActions& out) {
  if (materials_.empty()) return;
  if (materials_.size() > 1) draw_region(rows);
  RegionMaterial& entry = materials_[static_cast<std::size_t>(chosen_)];
  Material edited = entry.material;
  bool changed = draw_law(rows, edited);
  const LawInfo* law = find_law(edited.law);
  if (!law) return;
  if (law->takes_young_poisson) {
    static const std::string ways[] = {"E and ν", "λ and μ"};
    int way = engineering_ ? 0 : 1;
    rows.choice(
        {"Given as", "Young's modulus and Poisson's ratio, or the two Lamé parameters: the same material either way."},
        way, ways);
    engineering_ = way == 0;
  }
  changed |=
      law->takes_young_poisson && engineering_ ? draw_engineering(rows, edited) : draw_parameters(rows, edited, *law);
  changed |= rows.slider({"Density", "Mass per volume at rest, kg/m³. Water has 1000."}, edited.density,
                         {100, 10000, "%.0f kg/m³", true});
  if (changed) {
    const auto problem = material_problem(edited);
    problem_ = problem ? fmt::format("{} {}", problem->first, problem->second) : std::string();
    if (!problem) {
      entry.material = edited;
      out.commands.emplace_back(SetMaterial{entry.region, edited});
    }
  }
  if (problem_.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, colours::warning);
  ImGui::TextWrapped("%s", problem_.c_str());
  ImGui::PopStyleColor();
}

void MaterialSection::draw_region(Rows& rows) {
  std::vector<std::string> names;
  for (const RegionMaterial& entry : materials_) names.push_back(name_of(entry));
  if (rows.choice(
          {"Part", "Which part of the body is edited: a region of the mesh, or all that has no entry of its own."},
          chosen_, names))
    problem_.clear();
}

bool MaterialSection::draw_law(Rows& rows, Material& material) {
  std::vector<std::string> titles;
  int chosen = -1;
  for (const LawInfo& law : laws()) {
    if (law.name == material.law) chosen = static_cast<int>(titles.size());
    titles.emplace_back(law.title);
  }
  const LawInfo* before = find_law(material.law);
  const bool changed =
      rows.choice({"Law",
                   "How stress follows from strain. Switching keeps the shape, the motion and the stiffness "
                   "under small strains."},
                  chosen, titles);
  if (!changed || !before) return false;
  material = same_stiffness(material, *before, laws()[static_cast<std::size_t>(chosen)]);
  return true;
}

bool MaterialSection::draw_parameters(Rows& rows, Material& material, const LawInfo& law) {
  bool changed = false;
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    const ParameterInfo& info = law.parameters[i];
    const Shown shown = shown_as(info.unit, material.parameters[i]);
    SliderRange range = shown.range;
    range.format = shown.format.c_str();
    double value = shown.factor * material.parameters[i];
    const std::string label(info.symbol.empty() ? info.name : info.symbol);
    const std::string key = is_name(label) ? std::string() : fmt::format(" ({} in scenes)", info.name);
    const std::string unit = info.unit.empty() ? std::string("no unit") : std::string(info.unit);
    if (!rows.slider({label, fmt::format("{}{}, {}.", info.meaning, key, unit)}, value, range)) continue;
    material.parameters[i] = value / shown.factor;
    changed = true;
  }
  return changed;
}

bool MaterialSection::draw_engineering(Rows& rows, Material& material) {
  const Engineering now = engineering_from({material.parameters[0], material.parameters[1]});
  double young = now.young * 1e-3, poisson = now.poisson;
  bool changed =
      rows.slider({"Young's E",
                   "Young's modulus E: stress per strain when pulled along one direction, kPa. Brain has about "
                   "1, liver 5, muscle 20."},
                  young, {0.01, 1e5, "%.4g kPa", true});
  changed |=
      rows.slider({"Poisson's ν",
                   "Poisson's ratio ν: how much the body narrows when it is pulled, no unit. Towards 0.5 it keeps "
                   "its volume, and steps must be shorter."},
                  poisson, {0, 0.495, "%.3f", false});
  if (!changed) return false;
  const Lame lame = lame_from(young * 1e3, poisson);
  material.parameters = {lame.lambda, lame.mu};
  return true;
}

}  // namespace heml::panel
