#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/world/grasp_frequency.hpp>
#include <heml/world/tool_commands.hpp>

namespace heml {
namespace {
constexpr double min_suture = 1e-4;  // of the body's size: what is drawn in further has no direction
constexpr std::size_t max_places = 10000;
constexpr double grip_reach = 0.25;  // of the body's size: how far a spring of a grasp can be drawn out before it slips

bool finite(const Vec3& v) { return v.allFinite(); }

Status patch_problem(const char* tool, int node, double radius, std::size_t nodes) {
  if (node < 0 || static_cast<std::size_t>(node) >= nodes)
    return fmt::format("{}: node {} does not exist; the body has nodes 0 to {}", tool, node, nodes - 1);
  if (!(radius >= 0) || !std::isfinite(radius))
    return fmt::format("{}: radius must be 0 m or more, is {}", tool, radius);
  return {};
}

Status hand_problem(const char* tool, int hand) {
  if (hand < 0 || hand >= max_hands) return fmt::format("{}: hand must be 0 to {}, is {}", tool, max_hands - 1, hand);
  return {};
}

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

/// The grasp of a hand, or the place in the list where it would be.
template <class Real>
auto ToolCommands<Real>::grasp_of(int hand) {
  return std::lower_bound(s_.grasps.begin(), s_.grasps.end(), hand,
                          [](const GraspSpring<Real>& grasp, int number) { return grasp.id().hand < number; });
}

template <class Real>
Status ToolCommands<Real>::execute(const Grasp& command) {
  if (const Status status = patch_problem("grasp", command.node, command.radius, s_.node_count()); !status.ok())
    return status;
  if (const Status status = hand_problem("grasp", command.hand); !status.ok()) return status;
  const int center = s_.model->order.new_node[static_cast<std::size_t>(command.node)];
  const auto radius = static_cast<Real>(command.radius);
  const auto held = std::find_if(s_.grasps.begin(), s_.grasps.end(), [&](const GraspSpring<Real>& grasp) {
    return grasp.center() == center && grasp.radius() == radius;
  });
  if (held != s_.grasps.end()) {
    GraspSpring<Real> grasp = std::move(*held);
    s_.grasps.erase(held);
    put_into_hand(std::move(grasp), command.hand);
    return {};
  }
  const std::vector<int> surface = surface_with(center, command.hidden);
  const double omega = grasp_frequency(s_, center, command.radius, surface);
  GraspSpring<Real> grasp({command.hand, s_.grasps_taken + 1}, center, radius, surface, s_.model->mesh.nodes,
                          s_.state.x.data(), s_.masses->inverse, static_cast<Real>(omega),
                          grip_reach * s_.model->diagonal);
  if (grasp.empty()) return fmt::format("grasp: node {} is constrained, or belongs to no element", command.node);
  put_into_hand(std::move(grasp), command.hand);
  ++s_.grasps_taken;
  return {};
}

/// What the hand held before it lets go.
template <class Real>
void ToolCommands<Real>::put_into_hand(GraspSpring<Real> grasp, int hand) {
  grasp.hand_over(hand);
  const auto place = grasp_of(hand);
  if (place != s_.grasps.end() && place->id().hand == hand)
    *place = std::move(grasp);
  else
    s_.grasps.insert(place, std::move(grasp));
}

template <class Real>
Status ToolCommands<Real>::execute(const MoveTool& command) {
  if (const Status status = hand_problem("move", command.hand); !status.ok()) return status;
  const auto grasp = grasp_of(command.hand);
  if (grasp == s_.grasps.end() || grasp->id().hand != command.hand)
    return command.hand == 0 ? "move: nothing is grasped" : fmt::format("move: hand {} holds nothing", command.hand);
  if (!finite(command.target)) return "move: the target is not finite";
  grasp->move(command.target);
  return {};
}

template <class Real>
Status ToolCommands<Real>::execute(const Release& command) {
  if (!command.hand) {
    s_.grasps.clear();
    return {};
  }
  if (const Status status = hand_problem("release", *command.hand); !status.ok()) return status;
  std::erase_if(s_.grasps, [&](const GraspSpring<Real>& grasp) { return grasp.id().hand == *command.hand; });
  return {};
}

template <class Real>
Status ToolCommands<Real>::execute(const PinTissue& command) {
  if (!command.nodes.empty()) return pin_nodes(command.nodes);
  if (const Status status = patch_problem("pin", command.node, command.radius, s_.node_count()); !status.ok())
    return status;
  const int center = s_.model->order.new_node[static_cast<std::size_t>(command.node)];
  if (s_.masses->inverse[static_cast<std::size_t>(center)] == 0)
    return fmt::format("pin: node {} is constrained, or belongs to no element", command.node);
  s_.pins.push_back(pin_patch(center, command.radius, surface_with(center, command.hidden), s_.model->mesh.nodes,
                              s_.state.x.data(), s_.masses->inverse));
  update_constraints(s_, recovery_);
  return {};
}

template <class Real>
Status ToolCommands<Real>::execute(const Unpin& command) {
  if (!command.nodes.empty()) return unpin_nodes(command.nodes);
  if (!command.node) {
    s_.pins.clear();
    update_constraints(s_, recovery_);
    return {};
  }
  const auto holds = [&](const PinnedPatch& pin) {
    return std::any_of(pin.nodes.begin(), pin.nodes.end(),
                       [&](int n) { return s_.model->order.file_node[static_cast<std::size_t>(n)] == *command.node; });
  };
  const auto pin = std::find_if(s_.pins.begin(), s_.pins.end(), holds);
  if (pin == s_.pins.end()) return fmt::format("release: no pin holds node {}", *command.node);
  s_.pins.erase(pin);
  update_constraints(s_, recovery_);
  return {};
}

/// Boundary nodes of what is not hidden and one more node, inner numbers, ascending, each once.
template <class Real>
std::vector<int> ToolCommands<Real>::surface_with(int node, const std::vector<int>& hidden) const {
  std::vector<int> nodes = hidden.empty() ? s_.model->surface_nodes : surface_nodes_without(*s_.model, hidden);
  const auto place = std::lower_bound(nodes.begin(), nodes.end(), node);
  if (place == nodes.end() || *place != node) nodes.insert(place, node);
  return nodes;
}

/// The numbers inside of nodes and of mid-edge nodes between them, ascending, each once.
template <class Real>
static Status inner_nodes(const char* tool, std::vector<int> nodes, const Simulation<Real>& s,
                          std::vector<int>& inner) {
  for (const int node : nodes)
    if (const Status status = patch_problem(tool, node, 0, s.node_count()); !status.ok()) return status;
  add_midedges_between(s.setup->mesh, s.setup->midedges, nodes);
  for (const int node : nodes) inner.push_back(s.model->order.new_node[static_cast<std::size_t>(node)]);
  std::sort(inner.begin(), inner.end());
  inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
  return {};
}

/// One pin, of those that are free.
template <class Real>
Status ToolCommands<Real>::pin_nodes(const std::vector<int>& nodes) {
  std::vector<int> inner;
  if (const Status status = inner_nodes("pin", nodes, s_, inner); !status.ok()) return status;
  PinnedPatch pin = pin_list(inner, s_.state.x.data(), s_.masses->inverse);
  if (pin.nodes.empty())
    return fmt::format("pin: the {} nodes are all constrained, or belong to no element", inner.size());
  s_.pins.push_back(std::move(pin));
  update_constraints(s_, recovery_);
  return {};
}

/// Pins keep their other nodes; those without go.
template <class Real>
Status ToolCommands<Real>::unpin_nodes(const std::vector<int>& nodes) {
  std::vector<int> inner;
  if (const Status status = inner_nodes("release", nodes, s_, inner); !status.ok()) return status;
  bool any = false;
  for (PinnedPatch& pin : s_.pins) any |= take_nodes(pin, inner);
  if (!any) return fmt::format("release: no pin holds any of the {} nodes", inner.size());
  std::erase_if(s_.pins, [](const PinnedPatch& pin) { return pin.nodes.empty(); });
  update_constraints(s_, recovery_);
  return {};
}

template <class Real>
Status ToolCommands<Real>::execute(const SetTables& command) {
  for (const Table& table : command.tables)
    if (const Status status = table_problem(table); !status.ok()) return status;
  s_.setup.write().tables = command.tables;
  s_.place_tables();
  return {};
}

template <class Real>
Status ToolCommands<Real>::execute(const MoveProbe& command) {
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
Status ToolCommands<Real>::execute(const WithdrawProbe&) {
  s_.contacts.probe.reset();
  s_.update_contact_surfaces();
  return {};
}

template <class Real>
Status ToolCommands<Real>::execute(const SutureTissue& command) {
  Suture suture{};
  for (std::size_t end = 0; end < 2; ++end) {
    const int node = command.nodes[end];
    if (node < 0 || static_cast<std::size_t>(node) >= s_.node_count())
      return fmt::format("suture: node {} does not exist; the body has nodes 0 to {}", node, s_.node_count() - 1);
    suture.nodes[end] = s_.model->order.new_node[static_cast<std::size_t>(node)];
    if (s_.masses->lumped[static_cast<std::size_t>(suture.nodes[end])] == 0)
      return fmt::format("suture: node {} belongs to no element", node);
  }
  const auto [a, b] = suture.nodes;
  if (a == b) return fmt::format("suture: both ends are node {}", command.nodes[0]);
  if (s_.masses->inverse[static_cast<std::size_t>(a)] == 0 && s_.masses->inverse[static_cast<std::size_t>(b)] == 0)
    return "suture: both nodes are constrained";
  if (!(command.length >= 0) || !std::isfinite(command.length))
    return fmt::format("suture: length must be 0 m or more, is {}", command.length);
  if (!(command.ramp_time >= 0) || !std::isfinite(command.ramp_time))
    return fmt::format("suture: over must be 0 s or more, is {}", command.ramp_time);
  const auto at = [&](int n) {
    return Vec3(Eigen::Map<const Vector3<Real>>(&s_.state.x[3 * static_cast<std::size_t>(n)]).template cast<double>());
  };
  suture.from = std::max((at(a) - at(b)).norm(), min_suture * s_.model->diagonal);
  suture.to = std::max(command.length, min_suture * s_.model->diagonal);
  suture.start = s_.state.time;
  suture.ramp_time = command.ramp_time;
  s_.contacts.sutures.push_back(suture);
  s_.update_contact_surfaces();
  return {};
}

template <class Real>
Status ToolCommands<Real>::execute(const CutSutures&) {
  s_.contacts.sutures.clear();
  s_.update_contact_surfaces();
  return {};
}

template <class Real>
void update_constraints(Simulation<Real>& s, RecoveryController<Real>& recovery) {
  s.update_masses();
  s.update_contact_boundary();
  s.move_constrained();
  s.implicit.reset();
  s.lowest_frequency.reset();
  recovery.follow_change();
}

template class ToolCommands<float>;
template class ToolCommands<double>;
template void update_constraints(Simulation<float>&, RecoveryController<float>&);
template void update_constraints(Simulation<double>&, RecoveryController<double>&);

}  // namespace heml
