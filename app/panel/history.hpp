#pragma once
// The plotted values of the last seconds.
#include <app/panel/measure.hpp>
#include <deque>
#include <heml/session/frame.hpp>
#include <optional>
#include <vector>

namespace heml::panel {

/// Values of one frame.
struct Reading {
  double time = 0;                         ///< s, simulated
  Energies energies;                       ///< J
  double force = 0;                        ///< N, force_of_hands()
  double pins = 0, tables = 0, probe = 0;  ///< N: sum over all pins, over all tables; probe
  double sutures = 0;                      ///< N, of the tightest suture
  double typical_tick = 0, slow_tick = 0;  ///< s of computing per tick: median and 99th percentile
  double min_J = 1, max_J = 1;
  double volume = 1;                      ///< of the whole body, relative to rest
  double slowdown = 1;                    ///< wall seconds per simulated second
  double mesh_error = 0, time_error = 0;  ///< %, mm; NaN while not known
  Measured measured;                      ///< without its places
  double total() const { return energies.kinetic + energies.elastic + energies.potential; }
};

/// N, the largest force of a person's hands on the tissue; none: they hold nothing.
std::optional<double> force_of_hands(const std::vector<ToolState>& tools);

/// Readings over simulated time, at least `span`/240 apart. A reset (less time at a later tick) clears them; a frame of
/// an earlier tick (the timeline shows the past) is ignored.
class History {
 public:
  static constexpr double span = 8;  ///< s

  void add(const Frame& frame, const Measured& measured = {});
  const std::deque<Reading>& readings() const { return readings_; }  ///< ascending in time

 private:
  std::deque<Reading> readings_;
  long latest_tick_ = 0;
};

}  // namespace heml::panel
