#include <algorithm>
#include <cmath>
#include <heml/base/thread_team.hpp>
#include <heml/mesh/embedding.hpp>
#include <heml/mesh/improve/surface_tree.hpp>
#include <heml/mesh/surface.hpp>
#include <numeric>

namespace heml {
namespace {

constexpr std::size_t points_per_thread = 500;
constexpr double least_inside = -1e-9;  // smallest weight of a point that is inside, for points on faces

/// The tetrahedra by cells of a lattice over the body, about as many cells as tetrahedra.
class TetLattice {
 public:
  explicit TetLattice(const TetMesh& mesh) : mesh_(mesh) {
    for (const Vec3& x : mesh.nodes) box_.extend(x);
    const Vec3 size = box_.sizes().cwiseMax(1e-12 * box_.diagonal().norm() + 1e-300);
    const double cell = std::cbrt(size.prod() / static_cast<double>(mesh.tets.size()));
    for (int i = 0; i < 3; ++i) cells_[i] = std::clamp(static_cast<int>(size[i] / cell), 1, 512);
    step_ = size.cwiseQuotient(Vec3(cells_[0], cells_[1], cells_[2]));
    first_.assign(static_cast<std::size_t>(cells_[0]) * cells_[1] * cells_[2] + 1, 0);
    each_cell([&](std::size_t c, int) { ++first_[c + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    tets_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    each_cell([&](std::size_t c, int t) { tets_[next[c]++] = t; });
  }

  /// The tetrahedron of which the point's smallest weight is largest; −1: it is in none.
  int containing(const Vec3& x) const {
    if (!box_.contains(x)) return -1;
    const std::size_t c = cell_of(index(x));
    int best = -1;
    double most = least_inside;
    for (std::size_t k = first_[c]; k < first_[c + 1]; ++k)
      if (const double least = weights(tets_[k], x).minCoeff(); least > most) best = tets_[k], most = least;
    return best;
  }

  Eigen::Vector4d weights(int tet, const Vec3& x) const {
    const Tet& n = mesh_.tets[static_cast<std::size_t>(tet)];
    const auto X = [&](std::size_t i) { return mesh_.nodes[static_cast<std::size_t>(n[i])]; };
    const double volume = signed_volume(X(0), X(1), X(2), X(3));
    return Eigen::Vector4d(signed_volume(x, X(1), X(2), X(3)), signed_volume(X(0), x, X(2), X(3)),
                           signed_volume(X(0), X(1), x, X(3)), signed_volume(X(0), X(1), X(2), x)) /
           volume;
  }

 private:
  using Index = std::array<int, 3>;
  Index index(const Vec3& x) const {
    Index at{};
    for (int i = 0; i < 3; ++i)
      at[i] = std::clamp(static_cast<int>((x[i] - box_.min()[i]) / step_[i]), 0, cells_[i] - 1);
    return at;
  }
  std::size_t cell_of(const Index& at) const {
    return (static_cast<std::size_t>(at[2]) * cells_[1] + at[1]) * cells_[0] + at[0];
  }
  template <class Use>
  void each_cell(const Use& use) const {
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      Eigen::AlignedBox3d box;
      for (const int n : mesh_.tets[t]) box.extend(mesh_.nodes[static_cast<std::size_t>(n)]);
      const Index low = index(box.min()), high = index(box.max());
      for (int z = low[2]; z <= high[2]; ++z)
        for (int y = low[1]; y <= high[1]; ++y)
          for (int x = low[0]; x <= high[0]; ++x) use(cell_of({x, y, z}), static_cast<int>(t));
    }
  }

  const TetMesh& mesh_;
  Eigen::AlignedBox3d box_;
  Index cells_{};
  Vec3 step_;
  std::vector<std::size_t> first_;
  std::vector<int> tets_;
};

}  // namespace

Embedding embed(std::span<const Vec3> points, const TetMesh& mesh) {
  const TetLattice lattice(mesh);
  const BoundaryFaces faces = extract_boundary(mesh);
  const SurfaceTree surface(TriangleMesh{mesh.nodes, faces.triangles, mesh.source});
  Embedding result;
  result.tets.resize(points.size());
  result.nodes.resize(points.size());
  result.weights.resize(points.size());
  std::vector<double> distances(points.size(), 0);
  ThreadTeam team(0);
  team.parallel_for(points.size(), points_per_thread, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      int tet = lattice.containing(points[p]);
      if (tet < 0) {
        const SurfaceTree::Nearest nearest = surface.nearest(points[p]);
        tet = faces.tets[static_cast<std::size_t>(nearest.triangle)];
        distances[p] = nearest.distance;
      }
      result.tets[p] = tet;
      result.nodes[p] = mesh.tets[static_cast<std::size_t>(tet)];
      const Eigen::Vector4d weights = lattice.weights(tet, points[p]);
      for (int i = 0; i < 4; ++i) result.weights[p][static_cast<std::size_t>(i)] = static_cast<float>(weights[i]);
    }
  });
  if (!distances.empty()) result.farthest = *std::max_element(distances.begin(), distances.end());
  return result;
}

}  // namespace heml
