#pragma once
// A small irregular body of quadratic tetrahedra.
#include <Eigen/Eigenvalues>
#include <heml/mesh/quadratic.hpp>

#include "small_body.hpp"

namespace heml::test {

/// A small irregular body of quadratic elements, displaced from rest. curved: mid-edge nodes beside the edges at rest.
struct QuadraticBody {
  TetMesh mesh = make_box(Vec3(0.1, 0.08, 0.06), {2, 1, 1});
  MidEdges midedges;
  std::vector<double> x;

  QuadraticBody(std::mt19937_64& random, double noise, bool curved = false) {
    for (Vec3& X : mesh.nodes) X += random_vector(random, 0.004);
    const std::size_t corners = mesh.nodes.size();
    midedges = add_midedge_nodes(mesh);
    for (std::size_t n = corners; curved && n < mesh.nodes.size(); ++n) mesh.nodes[n] += random_vector(random, 2e-3);
    for (const Vec3& X : mesh.nodes) {
      const Vec3 moved = X + random_vector(random, noise * 0.03);
      x.insert(x.end(), {moved.x(), moved.y(), moved.z()});
    }
  }
  template <class Real = double>
  std::unique_ptr<ElasticBody<Real>> of(const Material& material, bool continuation = false,
                                        bool mean_dilatation = false) const {
    return std::make_unique<ElasticBody<Real>>(mesh, std::vector<int>(mesh.tets.size(), 0), std::vector{material},
                                               BodyOptions{continuation, mean_dilatation}, midedges);
  }
  Vec3 at(int n) const { return Eigen::Map<const Vec3>(&x[3 * static_cast<std::size_t>(n)]); }
};

/// λ_max(M⁻¹K) at x, 1/s², by a full matrix.
inline double highest_eigenvalue(ElasticBody<double>& body, const std::vector<double>& x) {
  ThreadTeam team(1);
  const auto mass = body.masses();
  const auto size = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixXd K(size, size);
  std::vector<double> unit(x.size(), 0.0), column(x.size());
  body.linearise(x.data(), team);
  for (Eigen::Index j = 0; j < size; ++j) {
    unit[static_cast<std::size_t>(j)] = 1;
    body.force_differential(unit.data(), column.data(), team);
    unit[static_cast<std::size_t>(j)] = 0;
    for (Eigen::Index i = 0; i < size; ++i)
      K(i, j) = -column[static_cast<std::size_t>(i)] /
                std::sqrt(mass[static_cast<std::size_t>(i) / 3] * mass[static_cast<std::size_t>(j) / 3]);
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues()[size - 1];
}

}  // namespace heml::test
