#pragma once
// Runs a Problem by a Method: positions at set times, computing time, energy, volume and first mode.
//
//    set times      0 ────────┬────────┬────────┬────────┐  t
//    positions               x(t₁)    x(t₂)    x(t₃)    x(t₄)      errors are measured there
//    mean motion    ·  ·  ·  ·  ·  ·  ·  ·  ·  ·  ·  ·  ·  ·       gives frequency and damping
#include <optional>
#include <studies/problem.hpp>

namespace heml {

/// The first mode of vibration, from the mean motion of the body.
struct FirstMode {
  double frequency = 0;  ///< Hz
  double decay = 0;      ///< 1/s, of the amplitude
};

struct Run {
  std::string failed;      ///< why the run did not reach the end; empty: it did
  double simulated = 0;    ///< s, time reached
  double seconds = 0;      ///< s, wall time; of short runs, the minimum over repetitions of each tick, summed
  double median_tick = 0;  ///< s, wall time, likewise
  double slow_tick = 0;    ///< s, 99th percentile, likewise
  long ticks = 0, steps = 0, iterations = 0;
  double min_step = 0;                  ///< s, smallest stable step of explicit methods during the run
  std::vector<std::vector<Vec3>> at;    ///< #times × #V × 3, m, positions
  std::optional<FirstMode> first_mode;  ///< none: no oscillation
  std::optional<double> energy_drift;   ///< relative to the largest kinetic energy; none: not conserved
  double volume = 1;                    ///< at the end, relative to rest
  double min_J = 1;                     ///< at the end
};

struct RunOptions {
  std::vector<double> times;  ///< s, ascending
  double longest = 60;        ///< s of processor time, after which a run fails
  double repeat_below = 0.5;  ///< s: shorter runs are made three times
  MakeWorld make = make_world;
};

Run play(const Problem& problem, const Method& method, const RunOptions& options);

/// m, rms: time error of a method at `until`, estimated by step doubling from the start (world/step_doubling.hpp). None
/// if the estimator cannot follow or an event precedes `until`.
std::optional<double> step_doubling_error(const Problem& problem, const Method& method, double until,
                                          const RunOptions& options);

/// From the turning points of a motion, whose first sample is one; none if fewer than three. t: s; u: m, along one
/// axis.
std::optional<FirstMode> first_mode_of(const std::vector<double>& t, const std::vector<double>& u);

/// √(Σ m |a − b|² / Σ m), m. mass: #V.
double rms_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const std::vector<double>& mass);

}  // namespace heml
