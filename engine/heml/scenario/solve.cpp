#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/base/write_file.hpp>
#include <heml/scenario/input_files.hpp>
#include <heml/scenario/player.hpp>
#include <heml/scenario/recorder.hpp>
#include <heml/scenario/recovery_monitor.hpp>
#include <heml/scenario/report.hpp>
#include <heml/scenario/solve.hpp>
#include <heml/scenario/trace.hpp>
#include <vector>

namespace heml {
namespace {

namespace fs = std::filesystem;

constexpr const char* recovery_file = "recovery.jsonl";

/// A time the run has to land on, and the file stem of the state written there.
struct Landing {
  double time;  ///< s; in a static scene, fraction of the load
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

/// All files a run may write. Those of an earlier solve are removed first, so that a run that stops early does not
/// leave them as its own.
std::vector<fs::path> outputs_in(const fs::path& folder, const std::vector<Landing>& landings) {
  std::vector<fs::path> files;
  for (const char* file : {"report.json", recovery_file, Trace::markers_file, Trace::history_file})
    files.push_back(folder / file);
  for (const Landing& landing : landings)
    for (const char* ending : {".csv", ".vtu"}) files.push_back(folder / (landing.stem + ending));
  return files;
}

}  // namespace

SolveResult solve(const Scene& scene, const fs::path& out, const std::function<void(double)>& progress) {
  const std::vector<Landing> landings = landings_of(scene);
  const std::vector<fs::path> outputs = outputs_in(out, landings);
  check_output_folder(input_files(scene), out, outputs);
  const std::unique_ptr<World> world = load_world(scene);
  make_folder(out);
  std::error_code ignored;
  for (const fs::path& file : outputs) fs::remove(file, ignored);

  Player player(scene, *world);
  Trace trace(scene, *world);
  trace.sample(*world);
  const Scene recorded = scene.solver.recovery ? as_recorded(scene, *world) : scene;
  RecoveryMonitor watch;
  const auto on_tick = [&] {
    const auto news = watch.after_tick(*world);
    if (news != RecoveryMonitor::Change::none && !world->halt())
      write_replay(out / recovery_file, recorded, player.past_events(), *world);
    if (news == RecoveryMonitor::Change::began)
      warn("{}; {} shows it again", world->recovery()->message, (out / recovery_file).string());
    trace.sample(*world);
    if (progress) progress(static_cast<double>(world->ticks()) * scene.solver.tick() / scene.solver.duration);
    return true;
  };
  double seconds = 0;
  std::optional<InputError> refused;
  for (const Landing& landing : landings) {
    const bool last = &landing == &landings.back();
    if (!refused) {
      const auto begin = std::chrono::steady_clock::now();
      try {
        player.to(landing.time, on_tick);
      } catch (const InputError& error) {
        refused = error;
      }
      seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      trace.sample(*world);
    }
    const bool reached = !refused && !world->halt();
    if (last || reached) write_state(out, landing.stem, *world, last || scene.output_positions, scene.output_vtu);
  }
  trace.write(out);
  SolveFacts facts;
  facts.halt = world->halt();
  if (refused) facts.refused = refused->what();
  facts.converged = !facts.halt && !refused && world->solver_stats().unconverged_steps == 0;
  facts.wall_seconds = seconds;
  write_report(out / "report.json", *world, facts);
  if (const std::string message = rescue_message(world->solver_stats()); !message.empty()) warn("{}", message);
  if (refused) {
    warn("an event was refused; what was reached before it is in {}", out.string());
    throw *refused;
  }
  return {world->halt(), world->ticks(), world->steps(), world->time(), seconds};
}

}  // namespace heml
