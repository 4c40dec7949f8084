#include <fmt/format.h>

#include <algorithm>
#include <heml/base/error.hpp>
#include <heml/scenario/csv_text.hpp>
#include <heml/scenario/haptic_run.hpp>
#include <heml/scenario/json_text.hpp>
#include <heml/scenario/player.hpp>
#include <heml/scenario/text_file.hpp>

namespace heml {
namespace {

constexpr std::string_view header = "time,x,y,z";
constexpr double turn = 1e-3;  // s

Scene without_moves(Scene scene) {
  std::vector<Event> events;
  std::map<std::size_t, std::vector<Vec3>> points;
  for (std::size_t k = 0; k < scene.events.size(); ++k) {
    if (std::holds_alternative<MoveTool>(scene.events[k].command)) continue;
    if (const auto place = scene.points.find(k); place != scene.points.end()) points[events.size()] = place->second;
    events.push_back(scene.events[k]);
  }
  scene.events = std::move(events);
  scene.points = std::move(points);
  return scene;
}

}  // namespace

Vec3 HandleTrajectory::at(double time) const {
  const auto after = std::upper_bound(times.begin(), times.end(), time);
  if (after == times.begin()) return positions.front();
  if (after == times.end()) return positions.back();
  const auto k = static_cast<std::size_t>(after - times.begin());
  const double share = (time - times[k - 1]) / (times[k] - times[k - 1]);
  return positions[k - 1] + share * (positions[k] - positions[k - 1]);
}

HandleTrajectory read_handle_csv(const std::filesystem::path& path) {
  const std::string content = read_text_file(path);
  std::string_view text = content;
  const auto fail = [&](long line, const std::string& problem, const std::string& remedy) {
    throw InputError(path.string(), fmt::format("line {}", line), problem, remedy);
  };
  if (const std::string_view first = consume_line(text); first != header)
    fail(1, fmt::format("is '{}'", shown(first)), fmt::format("must be the header {}", header));
  HandleTrajectory handle;
  for (long line = 2; !text.empty(); ++line) {
    const std::string_view entry = consume_line(text);
    if (is_blank(entry)) continue;
    std::string_view rest = entry;
    double time = 0;
    Vec3 x;
    const bool read = consume_number(rest, time) && consume_number(rest, x[0]) && consume_number(rest, x[1]) &&
                      consume_number(rest, x[2]);
    if (!read || !rest.empty() || !x.allFinite() || !(time >= 0 && time < HUGE_VAL))
      fail(line, fmt::format("is '{}'", shown(entry)), "must be time,x,y,z: seconds and metres");
    if (!handle.times.empty() && !(time > handle.times.back()))
      fail(line, fmt::format("is of {} s, after {} s", time, handle.times.back()), "times must rise");
    handle.times.push_back(time);
    handle.positions.push_back(x);
  }
  if (handle.times.empty())
    throw InputError(path.string(), "", "has no position of the handle", "give one line at least");
  return handle;
}

HapticRun run_with_handle(const Scene& scene, const HandleTrajectory& handle, const HapticLimits& limits) {
  if (scene.solver.is_static())
    throw InputError(scene.file, "solver.integrator", "is static, and a handle moves", "give another integrator");
  const Scene script = without_moves(scene);
  const auto world = load_world(script);
  Player player(script, *world);
  HapticServo servo(limits);
  HapticRun run;
  const double tick = scene.solver.tick(), end = std::min(scene.solver.duration, handle.times.back());
  for (long k = 1; static_cast<double>(k) * tick <= end * (1 + 1e-12); ++k) {
    const double now = static_cast<double>(k) * tick;
    if (find_grasp(world->tools(), 0))
      if (const Status moved = world->apply(MoveTool{handle.at(now - tick)}); !moved.ok())
        throw InputError(scene.file, "", "the tool cannot follow the handle: " + moved.message(),
                         "give another trajectory");
    player.to(now);
    if ((run.halt = world->halt())) break;
    const std::vector<ToolState> tools = world->tools();
    if (const GraspState* grasp = find_grasp(tools, 0))
      servo.update({now, grasp->target, grasp->force});
    else
      servo.release();
    while (static_cast<double>(run.samples.size()) * turn < now + tick) {  // until the next tick is done
      const double time = static_cast<double>(run.samples.size()) * turn;
      const Vec3 place = handle.at(time), force = time < now ? Vec3(Vec3::Zero()) : servo.serve(place, turn);
      run.samples.push_back({time, place, force, servo.energy(), servo.added_damping()});
    }
  }
  return run;
}

}  // namespace heml
