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
  for (const double time : scene.output_times) landings.push_back({time, fmt::format("positions_{}", landings.size())});
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

/// What a solve does beside stepping. at_landing: reached tells whether the world got to the landing's time.
struct Observers {
  std::function<bool()> on_tick;
  std::function<void(const Landing& landing, bool is_last, bool reached)> at_landing;
};

struct Outcome {
  SolveFacts facts;
  std::optional<InputError> refused;  ///< the event that ended it
};

/// Steps to every landing in turn. An event that the world refuses ends it.
Outcome play(const std::vector<Landing>& landings, World& world, Player& player, const Observers& observers) {
  Outcome outcome;
  for (const Landing& landing : landings) {
    if (!outcome.refused) {
      const auto begin = std::chrono::steady_clock::now();
      try {
        player.to(landing.time, observers.on_tick);
      } catch (const InputError& error) {
        outcome.refused = error;
      }
      outcome.facts.wall_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
    observers.at_landing(landing, &landing == &landings.back(), !outcome.refused && !world.halt());
  }
  outcome.facts.halt = world.halt();
  if (outcome.refused) outcome.facts.refused = outcome.refused->what();
  outcome.facts.converged = !outcome.facts.halt && !outcome.refused && world.solver_stats().unconverged_steps == 0;
  return outcome;
}

/// left_out: events of the scene that a run to its end has not played.
void warn_of_left_out_events(const Scene& scene, std::size_t left_out) {
  if (left_out == 0) return;
  const SolverSettings& solver = scene.solver;
  warn("{}: {} of {} events are left out: {}", scene.file, left_out, scene.events.size(),
       solver.is_static() ? std::string("a static solve plays those at step 0 alone")
                          : fmt::format("they come after solver.duration, {} s", solver.duration));
}

void warn_of_rescues(const Scene& scene, const World& world) {
  if (const std::string message = rescue_message(world.solver_stats()); !message.empty())
    warn("{}: {}", scene.file, message);
}

/// Tells once of the states of a run that have inverted elements, which laws without a barrier at J = 0 allow.
class InversionWatch {
 public:
  void look_at(World& world, const std::string& stem) {
    const std::string message = inversion_message(world);
    if (message.empty()) return;
    if (count_++ == 0) first_ = fmt::format("{}: {}", stem, message);
  }
  void tell(const std::string& file) const {
    if (count_ == 0) return;
    warn("{}: {}{} (move or load it more gently, or take a law that ends at J = 0)", file, first_,
         count_ > 1 ? fmt::format("; so have {} of the states after it", count_ - 1) : "");
  }

 private:
  std::string first_;
  int count_ = 0;
};

/// What the numbers of a run do not show by themselves.
void warn_of_silent_differences(const Scene& scene, const World& world) {
  const SolverSettings& solver = scene.solver;
  if (const SolverStats stats = world.solver_stats(); solver.step && !solver.budget && stats.damped_steps > 0)
    warn(
        "{}: {} of {} steps did not converge by {}; backward Euler took them, which damps (a smaller solver.step or a "
        "larger solver.tolerance may spare it)",
        scene.file, stats.damped_steps, world.steps(),
        solver.integrator == Integrator::automatic ? "their method" : integrator_name(solver.integrator));
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
  trace.sample(*world, player.time());
  const Scene recorded = scene.solver.recovery ? as_recorded(scene, *world) : scene;
  RecoveryMonitor watch;
  InversionWatch inversions;
  Observers observers;
  observers.on_tick = [&] {
    const auto news = watch.after_tick(*world);
    if (news != RecoveryMonitor::Change::none && !world->halt())
      write_replay(out / recovery_file, recorded, player.past_events(), *world);
    if (news == RecoveryMonitor::Change::began)
      warn("{}; {} shows it again", world->recovery()->message, (out / recovery_file).string());
    trace.sample(*world, player.time());
    if (progress) progress(static_cast<double>(world->ticks()) * scene.solver.tick() / scene.solver.duration);
    return true;
  };
  observers.at_landing = [&](const Landing& landing, bool is_last, bool reached) {
    trace.sample(*world, player.time());
    if (reached) inversions.look_at(*world, landing.stem);
    if (is_last || reached) write_state(out, landing.stem, *world, is_last || scene.output_positions, scene.output_vtu);
  };
  const Outcome outcome = play(landings, *world, player, observers);
  warn_of_rescues(scene, *world);
  warn_of_silent_differences(scene, *world);
  if (!outcome.facts.halt && !outcome.refused)
    warn_of_left_out_events(scene, scene.events.size() - player.past_events().size());
  inversions.tell(scene.file);
  trace.write(out);
  write_report(out / "report.json", *world, outcome.facts);
  if (outcome.refused) {
    warn("an event was refused; what was reached before it is in {}", out.string());
    throw *outcome.refused;
  }
  return {world->halt(), world->ticks(), world->steps(), world->time(), outcome.facts.wall_seconds};
}

SolveFacts solve(const Scene& scene, World& world, const std::function<bool()>& on_tick) {
  const std::vector<Landing> landings = landings_of(scene);
  Player player(scene, world);
  bool stopped = false;  // by on_tick: later landings are not gone on to
  Observers observers;
  observers.on_tick = [&] { return !stopped && !(stopped = !on_tick()); };
  observers.at_landing = [](const Landing&, bool, bool) {};
  const Outcome outcome = play(landings, world, player, observers);
  warn_of_rescues(scene, world);
  if (outcome.refused) throw *outcome.refused;
  return outcome.facts;
}

}  // namespace heml
