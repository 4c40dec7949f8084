#include <doctest/doctest.h>

#include <cmath>

#include "small_objectives.hpp"

namespace heml::linear_solver_test {
namespace {

/// K = I + 50 (S − Sᵀ) with S the shift by one value round a ring: nearly skew, on which BiCGSTAB hardly gets on.
class NearlySkewRing final : public test::NodesAndSprings {
 public:
  NearlySkewRing(const TetMesh& mesh, const FreeNodes& free) : NodesAndSprings(mesh, free, 0), free_(free) {}
  bool is_symmetric() const override { return false; }
  void product(const Vector& dx, Vector& out) override {
    const Eigen::Index n = dx.size();
    out.setZero(n);
    for (Eigen::Index i = 0; i < n; ++i) out[i] = dx[i] + 50 * (dx[(i + n - 1) % n] - dx[(i + 1) % n]);
  }
  void add_stiffness(BlockMatrix& matrix) override {
    for (const int n : free_.node) matrix.add_node(n, Mat3::Identity());
  }

 private:
  const FreeNodes& free_;
};

}  // namespace

TEST_CASE("BiCGSTAB ends where the residual has stopped falling, with its best iterate") {
  const TetMesh mesh = make_box(Vec3(1, 1, 1), {2, 2, 2});
  const FreeNodes free(std::vector<bool>(mesh.nodes.size(), true));
  const Vector mass = Vector::Constant(3 * static_cast<Eigen::Index>(mesh.nodes.size()), 0.5);
  ThreadTeam team(1);
  LinearSolver solver(free, mesh, std::vector<double>(mesh.tets.size(), 1.0), mass, Preconditioner::block_jacobi,
                      Projection::element, team);
  NearlySkewRing objective(mesh, free);
  objective.linearise(Vector::Zero(mass.size()));
  Vector r(mass.size()), d, Kd;
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const auto x = static_cast<double>(i);
    r[i] = std::cos(3 * x + 0.3 * x * x);
  }
  CHECK(solver.solve(objective, r, 1e-8, d));
  objective.product(d, Kd);
  CHECK((r - Kd).norm() < 0.7 * r.norm());  // the last iterate leaves more than r
  CHECK((r - Kd).norm() > 1e-8 * r.norm());
  CHECK(solver.counts().iterations >= 2 * 50);
  CHECK(solver.counts().iterations < 2 * 250);  // of 2 * 500 that it may take
}

}  // namespace heml::linear_solver_test
