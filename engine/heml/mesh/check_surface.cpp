#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/mesh/coordinates.hpp>
#include <heml/mesh/from_surface.hpp>
#include <heml/mesh/intersections.hpp>
#include <heml/mesh/shells.hpp>
#include <heml/mesh/untangle.hpp>
#include <limits>
#include <utility>

namespace heml {
namespace {

std::string triangle_place(std::size_t t) { return fmt::format("triangle {}", t); }

void check_nodes(const TriangleMesh& surface) {
  for (std::size_t n = 0; n < surface.nodes.size(); ++n)
    if (!(surface.nodes[n].cwiseAbs().maxCoeff() <= max_coordinate) || !surface.nodes[n].allFinite())
      throw InputError(surface.source, fmt::format("node {}", n),
                       "position " + shown(surface.nodes[n]) + " is no place in metres",
                       fmt::format("finite coordinates up to {:.0e}", max_coordinate));
}

void check_triangles(const TriangleMesh& surface) {
  if (surface.triangles.empty()) throw InputError(surface.source, "", "has no triangles", "a closed surface");
  const int nodes = static_cast<int>(surface.nodes.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& triangle = surface.triangles[t];
    for (int node : triangle)
      if (node < 0 || node >= nodes)
        throw InputError(surface.source, triangle_place(t), fmt::format("names node {}, there are {}", node, nodes));
  }
}

void check_areas(const TriangleMesh& surface) {
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& triangle = surface.triangles[t];
    const Vec3 &a = surface.nodes[triangle[0]], &b = surface.nodes[triangle[1]], &c = surface.nodes[triangle[2]];
    if (!has_area(a, b, c))
      throw InputError(surface.source, triangle_place(t),
                       fmt::format("has no area (corners {}, {}, {})", shown(a), shown(b), shown(c)),
                       "collapse its shortest edge or flip its longest");
  }
}

void check_duplicates(const TriangleMesh& surface) {
  std::vector<std::pair<Triangle, int>> sorted;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    sorted.push_back({surface.triangles[t], static_cast<int>(t)});
    std::sort(sorted.back().first.begin(), sorted.back().first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  std::size_t count = 0, shown_at = 0;
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i].first == sorted[i - 1].first && count++ == 0) shown_at = i;
  if (count > 0)
    throw InputError(surface.source, triangle_place(sorted[shown_at].second),
                     fmt::format("lies on triangle {}; {} such duplicates in all", sorted[shown_at - 1].second, count),
                     "each triangle once");
}

void check_edges(const TriangleMesh& surface) {
  std::vector<std::pair<int, int>> edges;
  for (const Triangle& t : surface.triangles)
    for (int i = 0; i < 3; ++i) edges.push_back(std::minmax(t[i], t[(i + 1) % 3]));
  std::sort(edges.begin(), edges.end());
  std::size_t open = 0, crowded = 0;
  std::pair<int, int> an_open, a_crowded;
  for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
    while (last < edges.size() && edges[last] == edges[first]) ++last;
    if (last - first == 1 && open++ == 0) an_open = edges[first];
    if (last - first > 2 && crowded++ == 0) a_crowded = edges[first];
  }
  const auto place = [&](const std::pair<int, int>& edge) {
    return fmt::format("edge from {} to {}", shown(surface.nodes[edge.first]), shown(surface.nodes[edge.second]));
  };
  if (open > 0)
    throw InputError(surface.source, place(an_open),
                     fmt::format("the surface is open: {} edges have a triangle on one side only", open),
                     "fill the holes; only a closed surface has an inside");
  if (crowded > 0)
    throw InputError(surface.source, place(a_crowded), fmt::format("{} edges have more than two triangles", crowded),
                     "remove inner walls and parts that touch");
}

void check_intersections(TriangleMesh& surface) {
  const Intersections found = self_intersections(surface);
  if (found.pairs == 0 || untangle(surface, found)) return;
  const Triangle& first = surface.triangles[found.first];
  const std::string problem =
      fmt::format("meets triangle {} near {}; the surface runs through itself in {}{} pairs of triangles", found.second,
                  shown(surface.nodes[first[0]]), found.pairs >= max_pairs ? "at least " : "", found.pairs);
  throw SelfIntersection(
      InputError(surface.source, triangle_place(found.first), problem, "separate or unite the parts"), found.pairs);
}

}  // namespace

bool has_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double edge = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  const double size = std::max({a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff(), c.cwiseAbs().maxCoeff()});
  return (b - a).cross(c - a).norm() > 4 * std::numeric_limits<double>::epsilon() * edge * (edge + size);
}

void check_numbers(const TriangleMesh& surface) {
  check_nodes(surface);
  check_triangles(surface);
}

void check_surface(TriangleMesh& surface) {
  check_numbers(surface);
  check_areas(surface);
  check_duplicates(surface);
  check_edges(surface);
  const Shells shells = orient_consistently(surface);
  check_intersections(surface);
  orient_outward(surface, shells);
}

}  // namespace heml
