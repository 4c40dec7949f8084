#include <algorithm>
#include <array>
#include <studies/naive.hpp>

namespace heml {
namespace {

/// Every edge of the mesh once.
std::vector<std::array<int, 2>> edges_of(const TetMesh& mesh) {
  std::vector<std::array<int, 2>> edges;
  for (const Tet& tet : mesh.tets)
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = a + 1; b < 4; ++b) edges.push_back({std::min(tet[a], tet[b]), std::max(tet[a], tet[b])});
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace

NaiveForces::NaiveForces(const TetMesh& mesh, const Material& material, NaiveLoop loop)
    : parameters_(material.parameters), loop_(loop) {
  if (!loop_) point_ = make_material_point(material, false);
  const auto node = [&](int n) { return mesh.nodes[static_cast<std::size_t>(n)]; };
  if (find_law(material.law)->is_continuum) {
    for (const Tet& tet : mesh.tets) {
      Mat3 Dm;
      for (std::size_t a = 0; a < 3; ++a) Dm.col(static_cast<int>(a)) = node(tet[a + 1]) - node(tet[0]);
      const Mat3 inverse = Dm.inverse();
      corners_.insert(corners_.end(), tet.begin(), tet.end());
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) Dm_inverse_.push_back(inverse(i, j));
      volume_.push_back(Dm.determinant() / 6);
    }
  } else {
    for (const auto& edge : edges_of(mesh)) {
      ends_.insert(ends_.end(), edge.begin(), edge.end());
      length_.push_back((node(edge[1]) - node(edge[0])).norm());
    }
  }
  body_ = {mesh.nodes.size(),  volume_.size(),     length_.size(),
           parameters_.size(), corners_.data(),    Dm_inverse_.data(),
           volume_.data(),     parameters_.data(), {material.fibre.x(), material.fibre.y(), material.fibre.z()},
           ends_.data(),       length_.data()};
}

void NaiveForces::operator()(const double* x, double* f) const {
  if (loop_) return loop_(body_, x, f);
  std::fill(f, f + 3 * body_.nodes, 0.0);
  for (std::size_t t = 0; t < body_.tets; ++t) {
    const int* corner = &corners_[4 * t];
    const auto node = [&](int a) { return Eigen::Map<const Vec3>(x + 3 * corner[a]); };
    const Mat3 Dm_inverse = Eigen::Map<const Mat3>(&Dm_inverse_[9 * t]).transpose();
    Mat3 Ds;
    Ds << node(1) - node(0), node(2) - node(0), node(3) - node(0);
    const Mat3 H = -volume_[t] * point_->first_piola(Ds * Dm_inverse) * Dm_inverse.transpose();
    Eigen::Map<Vec3>(f + 3 * corner[0]) -= H.rowwise().sum();
    for (int a = 0; a < 3; ++a) Eigen::Map<Vec3>(f + 3 * corner[a + 1]) += H.col(a);
  }
}

}  // namespace heml
