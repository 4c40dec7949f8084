#include <fmt/format.h>

#include <algorithm>
#include <heml/base/error.hpp>
#include <heml/mesh/surface.hpp>
#include <heml/scenario/selection.hpp>
#include <limits>

namespace heml {
namespace {

std::string vector_text(const Vec3& v) { return fmt::format("[{:.6g}, {:.6g}, {:.6g}]", v.x(), v.y(), v.z()); }

template <class Chooses>
std::vector<int> nodes_where(const TetMesh& mesh, const Chooses& chooses) {
  std::vector<int> nodes;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (chooses(mesh.nodes[i])) nodes.push_back(static_cast<int>(i));
  return nodes;
}

std::vector<int> numbered(std::vector<int> nodes, const TetMesh& mesh, const std::string& file,
                          const std::string& place) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i] < 0 || static_cast<std::size_t>(nodes[i]) >= mesh.nodes.size())
      throw InputError(file, fmt::format("{}.nodes[{}]", place, i), fmt::format("is {}", nodes[i]),
                       fmt::format("the mesh has nodes 0 to {}", mesh.nodes.size() - 1));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

std::pair<Vec3, Vec3> bounds_of(const std::vector<Vec3>& nodes) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& node : nodes) {
    low = low.cwiseMin(node);
    high = high.cwiseMax(node);
  }
  return {low, high};
}

std::vector<int> select_nodes(const Selection& where, const TetMesh& mesh, const std::string& file,
                              const std::string& place) {
  std::vector<int> nodes;
  if (where.box) {
    const auto& [low, high] = *where.box;
    nodes = nodes_where(mesh, [&low = low, &high = high](const Vec3& x) {
      return (x.array() >= low.array() && x.array() <= high.array()).all();
    });
  } else if (where.sphere) {
    const auto& [centre, radius] = *where.sphere;
    nodes = nodes_where(mesh,
                        [&centre = centre, &radius = radius](const Vec3& x) { return (x - centre).norm() <= radius; });
  } else {
    nodes = numbered(where.nodes, mesh, file, place);
  }
  if (nodes.empty()) {
    const auto [low, high] = bounds_of(mesh.nodes);
    const char* kind = where.box ? "box" : where.sphere ? "sphere" : "list of nodes";
    throw InputError(file, place, fmt::format("its {} selects no node", kind),
                     fmt::format("the body reaches from {} to {} m", vector_text(low), vector_text(high)));
  }
  return nodes;
}

std::vector<int> select_nodes(const Selection& where, const WorldSetup& setup, const std::string& file,
                              const std::string& place) {
  std::vector<int> nodes = select_nodes(where, setup.mesh, file, place);
  if (where.box || where.sphere || setup.midedges.empty()) return nodes;
  add_midedges_between(setup.mesh, setup.midedges, nodes);
  return nodes;
}

int nearest_surface_node(const TetMesh& mesh, const Vec3& point) {
  int nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : extract_boundary(mesh).triangles) {
    for (const int node : triangle) {
      const double distance = (mesh.nodes[node] - point).norm();
      if (distance > least || (distance == least && node >= nearest)) continue;
      nearest = node;
      least = distance;
    }
  }
  return nearest;
}

}  // namespace heml
