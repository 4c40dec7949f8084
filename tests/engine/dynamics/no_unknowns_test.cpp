// Solves without unknowns, since no node is free, or without residual forces.
#include <doctest/doctest.h>

#include <heml/dynamics/incremental_potential.hpp>
#include <heml/dynamics/lbfgs.hpp>
#include <heml/dynamics/prolongation.hpp>
#include <heml/dynamics/scalar_cholesky.hpp>
#include <heml/dynamics/static_solve.hpp>

#include "small_objectives.hpp"

namespace heml::no_unknowns_test {

using namespace heml::test;

namespace {

constexpr Preconditioner every_preconditioner[] = {Preconditioner::cholesky, Preconditioner::scalar,
                                                   Preconditioner::multilevel, Preconditioner::block_jacobi};

struct Body {
  TetMesh mesh = make_box(Vec3(1, 1, 1), {1, 1, 1});
  FreeNodes free;
  Vector mass, zero;
  std::vector<double> moduli = std::vector<double>(mesh.tets.size(), 1.0);
  ThreadTeam team{1};
  explicit Body(bool moves) : free(std::vector<bool>(mesh.nodes.size(), moves)) {
    mass = Vector::Constant(3 * static_cast<Eigen::Index>(mesh.nodes.size()), moves ? 1.0 : 0.0);
    zero = Vector::Zero(mass.size());
  }
};

}  // namespace

TEST_CASE("no unknowns: every linear solver succeeds with every preconditioner") {
  for (const bool moves : {false, true})
    for (const Preconditioner preconditioner : every_preconditioner)
      for (const Projection projection : {Projection::none, Projection::element, Projection::shift}) {
        CAPTURE(static_cast<int>(preconditioner));
        Body body(moves);
        NodesAndSprings springs(body.mesh, body.free, 2);
        IncrementalPotential objective(springs, body.mass, body.free);
        objective.set(3, body.zero);
        LinearSolver linear(body.free, body.mesh, body.moduli, body.mass, preconditioner, projection, body.team);
        linear.set_inertia(3);
        objective.linearise(body.zero);
        Vector d;
        CHECK(linear.solve(objective, body.zero, 1e-6, d));
        CHECK(d == body.zero);
        d.setOnes();
        linear.solve_projected(objective, body.zero, body.zero, d);
        CHECK(d == body.zero);
        if (preconditioner == Preconditioner::cholesky || preconditioner == Preconditioner::block_jacobi) continue;
        d.setOnes();
        CHECK(linear.precondition(body.zero, d));
        CHECK(d == body.zero);
      }
}

TEST_CASE("no unknowns: every preconditioner can be built and applied") {
  Body body(false);
  ScalarCholesky factor;
  MultiVector none;
  CHECK(factor.factor(ScalarMatrix(0, 0)));
  factor.solve(none);
  CHECK(absolute_row_sums(ScalarMatrix(0, 0)).empty());
  const ScalarMatrix P = smoothed_prolongation(ScalarMatrix(0, 0));
  CHECK(P.rows() == 0);
  CHECK(P.cols() == 0);
  for (const std::size_t max_direct_unknowns : {std::size_t{0}, std::size_t{10}}) {
    SmoothedAggregation multilevel(body.free, body.mesh, body.moduli, body.mass, max_direct_unknowns, body.team);
    REQUIRE(multilevel.set_inertia(2));
    Vector z;
    multilevel.apply(Vector::Ones(body.mass.size()), z);
    CHECK(z == body.zero);
    multilevel.apply(none, none);
  }
  NodesAndSprings springs(body.mesh, body.free, 2);
  SinglePrecisionCG in_float(body.free, BsrMatrix(body.free.number, body.mesh.tets), body.team);
  REQUIRE(in_float.assemble(springs, 0.5));
  SmoothedAggregation multilevel(body.free, body.mesh, body.moduli, body.mass, 0, body.team);
  REQUIRE(multilevel.set_inertia(0));
  Vector d;
  long iterations = 0;
  LowRankUpdate update(body.free, body.team);
  update.set(multilevel, {{1, {0, 0, 0, 0}, {Vec3::UnitX()}}});
  CHECK(in_float.solve(multilevel, update, body.zero, 1e-3, 10, d, iterations));
  CHECK(d == body.zero);
}

TEST_CASE("no unknowns: minimisers stay where they are, also where no measure will do") {
  for (const Preconditioner preconditioner : every_preconditioner)
    for (const double limit : {0.0, -1.0})
      for (const bool quasi : {false, true}) {
        if (quasi && (preconditioner == Preconditioner::cholesky || preconditioner == Preconditioner::block_jacobi))
          continue;
        Body body(false);
        NodesAndSprings objective(body.mesh, body.free, 2);
        LinearSolver linear(body.free, body.mesh, body.moduli, body.mass, preconditioner, Projection::element,
                            body.team);
        const StoppingCriterion stop{[](const Vector& r) { return r.norm(); }, limit};
        Vector x = Vector::Ones(body.mass.size());
        const NewtonResult result =
            quasi ? minimise_lbfgs(objective, linear, stop, 5, x) : minimise(objective, linear, stop, {}, x);
        CHECK(result.converged() == (limit == 0));
        CHECK(x == Vector::Ones(body.mass.size()));
      }
}

}  // namespace heml::no_unknowns_test
