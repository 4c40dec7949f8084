#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/mesh/improve/collapse_edge.hpp>
#include <heml/mesh/improve/improve.hpp>
#include <heml/mesh/improve/orient.hpp>
#include <heml/mesh/improve/remove_edge.hpp>
#include <heml/mesh/improve/remove_face.hpp>
#include <heml/mesh/improve/resize.hpp>
#include <heml/mesh/improve/smooth_node.hpp>
#include <heml/mesh/improve/split_edge.hpp>
#include <heml/mesh/improve/transfer_fields.hpp>
#include <heml/mesh/quality.hpp>
#include <numbers>

namespace heml {
namespace {

constexpr double tolerance_of_diagonal = 0.005;
constexpr double altitude_of_median = 0.35;  // wanted of every element
constexpr double margin = 0.08;              // of quality past the goal, for altitudes
constexpr double goal_margin = 1.01;         // of the sine
constexpr int max_rounds = 30;
constexpr int max_untangling_rounds = 50;
constexpr double volume_to_reach = 0.01;  // of the mean one
constexpr int max_idle_rounds = 3;
constexpr double near_enough = 0.1;  // of the wanted number of elements

double volume_of_corners(const Corners& x) { return signed_volume(x[0], x[1], x[2], x[3]); }

class Improver {
 public:
  Improver(LocalMesh& mesh, const SurfaceGuard& guard, const ImproveOptions& options)
      : mesh_(mesh), guard_(guard), options_(options), goal_(mesh.measure().goal) {}

  void run() {
    untangle();
    set_wanted_altitude();
    if (options_.tets)
      for (int k = 0; k < 3 && !has_wanted_number(); ++k) {
        show(0.2 * k, *options_.tets < mesh_.count() ? "coarsening" : "refining");
        resize(*options_.tets);
        set_wanted_altitude();
        improve_rounds(k < 2 ? 2 : max_rounds);
      }
    improve_rounds(max_rounds);
  }

 private:
  /// Moves nodes of inverted elements to where the smallest volume round them is largest.
  void untangle() {
    const ShapeMeasure shape = mesh_.measure();
    double volume = 0;
    for (int t = 0; t < mesh_.slots(); ++t) volume += std::abs(volume_of_corners(mesh_.corners(mesh_.tet(t))));
    mesh_.set_measure({.volume_rate = mesh_.count() / volume});
    for (int round = 0; round < max_untangling_rounds; ++round) {
      int moved = 0;
      for (int t = 0; t < mesh_.slots(); ++t)
        for (const int n : mesh_.tet(t))
          if (!(mesh_.quality(t) > volume_to_reach)) moved += smooth_node(mesh_, guard_, n);
      if (moved == 0) break;
    }
    mesh_.set_measure(shape);
  }

  bool has_wanted_number() const { return std::abs(mesh_.count() - *options_.tets) <= near_enough * *options_.tets; }

  void resize(int tets) {
    if (tets < mesh_.count())
      coarsen(mesh_, guard_, tets, goal_);
    else
      refine_longest(mesh_, tets);
  }

  void show(double fraction, const char* doing) const {
    if (options_.progress) options_.progress(fraction, doing);
  }

  void set_wanted_altitude() {
    std::vector<double> altitudes;
    for (int t = 0; t < mesh_.slots(); ++t)
      if (mesh_.exists(t)) altitudes.push_back(smallest_altitude(mesh_.corners(mesh_.tet(t))));
    const auto middle = altitudes.begin() + static_cast<std::ptrdiff_t>(altitudes.size() / 2);
    std::nth_element(altitudes.begin(), middle, altitudes.end());
    mesh_.set_measure({goal_, *middle > 0 ? margin / (altitude_of_median * *middle) : 0});
    std::fill(failed_at_.begin(), failed_at_.end(), -1);
  }

  /// Elements that miss what is wanted, the worst first.
  std::vector<int> bad_elements() const {
    std::vector<int> bad;
    for (int t = 0; t < mesh_.slots(); ++t)
      if (mesh_.exists(t) && mesh_.quality(t) < goal_ + margin) bad.push_back(t);
    std::sort(bad.begin(), bad.end(),
              [&](int a, int b) { return std::pair(mesh_.quality(a), a) < std::pair(mesh_.quality(b), b); });
    return bad;
  }

  void improve_rounds(int most) {
    std::size_t fewest = static_cast<std::size_t>(mesh_.count()) + 1;
    int idle = 0;
    for (int round = 0; round < most && idle < max_idle_rounds; ++round) {
      const std::vector<int> bad = bad_elements();
      if (bad.empty()) return;
      idle = static_cast<double>(bad.size()) < 0.99 * static_cast<double>(fewest) ? 0 : idle + 1;
      fewest = std::min(fewest, bad.size());
      int changes = 0;
      for (std::size_t k = 0; k < bad.size(); ++k) {
        if (k % 64 == 0)
          show((round + static_cast<double>(k) / static_cast<double>(bad.size())) / most, "improving shapes");
        if (is_bad(bad[k]) && is_worth_trying(bad[k])) changes += try_to_improve(bad[k], round > 0);
      }
      if (changes == 0) return;
    }
  }

  bool is_bad(int t) const { return mesh_.exists(t) && mesh_.quality(t) < goal_ + margin; }

  /// Whether something near the element changed since nothing helped it.
  bool is_worth_trying(int t) {
    failed_at_.resize(static_cast<std::size_t>(mesh_.slots()), -1);
    changed_at_.resize(static_cast<std::size_t>(mesh_.nodes()), 0);
    const Tet& tet = mesh_.tet(t);
    return std::any_of(tet.begin(), tet.end(), [&](int n) { return changed_at_[n] > failed_at_[t]; });
  }

  bool try_to_improve(int t, bool may_split) {
    mesh_.take_changed_nodes();
    const bool done = treat(t, may_split);
    const auto changed = mesh_.take_changed_nodes();
    if (!done && may_split) failed_at_[t] = clock_;
    if (!done) return false;
    ++clock_;
    changed_at_.resize(static_cast<std::size_t>(mesh_.nodes()), 0);
    for (const int n : changed) changed_at_[n] = clock_;
    return true;
  }

  /// The first operation that helps.
  bool treat(int t, bool may_split) {
    const Tet nodes = mesh_.tet(t);
    for (const auto& [i, j] : tet_edges)
      if (remove_edge(mesh_, guard_, nodes[i], nodes[j])) return true;
    for (int f = 0; f < 4; ++f)
      if (remove_face(mesh_, t, f)) return true;
    bool moved = false;
    for (const int n : nodes) moved |= smooth_node(mesh_, guard_, n);
    if (moved) return true;
    for (const auto& [i, j] : tet_edges)
      if (collapse_if_better(mesh_, guard_, nodes[i], nodes[j]) ||
          collapse_if_better(mesh_, guard_, nodes[j], nodes[i]))
        return true;
    if (may_split && mesh_.quality(t) < goal_)
      for (const auto& [i, j] : tet_edges)
        if (split_if_better(mesh_, guard_, nodes[i], nodes[j])) return true;
    return false;
  }

  LocalMesh& mesh_;
  const SurfaceGuard& guard_;
  const ImproveOptions& options_;
  double goal_;
  // Counts of changes: of the mesh, at the last one near each node, and when nothing helped an element.
  long clock_ = 0;
  std::vector<long> changed_at_, failed_at_;
};

double diagonal_of(const TetMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Tet& tet : mesh.tets)
    for (const int n : tet) box.extend(mesh.nodes[n]);
  return box.diagonal().norm();
}

void expect_untangled(const TetMesh& before, const std::vector<int>& inverted, const LocalMesh& mesh) {
  int left = 0;
  for (int t = 0; t < mesh.slots(); ++t) left += mesh.exists(t) && !(mesh.quality(t) > 0);
  if (left == 0) return;
  const std::vector<int> first(inverted.begin(), inverted.begin() + std::min<std::ptrdiff_t>(std::ssize(inverted), 10));
  throw InputError(
      before.source, fmt::format("element {}", first.empty() ? 0 : first[0]),
      fmt::format("{} inverted or flat elements ({}{}), of which {} could not be untangled", inverted.size(),
                  fmt::join(first, ", "), first.size() < inverted.size() ? ", ..." : "", left),
      "mesh its surface anew: heml mesh SURFACE");
}

std::vector<int> elements_below(const TetMesh& mesh, double degrees) {
  std::vector<std::pair<double, int>> below;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Tet& tet = mesh.tets[t];
    const double angle = min_dihedral({mesh.nodes[tet[0]], mesh.nodes[tet[1]], mesh.nodes[tet[2]], mesh.nodes[tet[3]]});
    if (angle < degrees) below.emplace_back(angle, static_cast<int>(t));
  }
  std::sort(below.begin(), below.end());
  std::vector<int> elements;
  for (const auto& [angle, t] : below) elements.push_back(t);
  return elements;
}

}  // namespace

Improvement improve(TetMesh mesh, const ImproveOptions& options) {
  check_connectivity(mesh);
  const std::vector<int> inverted = orient_elements(mesh);
  Improvement result;
  result.untangled = static_cast<int>(inverted.size());
  result.surface_tolerance = options.surface_tolerance.value_or(tolerance_of_diagonal * diagonal_of(mesh));
  const SurfaceGuard guard(constrained_surface(mesh), result.surface_tolerance);
  LocalMesh local(mesh, {goal_margin * std::sin(options.min_angle * std::numbers::pi / 180), 0});
  Improver(local, guard, options).run();
  expect_untangled(mesh, inverted, local);
  result.mesh = local.extract(mesh.source);
  result.mesh.region_names = mesh.region_names;
  transfer_fields(mesh, result.mesh);
  result.surface_distance = surface_distance(guard.original(), SurfaceTree(constrained_surface(result.mesh)));
  result.below = elements_below(result.mesh, options.min_angle);
  return result;
}

}  // namespace heml
