#include <algorithm>
#include <heml/base/log.hpp>
#include <heml/mesh/untangle.hpp>

namespace heml {
namespace {

constexpr int rounds = 30;
constexpr std::size_t one_in = 50;     // if more than one in so many triangles intersects, it is not just a crease
constexpr double farthest_move = 1.5;  // mean edge lengths

std::vector<std::vector<int>> neighbours_of(const TriangleMesh& surface) {
  std::vector<std::vector<int>> neighbours(surface.nodes.size());
  for (const Triangle& t : surface.triangles)
    for (std::size_t c = 0; c < 3; ++c) neighbours[static_cast<std::size_t>(t[c])].push_back(t[(c + 1) % 3]);
  return neighbours;  // complete, since triangles of a closed surface traverse every edge in both directions
}

double mean_edge(const TriangleMesh& surface) {
  double sum = 0;
  for (const Triangle& t : surface.triangles)
    for (std::size_t c = 0; c < 3; ++c)
      sum += (surface.nodes[static_cast<std::size_t>(t[c])] - surface.nodes[static_cast<std::size_t>(t[(c + 1) % 3])])
                 .norm();
  return sum / (3.0 * static_cast<double>(surface.triangles.size()));
}

/// Corners of the triangles and the given number of rings of nodes round them; ascending.
std::vector<int> surroundings(const TriangleMesh& surface, const std::vector<int>& triangles,
                              const std::vector<std::vector<int>>& neighbours, int rings) {
  std::vector<int> nodes;
  for (const int t : triangles) {
    const Triangle& corners = surface.triangles[static_cast<std::size_t>(t)];
    nodes.insert(nodes.end(), corners.begin(), corners.end());
  }
  for (int ring = 0; ring <= rings; ++ring) {
    if (ring > 0)
      for (const int n : std::vector<int>(nodes)) {
        const auto& next = neighbours[static_cast<std::size_t>(n)];
        nodes.insert(nodes.end(), next.begin(), next.end());
      }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  return nodes;
}

/// Moves every node halfway to the mean of its neighbours, all at once (Laplacian smoothing, Jacobi).
void smooth(TriangleMesh& surface, const std::vector<int>& nodes, const std::vector<std::vector<int>>& neighbours) {
  std::vector<Vec3> moved;
  for (const int n : nodes) {
    Vec3 mean = Vec3::Zero();
    for (const int other : neighbours[static_cast<std::size_t>(n)])
      mean += surface.nodes[static_cast<std::size_t>(other)];
    mean /= static_cast<double>(neighbours[static_cast<std::size_t>(n)].size());
    moved.push_back((surface.nodes[static_cast<std::size_t>(n)] + mean) / 2);
  }
  for (std::size_t k = 0; k < nodes.size(); ++k) surface.nodes[static_cast<std::size_t>(nodes[k])] = moved[k];
}

}  // namespace

bool untangle(TriangleMesh& surface, const Intersections& found) {
  if (found.triangles.size() * one_in > surface.triangles.size()) return false;
  const auto neighbours = neighbours_of(surface);
  const std::vector<Vec3> before = surface.nodes;
  const double edge = mean_edge(surface);
  Intersections left = found;
  for (int round = 0; round < rounds && left.pairs > 0; ++round) {
    smooth(surface, surroundings(surface, left.triangles, neighbours, 1 + round / 10), neighbours);
    left = self_intersections(surface);
  }
  double farthest = 0;
  int count = 0;
  for (std::size_t n = 0; n < before.size(); ++n) {
    farthest = std::max(farthest, (surface.nodes[n] - before[n]).norm());
    count += surface.nodes[n] != before[n];
  }
  if (left.pairs > 0 || farthest > farthest_move * edge) {
    surface.nodes = before;
    return false;
  }
  warn(
      "{}: the surface ran through itself in {} pairs of triangles (the first: {} and {}); {} nodes were smoothed "
      "apart, by {:.3g} m "
      "at most",
      surface.source, found.pairs, found.first, found.second, count, farthest);
  return true;
}

}  // namespace heml
