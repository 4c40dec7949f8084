#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <heml/scenario/recovery_watch.hpp>
#include <heml/scenario/report.hpp>
#include <heml/scenario/schedule.hpp>
#include <heml/scenario/solve.hpp>
#include <vector>

namespace heml {
namespace {

namespace fs = std::filesystem;

constexpr const char* recovery_file = "recovery.jsonl";
constexpr double same_tick = 1e-6;  // of a tick: a time this close to its end is meant to be its end

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

/// Advances a world through its ticks, events included, to times between them.
class Run {
 public:
  Run(const Scene& scene, World& world)
      : world_(world), schedule_(scene, world.setup().mesh), tick_(scene.solver.tick()) {}

  void to(double time, const std::function<void()>& on_tick) {
    if (world_.setup().solver.is_static()) {
      begin_tick();
      return world_.load_to(time);
    }
    const double ticks = time / tick_, nearest = std::round(ticks);
    const bool at_tick = std::abs(ticks - nearest) < same_tick;
    const long whole = static_cast<long>(at_tick ? nearest : std::floor(ticks));
    while (world_.ticks() < whole && !world_.halt()) {
      begin_tick();
      world_.tick();
      on_tick();
    }
    if (at_tick || world_.halt()) return;
    begin_tick();
    world_.advance_within_tick(tick_start_ + (time - static_cast<double>(whole) * tick_));
  }

  std::span<const Event> past_events() const { return schedule_.past(); }

 private:
  /// Applies the events of the coming tick, once. The world's own clock starts anew at a reset.
  void begin_tick() {
    if (begun_ == world_.ticks()) return;
    begun_ = world_.ticks();
    schedule_.apply(world_);
    tick_start_ = world_.time();
  }

  World& world_;
  Schedule schedule_;
  double tick_;            ///< s
  double tick_start_ = 0;  ///< s, by the world's clock
  long begun_ = -1;
};

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
  fs::remove(folder / recovery_file, ignored);
  for (const Landing& landing : landings)
    for (const char* ending : {".csv", ".vtu"}) fs::remove(folder / (landing.stem + ending), ignored);
}

}  // namespace

SolveResult solve(const Scene& scene, const fs::path& out, const std::function<void(double)>& progress) {
  const std::vector<Landing> landings = landings_of(scene);
  const std::unique_ptr<World> world = load_world(scene);
  make_folder(out);
  remove_outputs(out, landings);

  Run run(scene, *world);
  Scene recorded = scene;
  if (scene.solver.recovery) recorded.recorded_mesh = identity_of(world->setup().mesh);
  RecoveryWatch watch;
  const auto on_tick = [&] {
    const auto news = watch.after_tick(*world);
    if (news != RecoveryWatch::News::none) write_replay(out / recovery_file, recorded, run.past_events(), *world);
    if (news == RecoveryWatch::News::began)
      warn("{}; {} shows it again", world->recovery()->message, (out / recovery_file).string());
    if (progress) progress(static_cast<double>(world->ticks()) * scene.solver.tick() / scene.solver.duration);
  };
  double seconds = 0;
  for (const Landing& landing : landings) {
    const auto begin = std::chrono::steady_clock::now();
    run.to(landing.time, on_tick);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const bool last = &landing == &landings.back();
    if (last || !world->halt())
      write_state(out, landing.stem, *world, last || scene.output_positions, scene.output_vtu);
  }
  SolveFacts facts;
  facts.halt = world->halt();
  facts.converged = !facts.halt;
  facts.wall_seconds = seconds;
  write_report(out / "report.json", *world, facts);
  return {world->halt(), world->ticks(), world->steps(), world->time(), seconds};
}

}  // namespace heml
