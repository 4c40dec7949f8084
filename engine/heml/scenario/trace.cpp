#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/base/write_file.hpp>
#include <heml/scenario/selection.hpp>
#include <heml/scenario/trace.hpp>
#include <iterator>

namespace heml {
namespace {

void add(std::string& row, double value) { fmt::format_to(std::back_inserter(row), ",{:.17g}", value); }
void add(std::string& row, const Vec3& v) {
  for (const double value : v) add(row, value);
}

}  // namespace

Trace::Trace(const Scene& scene, const World& world) : every_(scene.output_every) {
  for (std::size_t k = 0; k < scene.markers.size(); ++k) {
    const MarkerEntry& entry = scene.markers[k];
    const std::string place = fmt::format("outputs.markers[{}]", k);
    markers_.push_back({entry.name.empty() ? std::to_string(k) : entry.name,
                        select_nodes(entry.where, world.setup().mesh, scene.file, place)});
  }
  if (!markers_.empty()) marker_rows_ = "time,marker,x,y,z,vx,vy,vz\n";
  if (!scene.output_history) return;
  history_rows_ = "time,kinetic,elastic,potential,min_J,max_J,tool_x,tool_y,tool_z";
  boundary_entries_ = scene.boundary.size();
  for (std::size_t k = 0; k < boundary_entries_; ++k)
    for (const char axis : {'x', 'y', 'z'}) history_rows_ += fmt::format(",reaction_{}_{}", k, axis);
  history_rows_ += '\n';
}

void Trace::sample(World& world, double time) {
  if (markers_.empty() && history_rows_.empty()) return;
  if (time == last_ || time < next_ * (1 - 1e-12)) return;
  last_ = time;
  const double passed = std::floor(time / every_ * (1 + 1e-12));
  next_ = std::isfinite(passed) ? every_ * (passed + 1) : time;  // not finite: every tick, or a time so short
  if (!markers_.empty()) sample_markers(world, time);
  if (!history_rows_.empty()) sample_history(world, time);
}

void Trace::sample_markers(const World& world, double time) {
  const std::vector<Vec3> x = world.positions(), v = world.velocities();
  for (const Marker& marker : markers_) {
    Vec3 place = Vec3::Zero(), velocity = Vec3::Zero();
    for (const int n : marker.nodes) {
      place += x[static_cast<std::size_t>(n)];
      velocity += v[static_cast<std::size_t>(n)];
    }
    const double count = static_cast<double>(marker.nodes.size());
    marker_rows_ += fmt::format("{:.17g},{}", time, marker.name);
    add(marker_rows_, place / count);
    add(marker_rows_, velocity / count);
    marker_rows_ += '\n';
  }
}

void Trace::sample_history(World& world, double time) {
  const Energies energies = world.energies();
  const std::vector<double> J = world.point_volume_ratios();
  const auto [least, most] = std::minmax_element(J.begin(), J.end());
  history_rows_ += fmt::format("{:.17g}", time);
  for (const double value : {energies.kinetic, energies.elastic, energies.potential, *least, *most})
    add(history_rows_, value);
  add(history_rows_, force_of<GraspState>(world.tools()));
  std::vector<Vec3> reactions = world.reactions();
  reactions.resize(boundary_entries_, Vec3::Zero());  // an event may have set others
  for (const Vec3& force : reactions) add(history_rows_, force);
  history_rows_ += '\n';
}

void Trace::write(const std::filesystem::path& folder) const {
  if (!marker_rows_.empty()) write_file(folder / markers_file, marker_rows_);
  if (!history_rows_.empty()) write_file(folder / history_file, history_rows_);
}

}  // namespace heml
