#include <fmt/format.h>

#include <algorithm>
#include <app/panel/parameter_rows.hpp>
#include <cmath>
#include <heml/materials/parameter_slots.hpp>
#include <numbers>

namespace heml::panel {
namespace {

constexpr int max_terms = 6;
constexpr double steepest = 89.9;  // degrees: a vertical fibre has no direction in the plane

/// Unit, format and range of a parameter in the panel.
struct Shown {
  double factor;  ///< shown value = factor × SI value
  std::string format;
  SliderRange range;
};

/// The power of ten at or above a size: keeps the range of a slider constant while it is dragged.
double decade_above(double size) { return std::pow(10.0, std::ceil(std::log10(size) - 1e-9)); }

Shown shown_as(const ParameterSlot& slot, double value, bool one_sign) {
  const std::string_view unit = slot.info->unit;
  const double factor = unit == "Pa" ? 1e-3 : 1;
  const std::string format = unit == "Pa" ? "%.4g kPa" : unit.empty() ? "%.4g" : fmt::format("%.4g {}", unit);
  const double shown = factor * value;
  if (one_sign && value > 0) return {factor, format, {0.01, unit.empty() ? 100.0 : 1e5, nullptr, true}};
  const double reach = std::max(decade_above(std::max(std::abs(shown), 1e-3)), unit.empty() ? 10.0 : 1.0);
  if (one_sign && value < 0) return {factor, format, {-reach, -1e-3 * reach, nullptr, false}};
  return {factor, format, {-reach, reach, nullptr, false}};
}

bool is_name(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](unsigned char c) { return c < 128; });
}

bool parameter_row(Rows& rows, Material& material, const ParameterSlot& slot, std::size_t index) {
  const std::string label = slot.symbol();
  const std::string key = is_name(label) && slot.term < 0 ? std::string() : fmt::format(" ({} in scenes)", slot.key());
  const std::string unit(slot.info->unit.empty() ? "dimensionless" : slot.info->unit);
  const std::string hint = fmt::format("{}{}, {}.", slot.info->meaning, key, unit);
  for (const FieldParameter& field : material.fields)
    if (field.parameter == index) {
      rows.value({label, hint}, fmt::format("field '{}' of the mesh", field.field));
      return false;
    }
  const Shown shown = shown_as(slot, material.parameters[index], has_fixed_sign(material, index));
  SliderRange range = shown.range;
  range.format = shown.format.c_str();
  double value = shown.factor * material.parameters[index];
  if (!rows.slider({label, hint}, value, range)) return false;
  material.parameters[index] = value / shown.factor;
  return true;
}

/// Adds a term without changing the law (the last term and it share its modulus), or removes the last one.
bool term_rows(Rows& rows, Material& material, const std::vector<ParameterSlot>& slots) {
  int terms = 0;
  for (const ParameterSlot& slot : slots) terms = std::max(terms, slot.term + 1);
  if (terms == 0) return false;
  const float width = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
  int change = 0;
  if (rows.button({"Add term", "Adds a term to the sum; it shares the modulus of the last one."}, width) &&
      terms < max_terms)
    change = 1;
  ImGui::SameLine();
  if (rows.button({"Remove term", "Removes the last term of the sum."}, width) && terms > 1) change = -1;
  if (change == 0) return false;
  std::vector<double> parameters;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const bool last = slots[i].term == terms - 1;
    const double value = material.parameters[i];
    if (last && change < 0) continue;
    const bool shared = last && slots[i].info->unit == "Pa";
    parameters.push_back(shared ? value / 2 : value);
    if (last) parameters.push_back(parameters.back());
  }
  material.parameters = std::move(parameters);
  return true;
}

}  // namespace

bool parameter_rows(Rows& rows, Material& material, const LawInfo& law) {
  const std::vector<ParameterSlot> slots = parameter_slots(material, law);
  bool changed = false;
  for (std::size_t i = 0; i < slots.size(); ++i) changed |= parameter_row(rows, material, slots[i], i);
  return term_rows(rows, material, slots) || changed;
}

bool engineering_rows(Rows& rows, Material& material) {
  const EngineeringConstants now = engineering_constants({material.parameters[0], material.parameters[1]});
  double young = now.young * 1e-3, poisson = now.poisson;
  bool changed = rows.slider({"Young's E",
                              "Young's modulus E: uniaxial stress per strain, kPa. Brain has about "
                              "1, liver 5, muscle 20."},
                             young, {0.01, 1e5, "%.4g kPa", true});
  changed |= rows.slider({"Poisson's ν",
                          "Poisson's ratio ν: lateral over axial strain, dimensionless. Towards 0.5 tissue is "
                          "incompressible, and stable steps are shorter."},
                         poisson, {0, 0.495, "%.3f", false});
  if (!changed) return false;
  const LameParameters lame = lame_parameters(young * 1e3, poisson);
  material.parameters = {lame.lambda, lame.mu};
  return true;
}

bool fibre_rows(Rows& rows, Material& material) {
  if (!material.fibre_field.empty()) {
    rows.value({"Fibres", "Direction of the fibres in each element."},
               fmt::format("field '{}' of the mesh", material.fibre_field));
    return false;
  }
  constexpr double degree = std::numbers::pi / 180;
  const Vec3 d = material.fibre.y() < 0 ? Vec3(-material.fibre) : material.fibre;  // a fibre has no sign
  double turn = std::atan2(-d.z(), d.x()) / degree, rise = std::asin(std::clamp(d.y(), -1.0, 1.0)) / degree;
  bool changed = rows.slider(
      {"Fibre azimuth", "Direction of the fibres in the horizontal plane at rest, degrees from x towards −z."}, turn,
      {-180, 180, "%.0f°", false});
  changed |= rows.slider(
      {"Fibre elevation", "Elevation of the fibres at rest, degrees above the horizontal plane (towards y)."}, rise,
      {0, steepest, "%.0f°", false});
  if (!changed) return false;
  const double across = std::cos(rise * degree);
  material.fibre =
      Vec3(across * std::cos(turn * degree), std::sin(rise * degree), -across * std::sin(turn * degree)).normalized();
  return true;
}

}  // namespace heml::panel
