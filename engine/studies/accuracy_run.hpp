#pragma once
// A specimen's motion computed by a method: where its nodes are at set times, what it cost, and how it went.
//
//    set times      0 ────────┬────────┬────────┬────────┐  t
//    positions               x(t₁)    x(t₂)    x(t₃)    x(t₄)      errors are taken there
//    mean motion    ·  ·  ·  ·  ·  ·  ·  ·  ·  ·  ·  ·  ·  ·       frequency and damping are read off it
#include <optional>
#include <studies/problem.hpp>

namespace heml {

/// Of the first mode, as the mean motion of the body shows it.
struct FirstMode {
  double frequency = 0;  ///< Hz
  double decay = 0;      ///< 1/s, of the amplitude
};

struct Run {
  std::string failed;      ///< why it did not reach the end; empty: it did
  double simulated = 0;    ///< s, how far it came
  double seconds = 0;      ///< of computing; where it is short, with the least of a few plays for each tick
  double median_tick = 0;  ///< s of computing, likewise
  double slow_tick = 0;    ///< s, 99th percentile, likewise
  long ticks = 0, steps = 0, iterations = 0;
  double min_step = 0;                  ///< s, least stable step of explicit methods on the way
  std::vector<std::vector<Vec3>> at;    ///< #times × #V × 3, m
  std::optional<FirstMode> first_mode;  ///< none: it does not swing to and fro
  std::optional<double> energy_drift;   ///< of what it should keep, relative to its largest kinetic energy
  double volume = 1;                    ///< at the end, relative to rest
  double min_J = 1;                     ///< at the end
};

struct RunOptions {
  std::vector<double> times;  ///< s, ascending
  double longest = 60;        ///< s of computing, after which it counts as failed
  double repeat_below = 0.5;  ///< s: shorter ones are played three times
  MakeWorld make = make_world;
};

Run play(const Problem& problem, const Method& method, const RunOptions& options);

/// m, rms: what a shadow (world/step_doubling.hpp) says of a method's error at a time, from the start on; none where it
/// cannot follow or something happens meanwhile.
std::optional<double> step_doubling_error(const Problem& problem, const Method& method, double until,
                                          const RunOptions& options);

/// From the turning points of a motion that starts at one; none: fewer than three. t: s; u: along its axis.
std::optional<FirstMode> first_mode_of(const std::vector<double>& t, const std::vector<double>& u);

/// √(Σ m |a − b|² / Σ m), m. mass: #V.
double rms_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const std::vector<double>& mass);

}  // namespace heml
