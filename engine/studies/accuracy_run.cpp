#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <heml/scenario/player.hpp>
#include <heml/world/step_doubling.hpp>
#include <numbers>
#include <numeric>
#include <studies/accuracy_run.hpp>

namespace heml {
namespace {

constexpr double sample_every = 1e-3;  // s, sampling period of the mean motion
constexpr double turn = 0.1;           // of the whole range: smaller reversals are no turning points
constexpr int plays = 3;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double percentile(std::vector<double> sorted, double share) {
  if (sorted.empty()) return 0;
  std::sort(sorted.begin(), sorted.end());
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

/// True if no motion, load, event, damping or inelastic material changes the total energy.
bool keeps_energy(const Problem& problem) {
  const WorldSetup& setup = problem.setup;
  const bool still = std::all_of(setup.boundary.begin(), setup.boundary.end(),
                                 [](const Boundary& b) { return b.translate.isZero() && b.degrees == 0; });
  const bool elastic = std::none_of(setup.materials.begin(), setup.materials.end(),
                                    [](const RegionMaterial& m) { return m.material.has_internal_state(); });
  return still && elastic && setup.loads.empty() && problem.scene.events.empty() && setup.solver.damping == 0;
}

double total(const Energies& e) { return e.kinetic + e.elastic + e.potential; }

/// Samples energies and mean motion of a world between ticks, outside the measured time.
class Observer {
 public:
  Observer(const Problem& problem, World& world) : problem_(problem), world_(world) {
    mass_ = std::accumulate(problem.mass.begin(), problem.mass.end(), 0.0);
    look();
    at_start_ = total(energies_);
  }

  void after_tick() {
    min_step_ = std::min(min_step_, world_.stable_step());
    if (world_.time() >= next_ - 1e-9) look();
  }

  void tell(Run& run) {
    look();
    run.min_step = min_step_;
    if (max_kinetic_ > 0 && keeps_energy(problem_)) run.energy_drift = (total(energies_) - at_start_) / max_kinetic_;
    if (const auto first_mode = first_mode_of(times_, along_axis())) run.first_mode = first_mode;
    const auto ratios = world_.volume_ratios();
    const auto& elements = world_.topology()->elements;
    double rest = 0, volume = 0;
    for (std::size_t k = 0; k < elements.size(); ++k) {
      const Tet& tet = problem_.setup.mesh.tets[static_cast<std::size_t>(elements[k])];
      const auto at = [&](std::size_t a) { return problem_.setup.mesh.nodes[static_cast<std::size_t>(tet[a])]; };
      const double V = signed_volume(at(0), at(1), at(2), at(3));
      rest += V, volume += V * ratios[k];
    }
    run.volume = volume / rest;
    run.min_J = *std::min_element(ratios.begin(), ratios.end());
  }

 private:
  void look() {
    next_ = world_.time() + sample_every;
    energies_ = world_.energies();
    max_kinetic_ = std::max(max_kinetic_, energies_.kinetic);
    Vec3 mean = Vec3::Zero();
    const auto x = world_.positions();
    for (std::size_t n = 0; n < x.size(); ++n) mean += problem_.mass[n] * (x[n] - problem_.setup.mesh.nodes[n]);
    times_.push_back(world_.time());
    means_.push_back(mean / mass_);
  }

  /// The mean displacement along the coordinate axis of its largest range.
  std::vector<double> along_axis() const {
    Vec3 low = means_.front(), high = low;
    for (const Vec3& u : means_) low = low.cwiseMin(u), high = high.cwiseMax(u);
    int axis = 0;
    (high - low).maxCoeff(&axis);
    std::vector<double> u;
    for (const Vec3& mean : means_) u.push_back(mean[axis]);
    return u;
  }

  const Problem& problem_;
  World& world_;
  double mass_ = 0, next_ = 0, at_start_ = 0, max_kinetic_ = 0;
  double min_step_ = std::numeric_limits<double>::infinity();
  Energies energies_;
  std::vector<double> times_;
  std::vector<Vec3> means_;
};

std::string failure_of(const World& world, double seconds, double longest) {
  if (world.halt()) return world.halt()->message;
  if (world.recoveries() > 0) return fmt::format("was turned inside out and recovered {} times", world.recoveries());
  if (seconds > longest) return fmt::format("stopped after {:.0f} s of computing", seconds);
  return "";
}

/// Wall time of one run: of each tick, and the sum outside ticks. Every repetition does the same work tick by tick, so
/// the minimum over several removes delays by other programs.
struct Clock {
  std::vector<double> ticks;
  double outside_ticks = 0;

  void keep_minimum(const Clock& other) {
    for (std::size_t k = 0; k < std::min(ticks.size(), other.ticks.size()); ++k)
      ticks[k] = std::min(ticks[k], other.ticks[k]);
    outside_ticks = std::min(outside_ticks, other.outside_ticks);
  }
  double seconds() const { return std::accumulate(ticks.begin(), ticks.end(), outside_ticks); }
};

Run play_once(const Problem& problem, const Method& method, const RunOptions& options, Clock& clock) {
  WorldSetup setup = problem.setup;
  const Scene scene = with_method(problem.scene, method);
  setup.solver = scene.solver;
  const std::unique_ptr<World> world = options.make(std::move(setup));
  Player player(scene, *world);
  Observer observer(problem, *world);
  Run run;
  const std::clock_t at_start = std::clock();  // processor time: load by other programs fails no run
  const auto worked = [&] { return static_cast<double>(std::clock() - at_start) / CLOCKS_PER_SEC; };
  double began = now();
  for (const double time : options.times) {
    began = now();
    player.to(time, [&] {
      clock.ticks.push_back(now() - began);
      observer.after_tick();
      began = now();
      return worked() <= options.longest;
    });
    clock.outside_ticks += now() - began;
    run.failed = failure_of(*world, worked(), options.longest);
    if (!run.failed.empty()) break;
    run.at.push_back(world->positions());
  }
  observer.tell(run);
  run.simulated = world->time();
  run.ticks = world->ticks();
  run.steps = world->steps();
  run.iterations = world->solver_stats().iterations;
  return run;
}

/// Vertex of a parabola through three samples.
struct Extreme {
  double t, u;
};
Extreme vertex(const std::vector<double>& t, const std::vector<double>& u, std::size_t k) {
  if (k == 0 || k + 1 >= t.size()) return {t[k], u[k]};
  const double a = t[k - 1] - t[k], b = t[k + 1] - t[k], fa = u[k - 1] - u[k], fb = u[k + 1] - u[k];
  const double divisor = a * b * (a - b);
  if (divisor == 0) return {t[k], u[k]};
  const double curvature = (b * fa - a * fb) / divisor, slope = (a * a * fb - b * b * fa) / divisor;
  if (curvature == 0) return {t[k], u[k]};
  const double at = std::clamp(-slope / (2 * curvature), a, b);
  return {t[k] + at, u[k] + slope * at + curvature * at * at};
}

}  // namespace

std::optional<double> step_doubling_error(const Problem& problem, const Method& method, double until,
                                          const RunOptions& options) {
  WorldSetup setup = problem.setup;
  const Scene scene = with_method(problem.scene, method);
  setup.solver = scene.solver;
  for (const Event& event : scene.events)
    if (static_cast<double>(event.tick) * setup.solver.tick() < until) return std::nullopt;
  StepDoublingEstimator estimator(setup);
  const std::unique_ptr<World> world = options.make(std::move(setup));
  Player player(scene, *world);
  if (!estimator.begin(*world)) return std::nullopt;
  player.to(until, [&] {
    estimator.ticked(*world);
    return true;
  });
  if (world->time() > estimator.elapsed()) estimator.ticked(*world);  // the remainder, shorter than a tick
  const auto error = estimator.error(world->positions());
  return error ? std::optional(error->rms) : std::nullopt;
}

std::optional<FirstMode> first_mode_of(const std::vector<double>& t, const std::vector<double>& u) {
  if (u.size() < 3) return std::nullopt;
  const auto [low, high] = std::minmax_element(u.begin(), u.end());
  const double enough = turn * (*high - *low);
  if (!(enough > 0) || !std::isfinite(enough)) return std::nullopt;
  std::vector<Extreme> turns{{t[0], u[0]}};
  std::size_t farthest = 0;
  double direction = 0;
  for (std::size_t k = 1; k < u.size(); ++k) {
    if (direction == 0) {
      if (std::abs(u[k] - u[0]) >= enough) direction = u[k] > u[0] ? 1 : -1, farthest = k;
    } else if (direction * (u[k] - u[farthest]) >= 0) {
      farthest = k;
    } else if (direction * (u[farthest] - u[k]) >= enough) {
      turns.push_back(vertex(t, u, farthest));
      direction = -direction;
      farthest = k;
    }
  }
  if (turns.size() < 3) return std::nullopt;
  const double half_period = (turns.back().t - turns.front().t) / static_cast<double>(turns.size() - 1);
  const double first = std::abs(turns[1].u - turns[0].u), last = std::abs(turns.back().u - turns[turns.size() - 2].u);
  const double between = half_period * static_cast<double>(turns.size() - 2);
  return FirstMode{1 / (2 * half_period), std::log(first / last) / between};
}

double rms_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const std::vector<double>& mass) {
  double sum = 0, whole = 0;
  for (std::size_t n = 0; n < a.size(); ++n) sum += mass[n] * (a[n] - b[n]).squaredNorm(), whole += mass[n];
  return std::sqrt(sum / whole);
}

Run play(const Problem& problem, const Method& method, const RunOptions& options) {
  Clock clock;
  Run run = play_once(problem, method, options, clock);
  for (int again = 1; again < plays && clock.seconds() < options.repeat_below; ++again) {
    Clock other;
    play_once(problem, method, options, other);
    clock.keep_minimum(other);
  }
  run.seconds = clock.seconds();
  run.median_tick = percentile(clock.ticks, 0.5);
  run.slow_tick = percentile(clock.ticks, 0.99);
  return run;
}

}  // namespace heml
