#include <fmt/format.h>

#include <algorithm>
#include <app/panel/measure.hpp>
#include <cmath>
#include <heml/world/field_list.hpp>
#include <numbers>

namespace heml::panel {
namespace {

constexpr std::size_t max_kept = 200000;  // frames; then every other is dropped

double length_between(const Vec3f& a, const Vec3f& b) { return (b - a).cast<double>().norm(); }

double angle_at(const Vec3f& a, const Vec3f& middle, const Vec3f& b) {
  const Vec3 u = (a - middle).cast<double>(), v = (b - middle).cast<double>();
  if (u.norm() == 0 || v.norm() == 0) return not_measured;
  return std::atan2(u.cross(v).norm(), u.dot(v)) * 180 / std::numbers::pi;
}

double value_at_point(const render::SurfacePoint& point, const Frame& frame) {
  if (frame.field == Field::none || frame.values.size() != frame.positions.size()) return not_measured;
  double value = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto index = render::surface_index(point.nodes[k], *frame.surface_mesh);
    if (!index) return not_measured;
    value += static_cast<double>(point.weights[k]) * static_cast<double>(frame.values[*index]);
  }
  return value;
}

/// Whether the tissue of a point is on the surface. rest: m, of the point at rest, found when it is asked for first:
/// nodes of a wound whose cut was undone, and their numbers, may come back elsewhere.
bool is_where_it_was(const render::SurfacePoint& point, const SurfaceMesh& surface_mesh, std::optional<Vec3f>& rest) {
  if (!render::is_on(point, surface_mesh)) return false;
  std::array<Vec3f, 3> corners;
  for (std::size_t k = 0; k < 3; ++k)
    corners[k] = surface_mesh.rest[*render::surface_index(point.nodes[k], surface_mesh)];
  const Vec3f now = point.among(corners);
  if (!rest) rest = now;
  return (now - *rest).norm() <= 1e-5f * (corners[1] - corners[0]).norm() + 1e-6f * now.norm();
}

std::string cell(double number) { return std::isfinite(number) ? fmt::format("{:.9g}", number) : ""; }

}  // namespace

void Measure::add(const render::SurfacePoint& point) {
  if (points_.size() == max_points) clear();
  points_.push_back(point);
  kept_.clear();
  kept_tick_ = -1;
}

void Measure::clear() {
  points_.clear();
  rests_.clear();
  kept_.clear();
  kept_tick_ = -1;
  now_ = {};
}

void Measure::update(const Frame& frame) {
  if (points_.empty() || !frame.surface_mesh) return;
  now_ = {};
  now_.time = frame.time;
  now_.field = frame.field;
  rests_.resize(points_.size());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const bool is_there = is_where_it_was(points_[k], *frame.surface_mesh, rests_[k]);
    const auto corners = is_there ? render::corners_of(points_[k], frame, *frame.surface_mesh) : std::nullopt;
    now_.places.push_back(corners ? points_[k].among(*corners) : Vec3f::Constant(std::nanf("")));
  }
  if (now_.places.back().allFinite()) now_.value = value_at_point(points_.back(), frame);
  if (points_.size() > 1) now_.distance = length_between(now_.places[0], now_.places[1]);
  if (points_.size() > 2) {
    now_.second = length_between(now_.places[1], now_.places[2]);
    now_.angle = angle_at(now_.places[0], now_.places[1], now_.places[2]);
  }
  if (const auto size = piece_.size_of(points_.back().nodes[0], frame)) {
    now_.area = size->area;
    now_.volume = size->volume;
  }
  keep(frame.tick);
}

/// A reset (less time at a later tick) begins anew; a frame of the past is not kept; the last one may come again, with
/// its solid.
void Measure::keep(long tick) {
  if (tick == kept_tick_ && !kept_.empty()) kept_.back() = now_;
  if (tick <= kept_tick_) return;
  kept_tick_ = tick;
  if (!kept_.empty() && now_.time < kept_.back().time) kept_.clear();
  if (kept_.size() == max_kept) {
    for (std::size_t k = 0; 2 * k < kept_.size(); ++k) kept_[k] = std::move(kept_[2 * k]);
    kept_.resize(max_kept / 2);
  }
  kept_.push_back(now_);
}

std::string Measure::csv() const {
  std::string text = "time_s";
  for (std::size_t k = 1; k <= points_.size(); ++k) text += fmt::format(",x{0}_m,y{0}_m,z{0}_m", k);
  text += ",distance_1_2_m,distance_2_3_m,angle_deg,field,value,piece_area_m2,piece_volume_m3\n";
  for (const Measured& row : kept_) {
    text += fmt::format("{:.9g}", row.time);
    for (const Vec3f& place : row.places)
      for (int k = 0; k < 3; ++k) text += ',' + cell(static_cast<double>(place[k]));
    for (const double number : {row.distance, row.second, row.angle}) text += ',' + cell(number);
    text += fmt::format(",{},{},{},{}\n", info(row.field).name, cell(row.value), cell(row.area), cell(row.volume));
  }
  return text;
}

}  // namespace heml::panel
