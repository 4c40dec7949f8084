#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/world/conditions.hpp>
#include <utility>

namespace heml {
namespace {

constexpr double round_off = 1e-12;  // of the part of a force that a node bears

/// nodes: of the body, how many.
Status nodes_problem(const char* what, const std::vector<int>& chosen, std::size_t nodes) {
  if (chosen.empty()) return fmt::format("{}: an entry names no node", what);
  for (const int node : chosen)
    if (node < 0 || static_cast<std::size_t>(node) >= nodes)
      return fmt::format("{}: node {} does not exist; the body has nodes 0 to {}", what, node, nodes - 1);
  return {};
}

Status ramp_problem(const char* what, double ramp_time) {
  if (!(ramp_time >= 0) || !std::isfinite(ramp_time))
    return fmt::format("{}: over must be 0 s or more, is {}", what, ramp_time);
  return {};
}

Status problem_of(const Boundary& entry, std::size_t nodes) {
  if (const Status status = nodes_problem("boundary", entry.nodes, nodes); !status.ok()) return status;
  if (!entry.translate.allFinite() || !entry.axis.allFinite() || !entry.origin.allFinite() ||
      !std::isfinite(entry.degrees))
    return "boundary: translation and rotation must be finite";
  if (!(entry.axis.norm() > 0)) return "boundary: the axis must not be zero";
  return ramp_problem("boundary", entry.ramp_time);
}

Status problem_of(const Load& entry, std::size_t nodes) {
  if (const Status status = nodes_problem("loads", entry.nodes, nodes); !status.ok()) return status;
  if (!entry.vector.allFinite() || !std::isfinite(entry.pressure)) return "loads: a load is not finite";
  return ramp_problem("loads", entry.ramp_time);
}

/// Whether an entry is as large, on each of its nodes or faces, as one that is present, with the same ramp.
bool is_as_large(const Boundary& entry, const Boundary& present) {
  Boundary same = present;
  same.nodes = entry.nodes;
  same.ramp_start = entry.ramp_start;
  return entry == same;
}

bool is_as_large(const Load& entry, const Load& present) {
  if (entry.kind != present.kind || entry.ramp_time != present.ramp_time) return false;
  if (entry.kind != Load::Kind::force) return entry.vector == present.vector && entry.pressure == present.pressure;
  const Vec3 before = present.vector / static_cast<double>(present.nodes.size());
  return (entry.vector / static_cast<double>(entry.nodes.size()) - before).norm() <= round_off * before.norm();
}

bool are_among(std::vector<int> nodes, std::vector<int> others) {
  std::sort(nodes.begin(), nodes.end());
  std::sort(others.begin(), others.end());
  return std::includes(others.begin(), others.end(), nodes.begin(), nodes.end());
}

/// Of each entry, the one present that it goes on with; null: it is new.
template <class Entry>
std::vector<const Entry*> predecessors(const std::vector<Entry>& entries, const std::vector<Entry>& present) {
  std::vector<bool> has_successor(present.size(), false);
  std::vector<const Entry*> result;
  for (const Entry& entry : entries) {
    std::size_t k = 0;
    while (k < present.size() &&
           (has_successor[k] || !is_as_large(entry, present[k]) || !are_among(entry.nodes, present[k].nodes)))
      ++k;
    result.push_back(k < present.size() ? &present[k] : nullptr);
    if (k < present.size()) has_successor[k] = true;
  }
  return result;
}

/// A traction or pressure that is new has a face to act on; faces of one that goes on may have been removed since.
template <class Real>
Status face_problem(std::size_t k, const Load& load, const Model<Real>& model) {
  if (load.kind == Load::Kind::force || holds_face(load.nodes, model)) return {};
  return fmt::format("loads[{}]: its {} nodes hold no face of the surface (select all three nodes of at least one)", k,
                     load.nodes.size());
}

template <class Real>
Status face_problem(std::size_t, const Boundary&, const Model<Real>&) {
  return {};
}

/// Checks the entries of a command and completes them: mid-edge nodes, and when ramps start.
template <class Real, class Entry>
Status complete(const Simulation<Real>& s, const std::vector<Entry>& present, std::vector<Entry>& entries) {
  for (Entry& entry : entries) {
    if (const Status status = problem_of(entry, s.node_count()); !status.ok()) return status;
    add_midedges_between(s.setup->mesh, s.setup->midedges, entry.nodes);
  }
  const std::vector<const Entry*> before = predecessors(entries, present);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    entries[k].ramp_start = before[k] ? before[k]->ramp_start : s.state.time;
    if (before[k]) continue;
    if (const Status status = face_problem(k, entries[k], *s.model); !status.ok()) return status;
  }
  return {};
}

}  // namespace

template <class Real>
Status replace_boundary(Simulation<Real>& s, std::vector<Boundary> entries) {
  if (const Status status = complete(s, s.setup->boundary, entries); !status.ok()) return status;
  s.setup.write().boundary = std::move(entries);
  set_boundary(*s.setup, s.model.write());
  ++s.condition_changes;
  return {};
}

template <class Real>
Status replace_loads(Simulation<Real>& s, std::vector<Load> entries) {
  if (const Status status = complete(s, s.setup->loads, entries); !status.ok()) return status;
  s.setup.write().loads = std::move(entries);
  set_loads(*s.setup, s.model.write());
  ++s.condition_changes;
  s.implicit.reset();
  return {};
}

template <class Real>
void restart_ramps(Simulation<Real>& s) {
  const auto is_late = [](const auto& entry) { return entry.ramp_start != 0; };
  if (std::ranges::any_of(s.setup->boundary, is_late)) {
    for (Boundary& entry : s.setup.write().boundary) entry.ramp_start = 0;
    set_boundary(*s.setup, s.model.write());
  }
  if (std::ranges::any_of(s.setup->loads, is_late)) {
    for (Load& entry : s.setup.write().loads) entry.ramp_start = 0;
    set_loads(*s.setup, s.model.write());
  }
}

template Status replace_boundary(Simulation<float>&, std::vector<Boundary>);
template Status replace_boundary(Simulation<double>&, std::vector<Boundary>);
template Status replace_loads(Simulation<float>&, std::vector<Load>);
template Status replace_loads(Simulation<double>&, std::vector<Load>);
template void restart_ramps(Simulation<float>&);
template void restart_ramps(Simulation<double>&);

}  // namespace heml
