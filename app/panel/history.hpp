#pragma once
// The last seconds of what is plotted.
#include <deque>
#include <heml/session/frame.hpp>

namespace heml::panel {

/// One frame's numbers.
struct Reading {
  double time = 0;                         ///< s, simulated
  Energies energies;                       ///< J
  double force = 0;                        ///< N, of the grasp
  double pins = 0, tables = 0, probe = 0;  ///< N, of all pins and all tables together, and of the probe
  double sutures = 0;                      ///< N, of the tightest
  double typical_tick = 0, slow_tick = 0;  ///< s of computing a tick: median and 99th percentile
  double min_J = 1, max_J = 1;
  double volume = 1;                      ///< of the whole body, of that at rest
  double slowdown = 1;                    ///< wall seconds a simulated second
  double mesh_error = 0, time_error = 0;  ///< %, mm; not a number while they are not known
  double total() const { return energies.kinetic + energies.elastic + energies.potential; }
};

/// Readings against simulated time, evenly spaced at least `span`/240 apart. A step back in time (a reset) starts
/// afresh; a frame of an earlier tick changes nothing.
class History {
 public:
  static constexpr double span = 8;  ///< s

  void add(const Frame& frame);
  const std::deque<Reading>& readings() const { return readings_; }  ///< ascending in time

 private:
  std::deque<Reading> readings_;
  long latest_tick_ = 0;
};

}  // namespace heml::panel
