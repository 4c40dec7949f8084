#include <fmt/format.h>

#include <algorithm>
#include <app/commands/accuracy_pictures.hpp>
#include <app/commands/chart_picture.hpp>
#include <app/panel/theme.hpp>
#include <cmath>
#include <studies/pareto.hpp>

namespace heml {
namespace {

using panel::ChartMark;
using panel::colours::rgba;

// Colours that are safe for colour-blind readers (Okabe & Ito).
constexpr ImU32 inks[] = {rgba(0xe69f00), rgba(0x0072b2), rgba(0xd55e00), rgba(0x009e73),
                          rgba(0xcc79a7), rgba(0x56b4e9), rgba(0xf0e442)};
constexpr ImU32 front_colour = rgba(0x1d2527, 90), grey = rgba(0x7a8486);

double cost(const Measured& m) { return m.seconds_per_second(); }

/// A line along the Pareto front, behind the points.
panel::ChartSeries front_of(const TimeStudy& study) {
  std::vector<CostAndError> points;
  for (const Measured& m : study.measured)
    points.push_back(m.failed() ? CostAndError{HUGE_VAL, HUGE_VAL} : CostAndError{cost(m), m.error});
  panel::ChartSeries series{"Pareto front", {}, front_colour, ChartMark::line, 1.6f};
  for (const std::size_t k : pareto_front(points))
    if (!study.measured[k].failed()) series.points.push_back({points[k].cost, 1e3 * points[k].error});
  return series;
}

/// One series per integrator: dots for explicit methods and solves to the tolerance, rings for an iteration budget.
void add_methods(panel::Chart& chart, const TimeStudy& study) {
  std::size_t next = 0;
  for (const Integrator integrator : moving_integrators()) {
    const ImU32 ink = inks[next++ % std::size(inks)];
    panel::ChartSeries solved{info_of(integrator).title, {}, ink, ChartMark::dots}, cut{"", {}, ink, ChartMark::rings};
    for (const Measured& m : study.measured)
      if (m.method.integrator == integrator && !m.failed())
        (m.method.iterations > 0 ? cut : solved).points.push_back({cost(m), 1e3 * m.error});
    if (solved.points.empty() && cut.points.empty()) continue;
    chart.series.push_back(std::move(solved));
    chart.series.push_back(std::move(cut));
  }
  chart.series.push_back({"iteration budget", {}, grey, ChartMark::rings});
}

/// Crosses above all errors.
void add_failed(panel::Chart& chart, const TimeStudy& study) {
  double largest = 0;
  for (const Measured& m : study.measured)
    if (!m.failed()) largest = std::max(largest, 1e3 * m.error);
  const double top = std::pow(10, std::ceil(std::log10(largest) + 0.15));
  panel::ChartSeries failed{"failed", {}, rgba(0x1d2527), ChartMark::crosses};
  for (const Measured& m : study.measured)
    if (m.failed() && m.run.simulated > 0 && cost(m) > 0) failed.points.push_back({cost(m), top});
  if (!failed.points.empty()) chart.series.push_back(std::move(failed));
}

panel::Chart work_precision(const SceneStudy& scene, const TimeStudy& study) {
  panel::Chart chart;
  chart.title = scene.title;
  chart.subtitle = fmt::format("{} nodes, {} tetrahedra, {}; one mark per method, lower left is better", study.nodes,
                               study.tets, study.element);
  chart.x_label = "Computing time per simulated second, s";
  chart.y_quantity = "Time error, mm";
  chart.logarithmic = true;
  chart.vertical = {
      {0.001 / seconds_per_frame, "1 ms per frame"}, {1, "16 ms: real time"}, {0.033 / seconds_per_frame, "33 ms"}};
  if (const auto error = scene.mesh_error(study.element)) chart.horizontal = {{1e3 * *error, "discretisation error"}};
  chart.series.push_back(front_of(study));
  add_methods(chart, study);
  add_failed(chart, study);
  return chart;
}

/// The whole error by element: what a mesh and a method give together, for what they cost.
panel::Chart element_comparison(const SceneStudy& scene) {
  panel::Chart chart;
  chart.title = scene.title;
  chart.subtitle =
      fmt::format("{} tetrahedra by element; one mark per method, lower left is better", scene.time.front().tets);
  chart.x_label = "Computing time per simulated second, s";
  chart.y_quantity = "Time error + discretisation error, mm";
  chart.logarithmic = true;
  chart.vertical = {{1, "16 ms: real time"}, {0.033 / seconds_per_frame, "33 ms"}};
  std::vector<CostAndError> all;
  for (std::size_t k = 0; k < scene.time.size(); ++k) {
    const TimeStudy& study = scene.time[k];
    const auto of_mesh = scene.mesh_error(study.element);
    if (!of_mesh) continue;
    const ImU32 ink = inks[k % std::size(inks)];
    panel::ChartSeries dots{study.element, {}, ink, ChartMark::dots}, rings{"", {}, ink, ChartMark::rings};
    for (const Measured& m : study.measured) {
      if (m.failed()) continue;
      all.push_back({cost(m), m.error + *of_mesh});
      (m.method.iterations > 0 ? rings : dots).points.push_back({all.back().cost, 1e3 * all.back().error});
    }
    chart.series.push_back(std::move(dots));
    chart.series.push_back(std::move(rings));
  }
  panel::ChartSeries front{"Pareto front", {}, front_colour, ChartMark::line, 1.6f};
  for (const std::size_t k : pareto_front(all)) front.points.push_back({all[k].cost, 1e3 * all[k].error});
  chart.series.insert(chart.series.begin(), std::move(front));
  chart.series.push_back({"iteration budget", {}, grey, ChartMark::rings});
  return chart;
}

ChartMark mark_of(const std::string& element) {
  if (is_quadratic(element)) return ChartMark::crosses;
  return element == "p1" ? ChartMark::dots : ChartMark::rings;
}

panel::Chart locking_chart(const std::vector<LockingBeam>& beams) {
  panel::Chart chart;
  chart.title = "Locking of a beam";
  chart.subtitle = "Sag under self-weight; linear tetrahedra lock as Poisson's ratio approaches 0.5";
  chart.x_label = "Tetrahedra";
  chart.y_quantity = "Discretisation error, % of the motion";
  chart.logarithmic = true;
  for (const std::string element : {"p1", "nodal_pressure", "p2", "p2_pressure"})
    for (std::size_t b = 0; b < beams.size(); ++b) {
      const ImU32 colour = inks[b % std::size(inks)];
      const std::string name = fmt::format("ν {}", beams[b].poisson);
      panel::ChartSeries line{element == "p1" ? name : "", {}, colour, ChartMark::line},
          marks{"", {}, colour, mark_of(element)};
      for (const ConvergenceMesh& mesh : beams[b].convergence.meshes)
        if (mesh.element == element && mesh.failed.empty())
          line.points.push_back({static_cast<double>(mesh.tets), 100 * mesh.relative});
      marks.points = line.points;
      if (element != "p1") line.thickness = 0.6f;
      chart.series.push_back(std::move(line));
      chart.series.push_back(std::move(marks));
    }
  chart.series.push_back({"p1", {}, grey, ChartMark::dots});
  chart.series.push_back({"nodal pressure", {}, grey, ChartMark::rings});
  chart.series.push_back({"p2, p2_pressure", {}, grey, ChartMark::crosses});
  return chart;
}

panel::Chart refinement_chart(const RefinementStudy& study) {
  panel::Chart chart;
  chart.title = "Uniform and adapted meshes of a beam";
  chart.subtitle = "Equilibrium under its weight, Poisson's ratio 0.3; adapted: refined where the estimate is greatest";
  chart.x_label = "Tetrahedra";
  chart.y_quantity = "Discretisation error, % of the energy norm";
  chart.logarithmic = true;
  for (const bool adapted : {false, true}) {
    const ImU32 colour = inks[adapted ? 2 : 1];
    panel::ChartSeries line{adapted ? "adapted" : "uniform", {}, colour, ChartMark::line},
        marks{"", {}, colour, ChartMark::dots}, estimates{"", {}, colour, ChartMark::rings};
    for (const RefinedMesh& mesh : study.meshes)
      if (mesh.adapted == adapted) {
        line.points.push_back({static_cast<double>(mesh.tets), 100 * mesh.error});
        estimates.points.push_back({static_cast<double>(mesh.tets), 100 * mesh.estimated});
      }
    marks.points = line.points;
    for (panel::ChartSeries* series : {&line, &marks, &estimates}) chart.series.push_back(std::move(*series));
  }
  chart.series.push_back({"estimated", {}, grey, ChartMark::rings});
  return chart;
}

panel::BarChart feature_bars(const FeatureStudy& study) {
  panel::BarChart chart;
  chart.title = study.title;
  chart.subtitle =
      "One feature changed at a time: computing time relative to the scene as given; in brackets the rms error";
  chart.names = {"time"};
  chart.colours = {inks[1]};
  chart.mark = 1;
  const double as_it_is = study.measurement.changes.front().milliseconds;
  for (const MeasuredChange& c : study.measurement.changes) {
    if (c.from.empty()) continue;
    const std::string error = c.halted.empty() ? length_text(c.error) : "stops";
    chart.groups.push_back(
        {fmt::format("{}: {} to {} ({})", c.feature, c.from, c.to, error), {c.milliseconds / as_it_is}});
  }
  return chart;
}

}  // namespace

std::vector<ReportPicture> write_accuracy_pictures(const std::filesystem::path& folder, const AccuracyStudy& study) {
  std::vector<ReportPicture> pictures;
  for (const SceneStudy& scene : study.scenes) {
    if (scene.time.size() > 1 && scene.convergence.reference.failure.empty()) {
      const auto file = folder / fmt::format("{}_elements.png", scene.name);
      write_chart(file, element_comparison(scene));
      pictures.push_back({scene.name, file, fmt::format("{}: the whole error by element.", scene.title)});
    }
    for (const TimeStudy& time : scene.time) {
      if (time.measured.empty()) continue;
      const auto file = folder / fmt::format("{}_{}.png", scene.name, time.element);
      write_chart(file, work_precision(scene, time));
      pictures.push_back({scene.name, file,
                          fmt::format("{}, {}: time error against computing time. Marks below the horizontal line "
                                      "gain nothing from smaller steps: the discretisation error is larger.",
                                      scene.title, time.problem)});
    }
  }
  if (!study.locking.empty()) {
    write_chart(folder / "locking.png", locking_chart(study.locking));
    pictures.push_back(
        {"locking", folder / "locking.png", "Discretisation error against mesh size, by Poisson's ratio."});
  }
  if (study.refinement && !study.refinement->meshes.empty()) {
    write_chart(folder / "refinement.png", refinement_chart(*study.refinement));
    pictures.push_back(
        {"refinement", folder / "refinement.png", "Discretisation error against mesh size, exact and estimated."});
  }
  for (const FeatureStudy& features : study.features) {
    const auto file = folder / fmt::format("features_{}.png", features.scene);
    write_chart(file, feature_bars(features));
    pictures.push_back(
        {"features " + features.scene, file, "Computing time with one feature changed, and the resulting error."});
  }
  return pictures;
}

}  // namespace heml
