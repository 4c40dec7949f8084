// Tables, the probe and sutures.
#include <fmt/format.h>

#include <cmath>
#include <heml/world/command_executor.hpp>

namespace heml {
namespace {

constexpr double min_suture = 1e-4;  // of the body's size: what is drawn in further has no direction
constexpr std::size_t max_places = 10000;

Status table_problem(const Table& table) {
  if (!table.point.allFinite() || !table.normal.allFinite()) return "table: point and normal must be finite";
  if (!(table.normal.norm() > 0)) return "table: the normal must not be zero";
  if (!(table.friction >= 0) || !std::isfinite(table.friction))
    return fmt::format("table: friction must be 0 or more, is {}", table.friction);
  return {};
}

Status probe_problem(const MoveProbe& probe) {
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
  return {};
}

}  // namespace

template <class Real>
Status CommandExecutor<Real>::execute(const SetTables& command) {
  for (const Table& table : command.tables)
    if (const Status status = table_problem(table); !status.ok()) return status;
  s_.setup.tables = command.tables;
  s_.contacts.tables = command.tables;
  for (Table& table : s_.contacts.tables) table.normal.normalize();
  s_.update_contact_surfaces();
  return {};
}

template <class Real>
Status CommandExecutor<Real>::execute(const MoveProbe& command) {
  if (const Status status = probe_problem(command); !status.ok()) return status;
  Probe probe(command.radius, command.shaft, command.friction);
  const bool is_new = !s_.contacts.probe;
  if (!is_new) probe.go({s_.contacts.probe->tip(s_.state.time)}, command.speed, s_.state.time);
  probe.go(command.path, command.speed, s_.state.time);
  s_.contacts.probe = std::move(probe);
  if (is_new) s_.update_contact_surfaces();
  return {};
}

template <class Real>
Status CommandExecutor<Real>::execute(const WithdrawProbe&) {
  s_.contacts.probe.reset();
  s_.update_contact_surfaces();
  return {};
}

template <class Real>
Status CommandExecutor<Real>::execute(const SutureTissue& command) {
  Suture suture{};
  for (std::size_t end = 0; end < 2; ++end) {
    const int node = command.nodes[end];
    if (node < 0 || static_cast<std::size_t>(node) >= s_.mass.size())
      return fmt::format("suture: node {} does not exist; the body has nodes 0 to {}", node, s_.mass.size() - 1);
    suture.nodes[end] = s_.model.order.new_node[static_cast<std::size_t>(node)];
    if (s_.mass[static_cast<std::size_t>(suture.nodes[end])] == 0)
      return fmt::format("suture: node {} belongs to no element", node);
  }
  const auto [a, b] = suture.nodes;
  if (a == b) return fmt::format("suture: both ends are node {}", command.nodes[0]);
  if (s_.inverse_mass[static_cast<std::size_t>(a)] == 0 && s_.inverse_mass[static_cast<std::size_t>(b)] == 0)
    return "suture: both nodes are constrained";
  if (!(command.length >= 0) || !std::isfinite(command.length))
    return fmt::format("suture: length must be 0 m or more, is {}", command.length);
  if (!(command.ramp_time >= 0) || !std::isfinite(command.ramp_time))
    return fmt::format("suture: over must be 0 s or more, is {}", command.ramp_time);
  const auto at = [&](int n) {
    return Vec3(Eigen::Map<const Vector3<Real>>(&s_.state.x[3 * static_cast<std::size_t>(n)]).template cast<double>());
  };
  suture.from = std::max((at(a) - at(b)).norm(), min_suture * s_.model.diagonal);
  suture.to = std::max(command.length, min_suture * s_.model.diagonal);
  suture.start = s_.state.time;
  suture.ramp_time = command.ramp_time;
  s_.contacts.sutures.push_back(suture);
  s_.update_contact_surfaces();
  return {};
}

template <class Real>
Status CommandExecutor<Real>::execute(const CutSutures&) {
  s_.contacts.sutures.clear();
  s_.update_contact_surfaces();
  return {};
}

template class CommandExecutor<float>;
template class CommandExecutor<double>;

}  // namespace heml
