#include <doctest/doctest.h>

#include <heml/dynamics/incremental_potential.hpp>

#include "small_objectives.hpp"
#include "support.hpp"

namespace heml::single_precision_cg_test {

using namespace heml::test;

namespace {

struct Block {
  TetMesh mesh;
  FreeNodes free;
  Vector mass;

  explicit Block(int cells)
      : mesh(make_box(Vec3(1, 1, 1), {cells, cells, cells})),
        free([this] {
          std::vector<bool> free_mask;
          for (const Vec3& X : mesh.nodes) free_mask.push_back(X.x() > 1e-9);
          return free_mask;
        }()),
        mass(Vector::Constant(3 * static_cast<Eigen::Index>(mesh.nodes.size()), 1.0)) {}

  /// Random vector, 0 at nodes that are not free.
  Vector random() const {
    std::mt19937_64 generator(81);
    Vector result = Vector::Zero(mass.size());
    for (const int n : free.node) result.segment<3>(3 * n) = random_vector(generator, 1);
    return result;
  }
  LinearSolver solver(ThreadTeam& team) const {
    return LinearSolver(free, mesh, std::vector<double>(mesh.tets.size(), 1.0), mass, Preconditioner::multilevel,
                        Projection::none, team);
  }
};

/// Springs, and at nodes at x > 1/2 a hold many times as stiff.
class Grasped final : public NodesAndSprings {
 public:
  using NodesAndSprings::NodesAndSprings;
  double curvature(double x) const override { return x > 0.5 ? 1e4 : 0; }
};

}  // namespace

TEST_CASE("a solve in float leaves the residual that was asked for") {
  const Block block(14);
  ThreadTeam team(1);
  NodesAndSprings springs(block.mesh, block.free, 1);
  IncrementalPotential objective(springs, block.mass, block.free);
  objective.set(1e-3, Vector::Zero(block.mass.size()));
  objective.linearise(Vector::Zero(block.mass.size()));
  const Vector r = 1e30 * block.random();  // its square overflows float
  for (const double tolerance : {1e-2, 1e-3, min_float_tolerance, min_float_tolerance / 1.01}) {
    LinearSolver solver = block.solver(team);
    solver.set_inertia(1e-3);
    Vector d, back;
    CHECK(solver.solve(objective, r, tolerance, d));
    objective.product(d, back);
    CHECK((back - r).norm() <= 1.01 * tolerance * r.norm());
    MESSAGE("to " << tolerance << ": " << solver.counts().iterations << " iterations");
  }
}

TEST_CASE("a solve in float sees negative curvature and leads downhill") {
  const Block block(4);
  ThreadTeam team(1);
  Wells wells(block.mesh, block.free, 1e-3);  // concave near 0
  wells.linearise(Vector::Zero(block.mass.size()));
  LinearSolver solver = block.solver(team);
  solver.set_inertia(1);
  const Vector r = block.random();
  Vector d;
  CHECK(!solver.solve(wells, r, 1e-2, d));
  CHECK(d.dot(r) > 0);
}

TEST_CASE("nodes that are held stiffly cost a solve in float few iterations") {
  const Block block(14);
  ThreadTeam team(1);
  Grasped objective(block.mesh, block.free, 1);
  Vector at = Vector::Zero(block.mass.size()), d;
  const auto iterations = [&] {
    objective.linearise(at);
    LinearSolver solver = block.solver(team);
    solver.set_inertia(1e-3);
    CHECK(solver.solve(objective, block.random(), 1e-3, d));
    return solver.counts().iterations;
  };
  const long without = iterations();
  for (const int n : block.free.node)
    if (block.mesh.nodes[static_cast<std::size_t>(n)].x() > 0.999) at.segment<3>(3 * n).setOnes();
  CHECK(iterations() <= without + 2);
}

TEST_CASE("a solve in float gives the same bits with any number of threads") {
  const Block block(24);  // rows enough for three threads in every loop
  NodesAndSprings springs(block.mesh, block.free, 1);
  springs.linearise(Vector::Zero(block.mass.size()));
  Vector first, d;
  for (const int threads : {1, 2, 3, 5}) {
    ThreadTeam team(threads);
    LinearSolver solver = block.solver(team);
    solver.set_inertia(0);
    solver.solve(springs, block.random(), 1e-3, threads == 1 ? first : d);
    if (threads > 1) CHECK(d == first);
  }
}

}  // namespace heml::single_precision_cg_test
