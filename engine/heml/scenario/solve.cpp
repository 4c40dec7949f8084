#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/scenario/player.hpp>
#include <heml/scenario/recorder.hpp>
#include <heml/scenario/recovery_watch.hpp>
#include <heml/scenario/report.hpp>
#include <heml/scenario/solve.hpp>
#include <heml/scenario/trace.hpp>
#include <vector>

namespace heml {
namespace {

namespace fs = std::filesystem;

constexpr const char* recovery_file = "recovery.jsonl";

/// A time the run has to land on, or in a static scene a fraction of the load, and the file its state goes to.
struct Landing {
  double time;  ///< s
  std::string stem;
};

/// In ascending order of time, the end last.
std::vector<Landing> landings_of(const Scene& scene) {
  const bool is_static = scene.solver.is_static();
  std::vector<Landing> landings;
  for (const double time : scene.output_times) {
    if (is_static && !(time >= 0 && time <= 1))
      throw InputError(scene.file, fmt::format("outputs.times[{}]", landings.size()), fmt::format("is {}", time),
                       "in a static scene times are fractions of the load, 0 to 1");
    landings.push_back({time, fmt::format("positions_{}", landings.size())});
  }
  std::stable_sort(landings.begin(), landings.end(),
                   [](const Landing& a, const Landing& b) { return a.time < b.time; });
  landings.push_back({is_static ? 1 : scene.solver.duration, "positions"});
  return landings;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder, error))
    throw InputError(folder.string(), "", fmt::format("cannot be made: {}", error ? error.message() : "is a file"),
                     "name a folder that can be written");
}

/// Of an earlier solve: a run that stops early must not leave them standing as its own.
void remove_outputs(const fs::path& folder, const std::vector<Landing>& landings) {
  std::error_code ignored;
  fs::remove(folder / "report.json", ignored);
  for (const char* file : {recovery_file, Trace::markers_file, Trace::history_file}) fs::remove(folder / file, ignored);
  for (const Landing& landing : landings)
    for (const char* ending : {".csv", ".vtu"}) fs::remove(folder / (landing.stem + ending), ignored);
}

}  // namespace

SolveResult solve(const Scene& scene, const fs::path& out, const std::function<void(double)>& progress) {
  const std::vector<Landing> landings = landings_of(scene);
  const std::unique_ptr<World> world = load_world(scene);
  make_folder(out);
  remove_outputs(out, landings);

  Player player(scene, *world);
  Trace trace(scene, *world);
  trace.take(*world);
  const Scene recorded = scene.solver.recovery ? as_recorded(scene, *world) : scene;
  RecoveryWatch watch;
  const auto on_tick = [&] {
    const auto news = watch.after_tick(*world);
    if (news != RecoveryWatch::News::none) write_replay(out / recovery_file, recorded, player.past_events(), *world);
    if (news == RecoveryWatch::News::began)
      warn("{}; {} shows it again", world->recovery()->message, (out / recovery_file).string());
    trace.take(*world);
    if (progress) progress(static_cast<double>(world->ticks()) * scene.solver.tick() / scene.solver.duration);
    return true;
  };
  double seconds = 0;
  for (const Landing& landing : landings) {
    const auto begin = std::chrono::steady_clock::now();
    player.to(landing.time, on_tick);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    trace.take(*world);
    const bool last = &landing == &landings.back();
    if (last || !world->halt())
      write_state(out, landing.stem, *world, last || scene.output_positions, scene.output_vtu);
  }
  trace.write(out);
  SolveFacts facts;
  facts.halt = world->halt();
  facts.converged = !facts.halt;
  facts.wall_seconds = seconds;
  write_report(out / "report.json", *world, facts);
  return {world->halt(), world->ticks(), world->steps(), world->time(), seconds};
}

}  // namespace heml
