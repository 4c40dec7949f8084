#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <heml/base/error.hpp>
#include <heml/scenario/report.hpp>
#include <heml/scenario/schedule.hpp>
#include <heml/scenario/solve.hpp>
#include <vector>

namespace heml {
namespace {

namespace fs = std::filesystem;

constexpr double same_tick = 1e-6;  // of a tick: a time this close to its end is meant to be its end

/// A time the run has to land on, and the file its state goes to.
struct Stop {
  double time;  ///< s
  std::string stem;
};

/// In ascending order of time, the end last.
std::vector<Stop> stops_of(const Scene& scene) {
  std::vector<Stop> stops;
  for (const double time : scene.output_times) stops.push_back({time, fmt::format("positions_{}", stops.size())});
  std::stable_sort(stops.begin(), stops.end(), [](const Stop& a, const Stop& b) { return a.time < b.time; });
  stops.push_back({scene.solver.duration, "positions"});
  return stops;
}

/// Advances a world through its ticks, events included, to times between them.
class Run {
 public:
  Run(const Scene& scene, World& world)
      : world_(world), schedule_(scene, world.setup().mesh), tick_(scene.solver.tick()) {}

  void to(double time, const std::function<void()>& on_tick) {
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
  double tick_;             ///< s
  double tick_start_ = 0;   ///< s, by the world's clock
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
void remove_outputs(const fs::path& folder, const std::vector<Stop>& stops) {
  std::error_code ignored;
  fs::remove(folder / "report.json", ignored);
  for (const Stop& stop : stops)
    for (const char* ending : {".csv", ".vtu"}) fs::remove(folder / (stop.stem + ending), ignored);
}

}  // namespace

SolveResult solve(const Scene& scene, const fs::path& out, const std::function<void(double)>& progress) {
  const std::unique_ptr<World> world = load_world(scene);
  const std::vector<Stop> stops = stops_of(scene);
  make_folder(out);
  remove_outputs(out, stops);

  Run run(scene, *world);
  const auto on_tick = [&] {
    if (progress) progress(static_cast<double>(world->ticks()) * scene.solver.tick() / scene.solver.duration);
  };
  double seconds = 0;
  for (const Stop& stop : stops) {
    const auto begin = std::chrono::steady_clock::now();
    run.to(stop.time, on_tick);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const bool last = &stop == &stops.back();
    if (last || !world->halt()) write_state(out, stop.stem, *world, last || scene.output_positions, scene.output_vtu);
  }
  SolveFacts facts;
  facts.halt = world->halt();
  facts.converged = !facts.halt;
  facts.wall_seconds = seconds;
  write_report(out / "report.json", *world, facts);
  return {world->halt(), world->ticks(), world->steps(), world->time(), seconds};
}

}  // namespace heml
