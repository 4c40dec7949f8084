// Steps of a hanging cube with one to all threads, from 320 to a million tetrahedra, interleaved with one thread: on an
// idle machine, and with one core taken by another process, as by drawing without a graphics card.
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <heml/world/world.hpp>
#include <studies/bench.hpp>
#include <studies/bench_bodies.hpp>
#include <studies/interleaved_timing.hpp>
#include <thread>

namespace heml {
namespace {

/// A process that keeps one core busy for the lifetime of the object.
class BusyProcess {
 public:
  BusyProcess() : process_(fork()) {
    if (process_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (volatile unsigned turn = 0;;) turn = turn + 1;
  }
  ~BusyProcess() {
    if (process_ <= 0) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  BusyProcess(const BusyProcess&) = delete;
  BusyProcess& operator=(const BusyProcess&) = delete;

 private:
  pid_t process_;
};

struct TimedMethod {
  Integrator integrator;
  bool single;
};

std::unique_ptr<World> timed_world(const BenchBody& body, const TimedMethod& method, int threads) {
  const LameParameters lame = lame_parameters(1e4, 0.3);
  Material material;
  material.law = "stvk";
  material.parameters = {lame.lambda, lame.mu};
  WorldSetup setup = hanging_cube(body.mesh, material);
  setup.solver.integrator = method.integrator;
  setup.solver.single_precision = method.single;
  setup.solver.threads = threads;
  if (!is_explicit(method.integrator)) {
    setup.solver.step = 1.0 / 60;
    setup.solver.budget = Budget{1, 0};
  }
  auto world = make_world(setup);
  for (int k = 0; k < 3; ++k) world->tick();  // warm-up: masses, factorisations, first step bound
  return world;
}

/// All up to four, then fewer and fewer.
std::vector<int> numbers_of_threads() {
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  std::vector<int> numbers;
  for (int threads = 1; threads <= cores; threads += std::max(1, threads / 4 * 2)) numbers.push_back(threads);
  if (numbers.back() != cores) numbers.push_back(cores);
  return numbers;
}

/// One row per number of threads, their worlds interleaved.
std::vector<BenchRow> time_threads(const BenchBody& body, const TimedMethod& method, bool loaded, bool quick) {
  const std::vector<int> numbers = numbers_of_threads();
  std::vector<std::unique_ptr<World>> worlds;
  std::vector<std::function<void()>> works;
  std::vector<long> steps, ticks;
  for (const int threads : numbers) {
    worlds.push_back(timed_world(body, method, threads));
    World& world = *worlds.back();
    works.push_back([&world] { world.tick(); });
    steps.push_back(world.steps());
    ticks.push_back(world.ticks());
  }
  std::optional<BusyProcess> other;
  if (loaded) other.emplace();
  TimingLimits limits;
  limits.seconds = quick ? 0.3 : 4;
  limits.min_rounds = 3;
  limits.min_sample = quick ? 0 : 0.02;  // s, longer than another program's time slice
  const auto times = time_interleaved(works, limits);
  std::vector<BenchRow> rows;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double a_tick =
        static_cast<double>(worlds[k]->steps() - steps[k]) / static_cast<double>(worlds[k]->ticks() - ticks[k]);
    BenchRow row;
    row.name = fmt::format("{}, {}", integrator_name(method.integrator), loaded ? "one core loaded" : "idle");
    row.mesh = body.name;
    row.nodes = body.mesh.nodes.size();
    row.tets = body.mesh.tets.size();
    row.law = "stvk";
    row.precision = method.single ? "float" : "double";
    row.isa = name_of(instruction_sets().back());
    row.threads = numbers[k];
    row.unit = "ms";
    row.median = 1e3 * times[k].median / a_tick;
    row.min = 1e3 * times[k].min / a_tick;
    const double speedup = times[0].median / times[k].median;
    row.more = {{"spread", times[k].spread}, {"samples", times[k].samples}, {"speedup", speedup}};
    if (k > 0) row.remark = fmt::format("{:.2f} times as fast as one thread (medians)", speedup);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::vector<BenchRow> threads_suite(const BenchOptions& options) {
  std::vector<BenchRow> rows;
  const std::vector<int> cells = options.quick ? std::vector<int>{4, 13, 27} : std::vector<int>{4, 9, 13, 18, 27, 58};
  const TimedMethod methods[] = {
      {Integrator::verlet, true}, {Integrator::verlet, false}, {Integrator::backward_euler, false}};
  double done = 0;
  for (const int n : cells) {
    const BenchBody body = bench_cube(n, false);
    for (const TimedMethod& method : methods)
      for (const bool loaded : {false, true}) {
        options.progress("threads", done++ / static_cast<double>(6 * cells.size()));
        for (BenchRow& row : time_threads(body, method, loaded, options.quick)) rows.push_back(std::move(row));
      }
  }
  return rows;
}

}  // namespace heml
