#include <fmt/format.h>

#include <app/panel/measure_section.hpp>
#include <app/panel/plot.hpp>
#include <app/panel/quantity.hpp>
#include <cmath>
#include <heml/world/field_list.hpp>

namespace heml::panel {
namespace {


std::string degrees(double angle) { return std::isfinite(angle) ? fmt::format("{:.1f}°", angle) : "–"; }

std::string volume_text(double cubic_metres) {
  return std::isfinite(cubic_metres) ? fmt::format("{:.4g} cm³", 1e6 * cubic_metres) : "–";
}

std::string area_text(double square_metres) {
  return std::isfinite(square_metres) ? fmt::format("{:.4g} cm²", 1e4 * square_metres) : "–";
}

void draw_plot(std::size_t points, Field field, const History& history) {
  if (points == 1) {
    if (field == Field::none) return;
    const Curve curves[] = {{"Value", colours::text, [](const Reading& r) { return r.measured.value; }}};
    return plot("measure plot", history, curves, {info(field).unit, 0, 1e-9, 3.8f});
  }
  const Curve lengths[] = {{"1 to 2", colours::accent, [](const Reading& r) { return r.measured.distance; }},
                           {"2 to 3", colours::potential, [](const Reading& r) { return r.measured.second; }}};
  plot("measure plot", history, std::span(lengths, points - 1), {"m", 0, 1e-6, 3.8f});
  if (points < 3) return;
  const Curve angle[] = {{"Angle", colours::warning, [](const Reading& r) { return r.measured.angle; }}};
  plot("angle plot", history, angle, {"°", 0, 1, 3.8f});
}

}  // namespace

std::string measured_text(const Measured& measured) {
  if (measured.places.size() < 2) return "";
  std::string text = quantity(measured.distance, "m");
  if (measured.places.size() > 2)
    text = fmt::format("{} and {}, {}", text, quantity(measured.second, "m"), degrees(measured.angle));
  return text;
}

void draw_measure(Rows& rows, Measure& measure, const History& history, PanelActions& out) {
  if (measure.is_empty()) {
    rows.value({"Measure", "One point: the field there, and the piece. Two: their distance. Three: the angle at the "
                           "second. The points follow the tissue; a fourth begins anew."},
               "click points on the tissue");
    return;
  }
  const Measured& now = measure.now();
  const std::size_t points = measure.points().size();
  if (points > 1)
    rows.value({"Distance 1 to 2", "Straight, between the first and the second point (m)."},
               quantity(now.distance, "m"), colours::accent);
  if (points > 2) {
    rows.value({"Distance 2 to 3", "Straight, between the second and the third point (m)."}, quantity(now.second, "m"),
               colours::potential);
    rows.value({"Angle", "Between the two lines, at the second point (°)."}, degrees(now.angle), colours::warning);
  }
  if (now.field != Field::none)
    rows.value({"Value", "Of the shown field at the last point."},
               info(now.field).unit.empty() ? fmt::format("{:.4g}", now.value)
                                            : quantity(now.value, info(now.field).unit));
  rows.value({"Piece volume", "Of what hangs together with the last point, of shown regions (cm³). Quadratic elements "
                              "count between their corners."},
             volume_text(now.volume));
  rows.value({"Piece area", "Of the surface of that piece, cut faces included (cm²)."}, area_text(now.area));
  draw_plot(points, now.field, history);
  const float half = (ImGui::GetContentRegionAvail().x - em(0.4f)) / 2;
  if (rows.button({"Save CSV", fmt::format("Writes a row for each of the {} frames since the last point was set into "
                                           "a new file of the working folder; the message names it.",
                                           measure.kept().size())},
                  half))
    out.requests.push_back(Request::save_measured);
  ImGui::SameLine(0, em(0.4f));
  if (rows.button({"Clear", "Forgets the points and their history."}, half)) measure.clear();
}

}  // namespace heml::panel
