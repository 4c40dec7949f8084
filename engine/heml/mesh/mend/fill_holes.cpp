#include <algorithm>
#include <cmath>
#include <heml/mesh/from_surface.hpp>
#include <heml/mesh/mend/fill_holes.hpp>
#include <heml/mesh/mend/half_edges.hpp>
#include <heml/mesh/shells.hpp>
#include <limits>
#include <set>
#include <utility>

namespace heml {
namespace {

constexpr std::size_t max_edges = 400;  // of a hole
constexpr double max_work = 1.5e8;      // triangles weighed in all
constexpr double sheet_share = 0.75;    // of a component's area that its openings take
constexpr double roundness = 1e-4;      // weight of a square metre of squared edges against one of area
constexpr double infinite = std::numeric_limits<double>::infinity();

using Edge = std::pair<int, int>;

struct Hole {
  std::vector<int> nodes;  ///< in the direction of the triangles round it
  int component = 0;
  std::vector<Triangle> filling;
  bool is_filled = false;
  double area = 0;
};

double area_of(const TriangleMesh& surface, const Triangle& t) {
  return 0.5 * (surface.nodes[t[1]] - surface.nodes[t[0]]).cross(surface.nodes[t[2]] - surface.nodes[t[0]]).norm();
}

/// The loops of open edges, cut where one passes a node twice. Loops that meet a crowded edge are left out.
class LoopFinder {
 public:
  LoopFinder(const TriangleMesh& surface, const Shells& components)
      : surface_(surface),
        components_(components),
        edges_(find_half_edges(surface)),
        seen_(edges_.across.size(), 0),
        place_(surface.nodes.size(), -1) {}

  std::vector<Hole> find() {
    for (int half = 0; half < static_cast<int>(seen_.size()); ++half)
      if (edges_.across[half] == HalfEdges::open && !seen_[half]) follow(half);
    return std::move(holes_);
  }
  int left_out() const { return left_out_; }

 private:
  /// The open half-edge that begins where this one ends, within one fan of triangles; −1 at a crowded edge.
  int next_open(int half) const {
    int at = HalfEdges::next(half);
    for (std::size_t turns = 0; edges_.across[at] >= 0 && turns < seen_.size(); ++turns)
      at = HalfEdges::next(edges_.across[at]);
    return edges_.across[at] == HalfEdges::open ? at : -1;
  }

  void follow(int first) {
    std::vector<int> loop;
    int half = first;
    while (half >= 0 && !seen_[half]) {
      seen_[half] = 1;
      loop.push_back(HalfEdges::from(surface_, half));
      half = next_open(half);
    }
    if (half != first) {
      ++left_out_;
      return;
    }
    cut_and_add(loop, components_.of_triangle[first / 3]);
  }

  void cut_and_add(const std::vector<int>& loop, int component) {
    std::vector<int> path;
    for (const int n : loop) {
      if (place_[n] >= 0) {
        const std::vector<int> cut(path.begin() + place_[n], path.end());
        path.resize(path.size() - cut.size());
        for (const int other : cut) place_[other] = -1;
        holes_.push_back({cut, component, {}, false, 0});
      }
      place_[n] = static_cast<int>(path.size());
      path.push_back(n);
    }
    for (const int n : path) place_[n] = -1;
    holes_.push_back({path, component, {}, false, 0});
  }

  const TriangleMesh& surface_;
  const Shells& components_;
  HalfEdges edges_;
  std::vector<char> seen_;
  std::vector<int> place_;  ///< of a node in the loop followed, from 0
  std::vector<Hole> holes_;
  int left_out_ = 0;
};

/// Weighs all triangulations of one loop.
class LoopFiller {
 public:
  LoopFiller(const TriangleMesh& surface, const std::set<Edge>& taken, const std::vector<int>& loop)
      : surface_(surface),
        taken_(taken),
        loop_(loop),
        n_(loop.size()),
        weight_(n_ * n_, infinite),
        middle_(n_ * n_, 0) {}

  /// None: empty.
  std::vector<Triangle> fill() {
    for (std::size_t i = 0; i + 1 < n_; ++i) weight_[i * n_ + i + 1] = 0;
    for (std::size_t span = 2; span < n_; ++span)
      for (std::size_t i = 0; i + span < n_; ++i) weigh(i, i + span);
    std::vector<Triangle> triangles;
    if (weight_[n_ - 1] < infinite) collect(0, n_ - 1, triangles);
    return triangles;
  }

 private:
  void weigh(std::size_t i, std::size_t k) {
    const bool is_rim = i == 0 && k == n_ - 1;
    if (!is_rim && taken_.contains(std::minmax({loop_[i], loop_[k]}))) return;
    for (std::size_t j = i + 1; j < k; ++j) {
      const double sides = weight_[i * n_ + j] + weight_[j * n_ + k];
      if (sides >= weight_[i * n_ + k]) continue;
      const double sum = sides + weight(i, j, k);
      if (sum >= weight_[i * n_ + k]) continue;
      weight_[i * n_ + k] = sum;
      middle_[i * n_ + k] = static_cast<int>(j);
    }
  }

  double weight(std::size_t i, std::size_t j, std::size_t k) const {
    const Vec3 &a = surface_.nodes[loop_[i]], &b = surface_.nodes[loop_[j]], &c = surface_.nodes[loop_[k]];
    if (!has_area(a, b, c)) return infinite;
    return 0.5 * (b - a).cross(c - a).norm() +
           roundness * ((b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm());
  }

  void collect(std::size_t i, std::size_t k, std::vector<Triangle>& triangles) const {
    if (k < i + 2) return;
    const auto j = static_cast<std::size_t>(middle_[i * n_ + k]);
    triangles.push_back({loop_[k], loop_[j], loop_[i]});
    collect(i, j, triangles);
    collect(j, k, triangles);
  }

  const TriangleMesh& surface_;
  const std::set<Edge>& taken_;
  const std::vector<int>& loop_;
  std::size_t n_;
  std::vector<double> weight_;
  std::vector<int> middle_;
};

/// The edges of the surface between nodes of holes.
std::set<Edge> edges_between(const TriangleMesh& surface, const std::vector<Hole>& holes) {
  std::vector<char> is_on_hole(surface.nodes.size(), 0);
  for (const Hole& hole : holes)
    for (const int n : hole.nodes) is_on_hole[n] = 1;
  std::set<Edge> edges;
  for (const Triangle& t : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      if (const int a = t[i], b = t[(i + 1) % 3]; is_on_hole[a] && is_on_hole[b]) edges.insert(std::minmax({a, b}));
  return edges;
}

void fill_loops(const TriangleMesh& surface, std::vector<Hole>& holes) {
  std::set<Edge> taken = edges_between(surface, holes);
  double work = 0;
  for (Hole& hole : holes) {
    const auto n = static_cast<double>(hole.nodes.size());
    if (hole.nodes.size() < 3) continue;
    if (hole.nodes.size() <= max_edges && (work += n * n * n / 6) <= max_work)
      hole.filling = LoopFiller(surface, taken, hole.nodes).fill();
    hole.is_filled = !hole.filling.empty();
    Vec3 vector = Vec3::Zero();  // of the area of any filling, the least that it can have
    for (std::size_t k = 1; k + 1 < hole.nodes.size(); ++k)
      vector += (surface.nodes[hole.nodes[k]] - surface.nodes[hole.nodes[0]])
                    .cross(surface.nodes[hole.nodes[k + 1]] - surface.nodes[hole.nodes[0]]) /
                2;
    hole.area = vector.norm();
    if (hole.is_filled) hole.area = 0;
    for (const Triangle& t : hole.filling) {
      hole.area += area_of(surface, t);
      for (std::size_t i = 0; i < 3; ++i) taken.insert(std::minmax({t[i], t[(i + 1) % 3]}));
    }
  }
}

double length_round(const TriangleMesh& surface, const Hole& hole) {
  double length = 0;
  for (std::size_t k = 0; k < hole.nodes.size(); ++k)
    length += (surface.nodes[hole.nodes[k]] - surface.nodes[hole.nodes[(k + 1) % hole.nodes.size()]]).norm();
  return length;
}

/// Components whose openings take most of what would close them.
std::vector<char> find_sheets(const TriangleMesh& surface, const Shells& components, const std::vector<Hole>& holes) {
  std::vector<double> areas(components.count, 0.0), openings(components.count, 0.0);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    areas[components.of_triangle[t]] += area_of(surface, surface.triangles[t]);
  for (const Hole& hole : holes) openings[hole.component] += hole.area;
  std::vector<char> is_sheet;
  for (std::size_t k = 0; k < areas.size(); ++k) is_sheet.push_back(openings[k] > sheet_share * areas[k]);
  return is_sheet;
}

}  // namespace

FilledHoles fill_holes(TriangleMesh& surface) {
  const Shells components = orient_consistently(surface);
  FilledHoles result;
  LoopFinder finder(surface, components);
  std::vector<Hole> holes = finder.find();
  result.left_open = finder.left_out();
  fill_loops(surface, holes);
  const std::vector<char> is_sheet = find_sheets(surface, components, holes);
  result.sheets = static_cast<int>(std::count(is_sheet.begin(), is_sheet.end(), 1));
  std::vector<Triangle> triangles;
  double area = 0, sheet_area = 0, largest = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& triangle = surface.triangles[t];
    const bool is_kept = !is_sheet[components.of_triangle[t]];
    (is_kept ? area : sheet_area) += area_of(surface, triangle);
    if (is_kept) triangles.push_back(triangle);
  }
  result.sheet_area = sheet_area / (area + sheet_area);
  if (triangles.empty()) return result;
  for (const Hole& hole : holes) {
    if (is_sheet[hole.component]) continue;
    result.left_open += !hole.is_filled;
    if (!hole.is_filled) continue;
    ++result.holes;
    result.edges += static_cast<int>(hole.nodes.size());
    result.longest = std::max(result.longest, length_round(surface, hole));
    largest = std::max(largest, hole.area);
    triangles.insert(triangles.end(), hole.filling.begin(), hole.filling.end());
  }
  result.largest_share = largest / area;
  surface.triangles = std::move(triangles);
  return result;
}

}  // namespace heml
