// Tables, the probe and sutures: commands, and what a world keeps for them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/mesh/surface.hpp>
#include <heml/world/typed_world.hpp>

namespace heml {
namespace {

constexpr double min_suture = 1e-4;  // of the body's size: what is drawn in further has no direction
constexpr std::size_t max_places = 10000;

std::optional<std::string> table_problem(const Table& table) {
  if (!table.point.allFinite() || !table.normal.allFinite()) return "table: point and normal must be finite";
  if (!(table.normal.norm() > 0)) return "table: the normal must not be zero";
  if (!(table.friction >= 0) || !std::isfinite(table.friction))
    return fmt::format("table: friction must be 0 or more, is {}", table.friction);
  return std::nullopt;
}

std::optional<std::string> probe_problem(const MoveProbe& probe) {
  if (!(probe.radius > 0) || !std::isfinite(probe.radius))
    return fmt::format("probe: radius must be more than 0 m, is {}", probe.radius);
  if (!probe.shaft.allFinite()) return "probe: the shaft is not finite";
  if (!(probe.friction >= 0) || !std::isfinite(probe.friction))
    return fmt::format("probe: friction must be 0 or more, is {}", probe.friction);
  if (!(probe.speed > 0) || !std::isfinite(probe.speed))
    return fmt::format("probe: speed must be more than 0 m/s, is {}", probe.speed);
  if (probe.path.empty() || probe.path.size() > max_places)
    return fmt::format("probe: the path must have 1 to {} places, has {}", max_places, probe.path.size());
  for (const Vec3& place : probe.path)
    if (!place.allFinite()) return "probe: a place of the path is not finite";
  return std::nullopt;
}

}  // namespace

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const SetTables& command) {
  for (const Table& table : command.tables)
    if (auto problem = table_problem(table)) return problem;
  setup_.tables = command.tables;
  contacts_.tables = command.tables;
  for (Table& table : contacts_.tables) table.normal.normalize();
  update_contact_surfaces();
  return std::nullopt;
}

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const MoveProbe& command) {
  if (auto problem = probe_problem(command)) return problem;
  Probe probe(command.radius, command.shaft, command.friction);
  const bool is_new = !contacts_.probe;
  if (!is_new) probe.go({contacts_.probe->tip(state_.time)}, command.speed, state_.time);
  probe.go(command.path, command.speed, state_.time);
  contacts_.probe = std::move(probe);
  if (is_new) update_contact_surfaces();
  return std::nullopt;
}

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const WithdrawProbe&) {
  contacts_.probe.reset();
  update_contact_surfaces();
  return std::nullopt;
}

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const SutureTissue& command) {
  Suture suture{};
  for (std::size_t end = 0; end < 2; ++end) {
    const int node = command.nodes[end];
    if (node < 0 || static_cast<std::size_t>(node) >= mass_.size())
      return fmt::format("suture: node {} does not exist; the body has nodes 0 to {}", node, mass_.size() - 1);
    suture.nodes[end] = model_.order.new_node[static_cast<std::size_t>(node)];
    if (mass_[static_cast<std::size_t>(suture.nodes[end])] == 0)
      return fmt::format("suture: node {} belongs to no element", node);
  }
  const auto [a, b] = suture.nodes;
  if (a == b) return fmt::format("suture: both ends are node {}", command.nodes[0]);
  if (inverse_mass_[static_cast<std::size_t>(a)] == 0 && inverse_mass_[static_cast<std::size_t>(b)] == 0)
    return "suture: both nodes are constrained";
  if (!(command.length >= 0) || !std::isfinite(command.length))
    return fmt::format("suture: length must be 0 m or more, is {}", command.length);
  if (!(command.ramp_time >= 0) || !std::isfinite(command.ramp_time))
    return fmt::format("suture: over must be 0 s or more, is {}", command.ramp_time);
  const auto at = [&](int n) {
    return Vec3(Eigen::Map<const Vector3<Real>>(&state_.x[3 * static_cast<std::size_t>(n)]).template cast<double>());
  };
  suture.from = std::max((at(a) - at(b)).norm(), min_suture * model_.diagonal);
  suture.to = std::max(command.length, min_suture * model_.diagonal);
  suture.start = state_.time;
  suture.ramp_time = command.ramp_time;
  contacts_.sutures.push_back(suture);
  update_contact_surfaces();
  return std::nullopt;
}

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const CutSutures&) {
  contacts_.sutures.clear();
  update_contact_surfaces();
  return std::nullopt;
}

/// There are other surfaces, or the body has another skin.
template <class Real>
void TypedWorld<Real>::update_contact_surfaces() {
  update_contact_boundary();
  contacts_.reports.assign(contacts_.surfaces(state_.time).size(), {});
  impulses_.begin_tick();
  if (implicit_) implicit_->body.reset_contact();
  if (recovering()) recovery_->surrogate->parts.body.reset_contact();
}

/// The body has other elements, or begins anew.
template <class Real>
void TypedWorld<Real>::update_self_contact() {
  if (setup_.self_contact) contacts_.tissue.emplace(*setup_.self_contact, model_.mesh);
}

/// The nodes of the surface that are free, and its faces where something may be smaller than they are.
template <class Real>
void TypedWorld<Real>::update_contact_boundary() {
  contacts_.boundary = {};
  if (contacts_.tables.empty() && !contacts_.probe) return;
  for (const int n : model_.surface_nodes)
    if (inverse_mass_[static_cast<std::size_t>(n)] > 0) contacts_.boundary.nodes.push_back(n);
  if (contacts_.probe) contacts_.boundary.faces = extract_boundary(model_.mesh).triangles;
}

/// Those that the scene holds, and pins.
template <class Real>
std::vector<ConstrainedNode> TypedWorld<Real>::constrained_nodes() const {
  std::vector<ConstrainedNode> constrained = model_.constrained;
  for (const PinnedPatch& pin : pins_)
    for (const int n : pin.nodes) constrained.push_back({n, -1});
  return constrained;
}

template class TypedWorld<float>;
template class TypedWorld<double>;

}  // namespace heml
