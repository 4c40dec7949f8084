// The tables of the accuracy report.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <studies/accuracy_report.hpp>
#include <studies/machine.hpp>
#include <studies/pareto.hpp>
#include <thread>

namespace heml {
namespace {

std::string percent(double share) { return short_number(100 * share) + " %"; }
std::string signed_percent(double share) {
  return std::abs(share) < 0.1 ? fmt::format("{:+.2g} %", 100 * share) : fmt::format("{:+.0f} %", 100 * share);
}

std::string error_text(const Measured& measured) {
  return (measured.resolved ? "" : "< ") + length_text(measured.error);
}

int threads_of(const Method& method) {
  return method.threads > 0 ? method.threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

/// Estimate over error; empty if unknown.
std::string effectivity_text(const std::optional<double>& effectivity) {
  return effectivity ? fmt::format("{:.2f}", *effectivity) : "";
}

/// Adds a row for each mesh whose error is known in the energy norm.
void add_gauged(TextTable& table, const std::string& body, const MeshConvergenceStudy& convergence) {
  for (const ConvergenceMesh& mesh : convergence.meshes) {
    if (!mesh.effectivity()) continue;
    const auto of_norm = [&](double squared) { return percent(std::sqrt(squared / (2 * mesh.stored + squared))); };
    const bool in_metres = mesh.resolved && convergence.reference.failure.empty();
    table.rows.push_back({body, std::to_string(mesh.tets), of_norm(*mesh.known), of_norm(*mesh.estimated),
                          effectivity_text(mesh.effectivity()), in_metres ? length_text(mesh.error) : "",
                          length_text(mesh.estimated_length())});
  }
}

template <class Value>
std::string optional_number(const std::optional<Value>& value) {
  return value ? fmt::format("{:.6g}", *value) : "";
}

}  // namespace

TextTable front_table(const SceneStudy& scene) {
  TextTable table;
  table.head = {"ms a frame", "error", "of time", "of the mesh", "how"};
  table.first_number = 0, table.end_numbers = 4;
  const auto candidates = scene.candidates();
  std::vector<CostAndError> points;
  for (const Candidate& candidate : candidates) points.push_back({candidate.frame_seconds(), candidate.error()});
  for (const std::size_t k : pareto_front(points)) {
    const Candidate& c = candidates[k];
    table.rows.push_back({short_number(1e3 * c.frame_seconds()), length_text(c.error()), error_text(*c.measured),
                          c.mesh_error ? length_text(*c.mesh_error) : "not known", text_of(c)});
  }
  return table;
}

TextTable time_table(const TimeStudy& study) {
  TextTable table;
  table.head = {"method",       "error",   "of the motion", "at the end", "s a simulated s", "ms a frame",
                "tick p50, ms", "p99, ms", "steps",         "iterations", "frequency",       "added decay, 1/s",
                "energy",       "volume",  "least J",       "gauge"};
  table.first_number = 1, table.end_numbers = table.head.size();
  for (const Measured& m : study.measured) {
    Cells row = {text_of(m.method)};
    if (m.failed()) {
      row.push_back("failed");
      row.resize(table.head.size());
      row[0] += ": " + m.run.failed;
      table.rows.push_back(row);
      continue;
    }
    row.insert(row.end(),
               {error_text(m), percent(m.relative), length_text(m.last_error), short_number(m.seconds_per_second()),
                short_number(1e3 * m.seconds_per_second() * seconds_per_frame), short_number(1e3 * m.run.median_tick),
                short_number(1e3 * m.run.slow_tick), std::to_string(m.run.steps), std::to_string(m.run.iterations),
                m.frequency_error ? signed_percent(*m.frequency_error) : "",
                m.added_decay ? fmt::format("{:+.2g}", *m.added_decay) : "",
                m.run.energy_drift ? signed_percent(*m.run.energy_drift) : "", signed_percent(m.run.volume - 1),
                short_number(m.run.min_J), effectivity_text(m.step_doubling)});
    table.rows.push_back(row);
  }
  return table;
}

TextTable mesh_convergence_table(const MeshConvergenceStudy& study) {
  TextTable table;
  table.head = {"element", "tetrahedra", "nodes", "error", "of the motion", "s of computing"};
  table.first_number = 1, table.end_numbers = table.head.size();
  for (const ConvergenceMesh& mesh : study.meshes) {
    const bool is_known = mesh.failed.empty() && study.reference.failure.empty();
    const std::string error = (mesh.resolved ? "" : "< ") + length_text(mesh.error);
    table.rows.push_back({mesh.element, std::to_string(mesh.tets), std::to_string(mesh.nodes),
                          is_known ? error : mesh.failed, is_known ? percent(mesh.relative) : "",
                          short_number(mesh.seconds)});
  }
  return table;
}

TextTable locking_table(const std::vector<LockingBeam>& beams) {
  TextTable table;
  table.head = {"Poisson's ratio",  "element",    "tetrahedra", "sag, mm",
                "extrapolated, mm", "theory, mm", "mesh error", "of it locking"};
  table.first_number = 2, table.end_numbers = table.head.size();
  for (const LockingBeam& beam : beams)
    for (const ConvergenceMesh& mesh : beam.convergence.meshes) {
      if (!mesh.failed.empty()) continue;
      if (!beam.convergence.reference.failure.empty()) {
        table.rows.push_back({fmt::format("{}", beam.poisson), mesh.element, std::to_string(mesh.tets), "",
                              beam.convergence.reference.failure, fmt::format("{:.4f}", 1e3 * beam.theory), "", ""});
        continue;
      }
      table.rows.push_back({fmt::format("{}", beam.poisson), mesh.element, std::to_string(mesh.tets),
                            fmt::format("{:.4f}", 1e3 * beam.sag(mesh)),
                            fmt::format("{:.4f}", 1e3 * beam.extrapolated()), fmt::format("{:.4f}", 1e3 * beam.theory),
                            percent(mesh.relative), percent(std::max(0.0, locking_of(beams, mesh)))});
    }
  return table;
}

TextTable refinement_table(const RefinementStudy& study) {
  TextTable table;
  table.head = {"mesh", "tetrahedra", "error, of the energy norm", "estimated"};
  table.first_number = 1, table.end_numbers = table.head.size();
  for (const RefinedMesh& mesh : study.meshes)
    table.rows.push_back({mesh.adapted ? "adapted" : "uniform", std::to_string(mesh.tets), percent(mesh.error),
                          percent(mesh.estimated)});
  return table;
}

TextTable error_estimate_table(const AccuracyStudy& study) {
  TextTable table;
  table.head = {"body", "tetrahedra", "error, of the energy norm", "estimated", "effectivity", "error", "estimated"};
  table.first_number = 1, table.end_numbers = table.head.size();
  for (const LockingBeam& beam : study.locking)
    add_gauged(table, fmt::format("beam at rest, Poisson's ratio {}", beam.poisson), beam.convergence);
  for (const SceneStudy& scene : study.scenes) add_gauged(table, scene.name + " at rest", scene.convergence);
  return table;
}

TextTable law_table(const std::vector<LawCheck>& laws) {
  TextTable table;
  table.head = {"law", "force left over, of a node's weight"};
  table.first_number = 1, table.end_numbers = 2;
  for (const LawCheck& law : laws)
    table.rows.push_back(
        {law.law, law.failed.empty() ? fmt::format("{:.1e}", law.left_over) : "failed: " + law.failed});
  return table;
}

TextTable feature_table(const FeatureStudy& study) {
  TextTable table;
  table.head = {"feature", "from", "to", "ms a tick", "of as it is", "error"};
  table.first_number = 3, table.end_numbers = 6;
  const double as_it_is = study.measurement.changes.front().milliseconds;
  for (const MeasuredChange& c : study.measurement.changes)
    table.rows.push_back({c.feature, c.from, c.to, short_number(c.milliseconds), percent(c.milliseconds / as_it_is),
                          c.halted.empty() ? length_text(c.error) : c.halted});
  return table;
}

TextTable run_table(const AccuracyStudy& study) {
  TextTable table;
  table.head = {"scene",
                "laws",
                "element",
                "nodes",
                "tets",
                "integrator",
                "step_s",
                "iterations_allowed",
                "precision",
                "threads",
                "failed",
                "simulated_s",
                "time_error_m",
                "error_resolved",
                "relative_error",
                "last_error_m",
                "mesh_error_m",
                "seconds_per_second",
                "tick_p50_s",
                "tick_p99_s",
                "steps",
                "iterations",
                "frequency_error",
                "added_decay_per_s",
                "energy_drift",
                "volume",
                "min_J",
                "cpu",
                "cores",
                "compiler",
                "flags",
                "version",
                "commit"};
  const Machine machine = this_machine();
  for (const SceneStudy& scene : study.scenes)
    for (const TimeStudy& time : scene.time)
      for (const Measured& m : time.measured) {
        const auto error = [&](double value) { return m.failed() ? "" : fmt::format("{:.6g}", value); };
        table.rows.push_back({scene.name,
                              fmt::format("{}", fmt::join(scene.laws, " ")),
                              time.element,
                              std::to_string(time.nodes),
                              std::to_string(time.tets),
                              integrator_name(m.method.integrator),
                              optional_number(m.method.step),
                              std::to_string(m.method.iterations),
                              m.method.single_precision ? "float" : "double",
                              std::to_string(threads_of(m.method)),
                              m.run.failed,
                              fmt::format("{:.6g}", m.run.simulated),
                              error(m.error),
                              m.failed()   ? ""
                              : m.resolved ? "yes"
                                           : "no",
                              error(m.relative),
                              error(m.last_error),
                              optional_number(scene.mesh_error(time.element)),
                              fmt::format("{:.6g}", m.seconds_per_second()),
                              fmt::format("{:.6g}", m.run.median_tick),
                              fmt::format("{:.6g}", m.run.slow_tick),
                              std::to_string(m.run.steps),
                              std::to_string(m.run.iterations),
                              optional_number(m.frequency_error),
                              optional_number(m.added_decay),
                              optional_number(m.run.energy_drift),
                              error(m.run.volume),
                              error(m.run.min_J),
                              machine.cpu,
                              std::to_string(machine.cores),
                              machine.compiler,
                              machine.flags,
                              machine.version,
                              machine.commit});
      }
  return table;
}

}  // namespace heml
