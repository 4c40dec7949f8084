#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <studies/accuracy_reference.hpp>

namespace heml {
namespace {

constexpr double pilot_share = 0.1;      // of the smallest stable step of the pilot run
constexpr double max_seconds = 600;      // s of processor time
constexpr std::size_t many_tets = 5000;  // larger meshes run on all cores

/// Runs Verlet with about `part` of the stable step. Whole steps fill a tick of the scene, so events keep their times.
Run fine_run(const Problem& problem, const Run& pilot, double part, const RunOptions& options) {
  const double tick = problem.scene.solver.tick();
  Method method{Integrator::verlet, tick / std::ceil(tick / (part * pilot.min_step))};
  if (problem.setup.mesh.tets.size() > many_tets) method.threads = 0;
  return play(problem, method, options);
}

Json positions_json(const std::vector<Vec3>& x) {
  Json list = Json::array();
  for (const Vec3& at : x)
    for (int i = 0; i < 3; ++i) list.push_back(at[i]);
  return list;
}

}  // namespace

double max_distance(const std::vector<std::vector<Vec3>>& a, const std::vector<std::vector<Vec3>>& b,
                    const std::vector<double>& mass) {
  double largest = 0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
    largest = std::max(largest, rms_distance(a[k], b[k], mass));
  return largest;
}

Reference reference_of(const Problem& problem, const Run& pilot, RunOptions options) {
  Reference reference;
  reference.stable_step = pilot.min_step;
  if (!(pilot.min_step > 0) || !std::isfinite(pilot.min_step)) {
    reference.failure = "verlet took no step";
    return reference;
  }
  options.longest = max_seconds;
  options.repeat_below = 0;
  const Run coarse = fine_run(problem, pilot, pilot_share, options);
  if (coarse.failed.empty()) {
    const Run fine = fine_run(problem, pilot, pilot_share / 2, options);
    reference.failure = fine.failed;
    reference.step = fine.steps > 0 ? fine.simulated / static_cast<double>(fine.steps) : 0;
    reference.change = max_distance(coarse.at, fine.at, problem.mass);
    reference.seconds = coarse.seconds + fine.seconds;
    reference.at = fine.at;
    reference.first_mode = fine.first_mode;
    const std::vector<std::vector<Vec3>> rest(fine.at.size(), problem.setup.mesh.nodes);
    reference.motion = max_distance(fine.at, rest, problem.mass);
  } else {
    reference.failure = coarse.failed;
  }
  if (reference.failure.empty() && !(reference.motion > 0)) reference.failure = "nothing moves";
  if (reference.failure.empty() && !(reference.resolution() < reference.motion / 10))
    reference.failure = fmt::format("halving a step of {:.3g} ms moves nodes by {:.3g} mm: the motion is chaotic",
                                    2e3 * reference.step, 1e3 * reference.change);
  return reference;
}

Json to_json(const Reference& reference) {
  Json json = {{"problem", reference.failure}, {"stable_step", reference.stable_step}, {"step", reference.step},
               {"change", reference.change},   {"motion", reference.motion},           {"seconds", reference.seconds},
               {"at", Json::array()}};
  for (const auto& x : reference.at) json["at"].push_back(positions_json(x));
  if (reference.first_mode) json["swing"] = {reference.first_mode->frequency, reference.first_mode->decay};
  return json;
}

Reference reference_from(const Json& json) {
  const auto number = [&](const char* name) { return json[name].is_null() ? 0 : json[name].get<double>(); };
  Reference reference{json["problem"],
                      number("stable_step"),
                      number("step"),
                      number("change"),
                      number("motion"),
                      number("seconds"),
                      {},
                      {}};
  for (const Json& list : json["at"]) {
    std::vector<Vec3>& x = reference.at.emplace_back();
    for (std::size_t k = 0; k + 2 < list.size(); k += 3) x.emplace_back(list[k], list[k + 1], list[k + 2]);
  }
  if (json.contains("swing")) reference.first_mode = FirstMode{json["swing"][0], json["swing"][1]};
  return reference;
}

}  // namespace heml
