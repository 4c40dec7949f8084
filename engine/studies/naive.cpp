#include <algorithm>
#include <array>
#include <cassert>
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
  assert(loop_);
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

}  // namespace heml
