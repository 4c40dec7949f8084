#include <algorithm>
#include <app/panel/history.hpp>
#include <app/panel/volume.hpp>
#include <heml/world/command.hpp>
#include <limits>

namespace heml::panel {

std::optional<double> force_of_hands(const std::vector<ToolState>& tools) {
  std::optional<double> largest;
  for (const GraspState& grasp : tools_of<GraspState>(tools))
    if (is_persons_hand(grasp.hand)) largest = std::max(largest.value_or(0), grasp.force.norm());
  return largest;
}

void History::add(const Frame& frame, const Measured& measured) {
  constexpr double spacing = span / 240;
  if (frame.tick < latest_tick_) return;  // the timeline shows the past
  latest_tick_ = frame.tick;
  if (!readings_.empty() && frame.time < readings_.back().time) readings_.clear();
  if (!readings_.empty() && frame.time < readings_.back().time + spacing) return;
  Reading reading;
  reading.time = frame.time;
  reading.energies = frame.energies;
  reading.force = force_of_hands(frame.tools).value_or(0);
  reading.pins = force_of<PinState>(frame.tools).norm();
  reading.tables = force_of<TableState>(frame.tools).norm();
  reading.probe = force_of<ProbeState>(frame.tools).norm();
  for (const SutureState& suture : tools_of<SutureState>(frame.tools))
    reading.sutures = std::max(reading.sutures, suture.force.norm());
  reading.typical_tick = frame.pace.p50;
  reading.slow_tick = frame.pace.p99;
  reading.min_J = frame.min_J;
  reading.max_J = frame.max_J;
  if (frame.surface_mesh)
    reading.volume = enclosed_volume(*frame.surface_mesh, frame.positions) / enclosed_volume(*frame.surface_mesh);
  reading.slowdown = frame.pace.slowdown;
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  reading.mesh_error = frame.mesh_error ? 100 * *frame.mesh_error : unknown;
  reading.time_error = frame.time_error ? 1e3 * frame.time_error->rms : unknown;
  reading.measured = measured;
  reading.measured.places.clear();
  readings_.push_back(reading);
  while (readings_.front().time < frame.time - span) readings_.pop_front();
}

}  // namespace heml::panel
