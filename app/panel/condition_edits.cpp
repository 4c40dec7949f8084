#include <algorithm>
#include <app/panel/condition_edits.hpp>
#include <iterator>

namespace heml::panel {
namespace {

bool is_among(int node, const std::vector<int>& nodes) { return std::binary_search(nodes.begin(), nodes.end(), node); }

bool is_fix_of(const Boundary& entry, const AxisSet& axes) {
  return entry.translate.isZero(0) && entry.origin.isZero(0) && entry.degrees == 0 && entry.axes == axes;
}

/// Takes nodes from all entries. A force is as large on each node that is left as it was.
template <class Entry>
bool take_from(std::vector<Entry>& entries, const std::vector<int>& nodes) {
  bool any = false;
  for (Entry& entry : entries) {
    const std::size_t before = entry.nodes.size();
    std::erase_if(entry.nodes, [&](int node) { return is_among(node, nodes); });
    if (entry.nodes.size() == before) continue;
    any = true;
    if constexpr (std::is_same_v<Entry, Load>)
      if (entry.kind == Load::Kind::force)
        entry.vector *= static_cast<double>(entry.nodes.size()) / static_cast<double>(before);
  }
  std::erase_if(entries, [](const Entry& entry) { return entry.nodes.empty(); });
  return any;
}

}  // namespace

SetBoundary fixed(const Conditions& conditions, const std::vector<int>& nodes, const AxisSet& axes) {
  SetBoundary set{conditions.boundary};
  if (set.entries.empty() || !is_fix_of(set.entries.back(), axes)) set.entries.emplace_back().axes = axes;
  std::vector<int> all;  // of several entries on a coordinate the last holds
  std::vector<int> before = set.entries.back().nodes;
  std::sort(before.begin(), before.end());
  std::set_union(before.begin(), before.end(), nodes.begin(), nodes.end(), std::back_inserter(all));
  set.entries.back().nodes = std::move(all);
  return set;
}

std::optional<SetBoundary> freed(const Conditions& conditions, const std::vector<int>& nodes) {
  SetBoundary set{conditions.boundary};
  return take_from(set.entries, nodes) ? std::optional(std::move(set)) : std::nullopt;
}

SetLoads loaded(const Conditions& conditions, const std::vector<int>& nodes, const Vec3& force) {
  SetLoads set{conditions.loads};
  const auto is_same = [&](const Load& load) { return load.kind == Load::Kind::force && load.nodes == nodes; };
  std::erase_if(set.entries, is_same);
  Load load;
  load.nodes = nodes;
  load.vector = force;
  set.entries.push_back(std::move(load));
  return set;
}

std::optional<SetLoads> unloaded(const Conditions& conditions, const std::vector<int>& nodes) {
  SetLoads set{conditions.loads};
  return take_from(set.entries, nodes) ? std::optional(std::move(set)) : std::nullopt;
}

template <class Entry>
std::size_t count_in(const std::vector<Entry>& entries, const std::vector<int>& nodes) {
  return static_cast<std::size_t>(std::count_if(nodes.begin(), nodes.end(), [&](int node) {
    return std::any_of(entries.begin(), entries.end(), [&](const Entry& entry) {
      return std::find(entry.nodes.begin(), entry.nodes.end(), node) != entry.nodes.end();
    });
  }));
}

template std::size_t count_in(const std::vector<Boundary>&, const std::vector<int>&);
template std::size_t count_in(const std::vector<Load>&, const std::vector<int>&);

}  // namespace heml::panel
