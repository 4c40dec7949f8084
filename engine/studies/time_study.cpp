#include <fmt/format.h>

#include <algorithm>
#include <studies/time_study.hpp>
#include <thread>

namespace heml {
namespace {

constexpr int set_time_count = 4;
constexpr double gauged_below = 5;  // s, wall time: longer runs are not repeated for the step-doubling estimate
constexpr double above_limit = 3;   // times the stable step, which includes a safety margin

Json run_json(const Run& run) {
  Json json = {{"failed", run.failed},       {"simulated", run.simulated},
               {"seconds", run.seconds},     {"median_tick", run.median_tick},
               {"slow_tick", run.slow_tick}, {"ticks", run.ticks},
               {"steps", run.steps},         {"iterations", run.iterations},
               {"volume", run.volume},       {"least_J", run.min_J}};
  if (run.first_mode) json["swing"] = {run.first_mode->frequency, run.first_mode->decay};
  if (run.energy_drift) json["energy_drift"] = *run.energy_drift;
  return json;
}

Run run_from(const Json& json) {
  Run run;
  run.failed = json["failed"];
  run.simulated = json["simulated"], run.seconds = json["seconds"];
  run.median_tick = json["median_tick"], run.slow_tick = json["slow_tick"];
  run.ticks = json["ticks"], run.steps = json["steps"], run.iterations = json["iterations"];
  run.volume = json["volume"].is_null() ? 0 : json["volume"].get<double>();
  run.min_J = json["least_J"].is_null() ? 0 : json["least_J"].get<double>();
  if (json.contains("swing")) run.first_mode = FirstMode{json["swing"][0], json["swing"][1]};
  if (json.contains("energy_drift") && !json["energy_drift"].is_null()) run.energy_drift = json["energy_drift"];
  return run;
}

Json measure(const Problem& problem, const Method& method, const Reference& reference, const RunOptions& options) {
  const Run run = play(problem, method, options);
  Json json = run_json(run);
  if (!run.failed.empty()) return json;
  json["error"] = max_distance(run.at, reference.at, problem.mass);
  const double first = rms_distance(run.at.front(), reference.at.front(), problem.mass);
  const bool is_short = run.seconds < gauged_below && method.threads == 1 && !method.single_precision;
  if (is_short && first > reference.resolution())
    if (const auto gauged = step_doubling_error(problem, method, options.times.front(), options))
      json["gauge"] = *gauged / first;
  json["last_error"] = rms_distance(run.at.back(), reference.at.back(), problem.mass);
  return json;
}

Measured measured_from(const Json& json, const Method& method, const Reference& reference) {
  Measured measured;
  measured.method = method;
  measured.run = run_from(json);
  if (measured.failed()) return measured;
  const double error = json["error"];
  measured.resolved = error >= reference.resolution();
  measured.error = std::max(error, reference.resolution());
  measured.last_error = json["last_error"];
  if (json.contains("gauge")) measured.step_doubling = json["gauge"];
  measured.relative = measured.error / reference.motion;
  if (measured.run.first_mode && reference.first_mode) {
    measured.frequency_error = measured.run.first_mode->frequency / reference.first_mode->frequency - 1;
    measured.added_decay = measured.run.first_mode->decay - reference.first_mode->decay;
  }
  return measured;
}

bool several_cores() { return std::thread::hardware_concurrency() > 1; }

void add_explicit(std::vector<Method>& list, Breadth sweep, double stable_step) {
  list.push_back({Integrator::symplectic_euler});
  list.push_back({Integrator::verlet});
  list.push_back({Integrator::verlet, above_limit * stable_step});  // beyond the stable step: expected to fail
  if (sweep == Breadth::brief) return;
  list.push_back({Integrator::verlet, {}, 0, true});
  if (several_cores()) list.push_back({Integrator::verlet, {}, 0, false, 0});
  list.push_back({Integrator::verlet, 0.5 * stable_step});
  list.push_back({Integrator::symplectic_euler, 0.5 * stable_step});
}

void add_implicit(std::vector<Method>& list, Breadth sweep) {
  const std::vector<Integrator> integrators = implicit_integrators();
  if (sweep == Breadth::brief) {
    for (const Integrator integrator : integrators)
      for (const double step : {1.0 / 60, 0.005}) list.push_back({integrator, step, 1});
    return;
  }
  for (const Integrator integrator : integrators)
    for (const double step : {1.0 / 30, 1.0 / 60, 0.01, 0.005, 0.002})
      for (const int iterations : {1, 0}) list.push_back({integrator, step, iterations});
  for (const Integrator integrator : {Integrator::backward_euler, Integrator::tr_bdf2}) {
    list.push_back({integrator, 0.01, 3});
    list.push_back({integrator, 0.01, 1, true});
    if (several_cores()) list.push_back({integrator, 0.01, 1, false, 0});
  }
}

}  // namespace

std::vector<Method> methods_of(Breadth sweep, double stable_step) {
  std::vector<Method> list;
  add_explicit(list, sweep, stable_step);
  add_implicit(list, sweep);
  return list;
}

std::size_t steps_of_time_study(Breadth sweep) { return 1 + methods_of(sweep, 1).size(); }

std::vector<double> set_times(const Scene& scene) {
  std::vector<double> times = scene.output_times;
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  std::erase_if(times, [&](double t) { return !(t > 0) || t > scene.solver.duration; });
  if (times.empty())
    for (int k = 1; k <= set_time_count; ++k) times.push_back(scene.solver.duration * k / set_time_count);
  return times;
}

TimeStudy study_time(const std::string& key, const Problem& problem, const std::vector<double>& times, Breadth sweep,
                     const StudyContext& context) {
  TimeStudy study;
  study.problem = text_of(problem);
  study.nodes = problem.setup.mesh.nodes.size();
  study.tets = problem.setup.mesh.tets.size();
  study.element = problem.element();
  const std::string place = fmt::format("{}|{}", key, study.problem);
  RunOptions options{times};
  options.make = context.make;

  study.reference = reference_from(context.kept(place + "|reference", [&] {
    Problem exact = problem;
    exact.scene.solver.mass_scaling = 0;
    return to_json(reference_of(exact, play(exact, {Integrator::verlet}, options), options));
  }));
  if (!study.reference.failure.empty()) return study;

  for (const Method& method : methods_of(sweep, study.reference.stable_step)) {
    const std::string text = text_of(method);
    study.measured.push_back(measured_from(
        context.kept(place + "|" + text, [&] { return measure(problem, method, study.reference, options); }), method,
        study.reference));
  }
  study.reference.at.clear();
  return study;
}

}  // namespace heml
