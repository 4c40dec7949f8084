#include <fmt/format.h>

#include <algorithm>
#include <heml/mesh/region_tag.hpp>
#include <limits>

namespace heml {
namespace {

/// The elements all of whose corners are chosen.
Status elements_of_nodes(const std::vector<int>& nodes, const TetMesh& mesh, const Topology& topology,
                         std::vector<int>& tets) {
  std::vector<bool> is_chosen(mesh.nodes.size(), false);
  for (const int n : nodes) {
    if (n < 0 || static_cast<std::size_t>(n) >= mesh.nodes.size())
      return fmt::format("node {} does not exist; the body has nodes 0 to {}", n, mesh.nodes.size() - 1);
    is_chosen[static_cast<std::size_t>(n)] = true;
  }
  for (const int t : topology.elements) {
    const Tet& corners = mesh.tets[static_cast<std::size_t>(t)];
    if (std::all_of(corners.begin(), corners.end(), [&](int n) { return is_chosen[static_cast<std::size_t>(n)]; }))
      tets.push_back(t);
  }
  if (tets.empty()) return fmt::format("no element has all its corners among the {} nodes", nodes.size());
  return {};
}

Status name_problem(const std::string& name) {
  if (name.empty()) return "the name is empty";
  if (name.find_first_of("\"\n\r") != name.npos) return "the name has a quote or a line end";
  return {};
}

/// The number that a tag means, of the names and numbers that there are.
Status find_number(const RegionTag& tag, const TetMesh& mesh, int& number) {
  std::vector<int> of_name;
  for (const auto& [region, name] : mesh.region_names)
    if (name == tag.name) of_name.push_back(region);
  if (tag.number) {
    number = *tag.number;
    const auto named = mesh.region_names.find(number);
    if (named != mesh.region_names.end() && named->second != tag.name)
      return fmt::format("region {} is named '{}', not '{}'", number, named->second, tag.name);
    if (!of_name.empty() && std::find(of_name.begin(), of_name.end(), number) == of_name.end())
      return fmt::format("'{}' is the name of region {}, not of {}", tag.name, of_name.front(), number);
    return {};
  }
  if (of_name.size() > 1)
    return fmt::format("regions {} and {} are both named '{}': give the number", of_name[0], of_name[1], tag.name);
  if (!of_name.empty()) {
    number = of_name.front();
    return {};
  }
  int largest = mesh.regions.empty() ? 0 : *std::max_element(mesh.regions.begin(), mesh.regions.end());
  if (!mesh.region_names.empty()) largest = std::max(largest, mesh.region_names.rbegin()->first);
  if (largest == std::numeric_limits<int>::max()) return "no number is left above those of the mesh: give one";
  number = largest + 1;
  return {};
}

}  // namespace

Status resolve_region(const RegionTag& tag, const TetMesh& mesh, const Topology& topology, TaggedRegion& region) {
  region = {0, tag.name, {}};
  if (const Status status = name_problem(tag.name); !status.ok()) return status;
  if (const Status status = find_number(tag, mesh, region.number); !status.ok()) return status;
  return tag.nodes.empty() ? select_elements(tag.which, mesh, topology, region.tets)
                           : elements_of_nodes(tag.nodes, mesh, topology, region.tets);
}

void tag_region(const TaggedRegion& region, TetMesh& mesh) {
  for (const int t : region.tets) mesh.regions[static_cast<std::size_t>(t)] = region.number;
  mesh.region_names[region.number] = region.name;
}

}  // namespace heml
