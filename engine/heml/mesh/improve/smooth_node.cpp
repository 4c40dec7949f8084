#include <algorithm>
#include <heml/mesh/improve/smooth_node.hpp>
#include <optional>

namespace heml {
namespace {

constexpr int steps = 4;
constexpr int halvings = 7;
constexpr double active_window = 0.03;  // of quality above the worst

/// The vector of least length in the convex hull of the gradients (Frank & Wolfe's method): the direction in which all
/// active terms grow, nearly zero if there is none.
Vec3 common_ascent(const std::vector<ShapeTerm>& terms) {
  Vec3 d = terms.front().gradient;
  for (int round = 0; round < 40; ++round) {
    const auto slowest = std::min_element(terms.begin(), terms.end(), [&](const ShapeTerm& a, const ShapeTerm& b) {
      return a.gradient.dot(d) < b.gradient.dot(d);
    });
    const Vec3 towards = slowest->gradient - d;
    const double gap = -towards.dot(d), length = towards.squaredNorm();
    if (!(gap > 1e-3 * d.squaredNorm()) || !(length > 0)) break;
    d += std::min(1.0, gap / length) * towards;
  }
  return d;
}

/// The component of a vector along which a node may move.
Vec3 free_part(const LocalMesh& mesh, const NodeFreedom& freedom, const Vec3& v) {
  switch (freedom.kind) {
    case NodeFreedom::Kind::interior:
      return v;
    case NodeFreedom::Kind::smooth:
      return v - v.dot(freedom.direction) * freedom.direction;
    case NodeFreedom::Kind::crease: {
      const Vec3 along = (mesh.node(freedom.along[1]) - mesh.node(freedom.along[0])).normalized();
      return v.dot(along) * along;
    }
    case NodeFreedom::Kind::corner:
      break;
  }
  return Vec3::Zero();
}

class NodeSmoother {
 public:
  NodeSmoother(LocalMesh& mesh, const SurfaceGuard& guard, int node)
      : mesh_(mesh), guard_(guard), node_(node), freedom_(freedom_of(mesh, node)) {}

  bool is_free() const { return freedom_.kind != NodeFreedom::Kind::corner && !mesh_.star(node_).empty(); }

  bool step() {
    const double worst = mesh_.worst(mesh_.star(node_));
    const auto terms = active_terms(worst + active_window);
    if (terms.empty()) return false;
    Vec3 direction = common_ascent(terms);
    const double speed = direction.norm();
    if (!(speed > 0)) return false;
    direction /= speed;
    double length = 0.5 * edge_length();
    for (int k = 0; k < halvings; ++k, length /= 2)
      if (accept(mesh_.node(node_) + length * direction, worst)) return true;
    return false;
  }

 private:
  std::vector<ShapeTerm> active_terms(double limit) const {
    std::vector<ShapeTerm> terms;
    for (const int t : mesh_.star(node_)) {
      const Tet& tet = mesh_.tet(t);
      const auto corner = std::find(tet.begin(), tet.end(), node_) - tet.begin();
      mesh_.measure().append_terms(mesh_.corners(tet), static_cast<int>(corner), limit, terms);
    }
    for (ShapeTerm& term : terms) term.gradient = free_part(mesh_, freedom_, term.gradient);
    return terms;
  }

  double edge_length() const {
    double sum = 0;
    for (const int t : mesh_.star(node_))
      for (const int n : mesh_.tet(t)) sum += (mesh_.node(n) - mesh_.node(node_)).norm();
    return sum / (3.0 * static_cast<double>(mesh_.star(node_).size()));
  }

  /// A point of the surface or the crease near x.
  std::optional<Vec3> on_surface(const Vec3& x) const {
    if (freedom_.kind == NodeFreedom::Kind::interior) return x;
    if (freedom_.kind == NodeFreedom::Kind::smooth) {
      const auto nearest = guard_.original().nearest(x, 4 * guard_.tolerance());
      if (nearest.triangle < 0) return std::nullopt;
      return nearest.point;
    }
    const Vec3 here = mesh_.node(node_), move = x - here;
    for (const int end : freedom_.along) {
      const Vec3 edge = mesh_.node(end) - here;
      const double part = move.dot(edge) / edge.squaredNorm();
      if (part > 0 && part < 1) return here + part * edge;
    }
    return std::nullopt;
  }

  bool accept(const Vec3& wanted, double worst) {
    const auto x = on_surface(wanted);
    if (!x) return false;
    double after = 1;
    for (const int t : mesh_.star(node_)) {
      Corners corners = mesh_.corners(mesh_.tet(t));
      for (std::size_t k = 0; k < 4; ++k)
        if (mesh_.tet(t)[k] == node_) corners[k] = *x;
      after = std::min(after, mesh_.measure()(corners));
      if (!(after > worst + smallest_gain)) return false;
    }
    if (freedom_.kind != NodeFreedom::Kind::interior) {
      const Patch before = patch_of(mesh_, freedom_.faces);
      Patch moved = before;
      for (auto& triangle : moved) triangle[0] = *x;
      if (!guard_.allows(before, moved)) return false;
    }
    mesh_.move(node_, *x);
    return true;
  }

  LocalMesh& mesh_;
  const SurfaceGuard& guard_;
  int node_;
  NodeFreedom freedom_;
};

}  // namespace

bool smooth_node(LocalMesh& mesh, const SurfaceGuard& guard, int node) {
  NodeSmoother smoother(mesh, guard, node);
  if (!smoother.is_free()) return false;
  bool improved = false;
  for (int k = 0; k < steps && smoother.step(); ++k) improved = true;
  return improved;
}

}  // namespace heml
