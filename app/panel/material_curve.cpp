#include <app/panel/material_curve.hpp>
#include <app/panel/theme.hpp>
#include <heml/materials/test_bench.hpp>
#include <heml/scenario/presets.hpp>

namespace heml::panel {
namespace {

constexpr double lowest_stretch = 0.7, highest_stretch = 1.5;
constexpr int curve_points = 41;
constexpr float height = 6.2f;  // em

/// Whether two materials have the same curve.
bool same_curve(const Material& a, const Material& b) {
  return a.law == b.law && a.parameters == b.parameters && a.fibre == b.fibre && a.volume_term == b.volume_term;
}

}  // namespace

void MaterialCurve::compute(const Material& material) {
  const Preset* preset = preset_of(material);
  chart_ = {};
  chart_.small = true;
  chart_.y_quantity = "Uniaxial stress";
  chart_.y_unit = "Pa";
  if (preset && preset->stretch_range) chart_.band = {preset->stretch_range->low, preset->stretch_range->high, ""};
  const BenchCurve curve = run_bench(*make_material_point(material, false), BenchTest::uniaxial,
                                     evenly_spaced(lowest_stretch, highest_stretch, curve_points));
  ChartSeries series{"", {}, colours::accent, ChartMark::line, 1};
  for (const BenchPoint& p : curve.points) series.points.push_back({p.amount, p.nominal});
  chart_.series.push_back(std::move(series));
  shown_ = material;
  computed_ = true;
}

void MaterialCurve::draw(const Material& material) {
  const LawInfo* law = find_law(material.law);
  if (!law || !law->is_continuum || !material.fields.empty() || !material.fibre_field.empty()) return;
  if (!computed_ || !same_curve(material, shown_)) compute(material);
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const ImVec2 to(from.x + ImGui::GetContentRegionAvail().x, from.y + em(height));
  ImGui::InvisibleButton("material curve", {to.x - from.x, to.y - from.y});
  if (ImGui::IsItemVisible()) draw_chart(*ImGui::GetWindowDrawList(), {from, to}, chart_, panel_chart());
}

}  // namespace heml::panel
