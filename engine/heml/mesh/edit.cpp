#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <heml/mesh/edit.hpp>
#include <heml/mesh/field_of_piece.hpp>
#include <numeric>
#include <set>

namespace heml {
namespace {

Vec3 centroid(const TetMesh& mesh, int element) {
  Vec3 sum = Vec3::Zero();
  for (const int n : mesh.tets[static_cast<std::size_t>(element)]) sum += mesh.nodes[static_cast<std::size_t>(n)];
  return sum / 4;
}

template <class Chooses>
std::vector<int> elements_where(const Topology& topology, const Chooses& chooses) {
  std::vector<int> chosen;
  std::copy_if(topology.elements.begin(), topology.elements.end(), std::back_inserter(chosen), chooses);
  return chosen;
}

/// Sorts a list of elements without duplicates and checks that they exist; returns a message if not.
Status check_elements(const std::vector<int>& tets, const TetMesh& mesh, const Topology& topology,
                      std::vector<int>& chosen) {
  const int count = static_cast<int>(mesh.tets.size());
  chosen = tets;
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  for (const int t : chosen) {
    if (t < 0 || t >= count)
      return fmt::format("element {} does not exist; the mesh has elements 0 to {}", t, count - 1);
    if (!std::binary_search(topology.elements.begin(), topology.elements.end(), t))
      return fmt::format("element {} was removed before", t);
  }
  if (chosen.empty()) return "names no element; give at least one, from 0";
  return {};
}

/// Message for a region, box or sphere without elements.
std::string nothing_chosen(const ElementSelection& which, const TetMesh& mesh, const Topology& topology) {
  if (which.region) {
    std::set<int> regions;
    for (const int t : topology.elements) regions.insert(mesh.regions[static_cast<std::size_t>(t)]);
    return fmt::format("no element of region {} is there; the regions that are: {}", *which.region,
                       fmt::join(regions, ", "));
  }
  Eigen::AlignedBox3d centroids;
  for (const int t : topology.elements) centroids.extend(centroid(mesh, t));
  const Vec3 low = centroids.min(), high = centroids.max();
  return fmt::format(
      "the {} holds no centroid of an element; at rest they lie from [{:.6g}, {:.6g}, {:.6g}] to [{:.6g}, {:.6g}, "
      "{:.6g}] m",
      which.box ? "box" : "sphere", low.x(), low.y(), low.z(), high.x(), high.y(), high.z());
}

}  // namespace

Topology full_topology(const TetMesh& mesh, long version) {
  Topology topology{version, std::vector<int>(mesh.tets.size())};
  std::iota(topology.elements.begin(), topology.elements.end(), 0);
  return topology;
}

Topology apply_edit(const Topology& topology, const MeshEdit& edit, int elements) {
  Topology result{topology.version + 1, {}};
  std::set_difference(topology.elements.begin(), topology.elements.end(), edit.removed.begin(), edit.removed.end(),
                      std::back_inserter(result.elements));
  assert(result.elements.size() + edit.removed.size() == topology.elements.size());
  for (std::size_t k = 0; k < edit.added.size(); ++k) result.elements.push_back(elements + static_cast<int>(k));
  return result;
}

void append(const MeshEdit& edit, TetMesh& mesh) {
  append(edit, mesh.nodes);
  mesh.tets.insert(mesh.tets.end(), edit.added.begin(), edit.added.end());
  for (const int parent : edit.parents) mesh.regions.push_back(mesh.regions[static_cast<std::size_t>(parent)]);
  for (ElementField& field : mesh.fields)
    for (std::size_t k = 0; k < edit.parents.size(); ++k)
      append_piece(field, mesh, edit.parents[k], rest_corners(mesh, edit.added[k]), field.values);
  if (mesh.burns.empty()) return;
  for (const int parent : edit.parents) mesh.burns.push_back(mesh.burns[static_cast<std::size_t>(parent)]);
}

Status select_elements(const ElementSelection& which, const TetMesh& mesh, const Topology& topology,
                       std::vector<int>& chosen) {
  if (which.region) {
    chosen =
        elements_where(topology, [&](int t) { return mesh.regions[static_cast<std::size_t>(t)] == *which.region; });
  } else if (which.box) {
    const auto& [low, high] = *which.box;
    chosen = elements_where(topology, [&, low = low, high = high](int t) {
      const Vec3 at = centroid(mesh, t);
      return (at.array() >= low.array() && at.array() <= high.array()).all();
    });
  } else if (which.sphere) {
    const auto& [centre, radius] = *which.sphere;
    chosen = elements_where(topology, [&, centre = centre, radius = radius](int t) {
      return (centroid(mesh, t) - centre).norm() <= radius;
    });
  } else if (const Status known = check_elements(which.tets, mesh, topology, chosen); !known.ok()) {
    return known;
  }
  if (chosen.empty()) return nothing_chosen(which, mesh, topology);
  return {};
}

Status make_removal_edit(const ElementSelection& which, const TetMesh& mesh, const Topology& topology, MeshEdit& edit) {
  std::vector<int> chosen;
  if (const Status selected = select_elements(which, mesh, topology, chosen); !selected.ok()) return selected;
  if (chosen.size() == topology.elements.size())
    return fmt::format("all {} elements that are left would go; a body needs one at least", chosen.size());
  edit.removed = std::move(chosen);
  return {};
}

TetMesh with_elements(const TetMesh& mesh, const std::vector<int>& elements) {
  TetMesh result{mesh.nodes, with_elements(mesh.tets, elements), with_elements(mesh.regions, elements), mesh.source};
  result.region_names = mesh.region_names;
  result.burns = with_elements(mesh.burns, elements);
  for (const ElementField& field : mesh.fields)
    result.fields.push_back({field.name, field.components, with_elements(field.values, elements, field.components)});
  return result;
}

BoundaryFaces fine_boundary(const TetMesh& mesh, const MidEdges& midedges, const Topology& topology) {
  if (topology.elements.size() == mesh.tets.size()) return fine_boundary(mesh, midedges);
  return fine_boundary(with_elements(mesh, topology.elements), with_elements(midedges, topology.elements));
}

}  // namespace heml
