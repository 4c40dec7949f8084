#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <heml/dynamics/backward_euler.hpp>
#include <heml/dynamics/bdf2.hpp>
#include <heml/dynamics/incremental_potential.hpp>
#include <heml/dynamics/lbfgs.hpp>
#include <heml/dynamics/newton.hpp>
#include <heml/dynamics/tr_bdf2.hpp>
#include <random>
#include <utility>

#include "small_objectives.hpp"
#include "support.hpp"

namespace heml::solvers_test {

using namespace heml::test;

namespace {

struct Fixture {
  TetMesh mesh = make_box(Vec3(1, 1, 1), {2, 2, 2});
  FreeNodes free;
  Vector mass;
  mutable ThreadTeam team{1};
  explicit Fixture(int constrained = 3) : free(free_mask(mesh.nodes.size(), constrained)), mass(Vector::Zero(size())) {
    for (const int n : free.node) mass.segment<3>(3 * n).setConstant(0.5);
  }
  static std::vector<bool> free_mask(std::size_t nodes, int constrained) {
    std::vector<bool> result(nodes, true);
    for (int n = 0; n < constrained; ++n) result[static_cast<std::size_t>(5 * n)] = false;
    return result;
  }
  Eigen::Index size() const { return 3 * static_cast<Eigen::Index>(mesh.nodes.size()); }
  std::vector<double> moduli() const { return std::vector<double>(mesh.tets.size(), 1.0); }
  Vector random(double around, double size_of_noise) const {
    std::mt19937_64 engine(7);
    Vector x = Vector::Zero(size());
    for (const int n : free.node) x.segment<3>(3 * n) = random_vector(engine, size_of_noise) + around * Vec3::Ones();
    return x;
  }
  LinearSolver solver(Preconditioner preconditioner) const {
    return {free, mesh, moduli(), mass, preconditioner, Projection::element, team};
  }
};

constexpr Preconditioner every_preconditioner[] = {Preconditioner::cholesky, Preconditioner::scalar,
                                                   Preconditioner::multilevel, Preconditioner::block_jacobi};

StoppingCriterion small_residual(double limit) {
  return {[](const Vector& r) { return r.norm(); }, limit};
}

}  // namespace

TEST_CASE("the assembled matrix is the one its products are of") {
  const Fixture f;
  Wells objective(f.mesh, f.free, 0.3);
  const Vector x = f.random(0.2, 1), dx = f.random(0, 1);
  BlockMatrix matrix(f.free, f.mesh.tets);
  objective.linearise(x);
  objective.add_stiffness(matrix);
  Eigen::MatrixXd full = Eigen::MatrixXd(matrix.lower()).selfadjointView<Eigen::Lower>();
  Vector out, packed(3 * static_cast<Eigen::Index>(f.free.node.size()));
  objective.product(dx, out);
  for (std::size_t k = 0; k < f.free.node.size(); ++k)
    packed.segment<3>(3 * static_cast<int>(k)) = dx.segment<3>(3 * f.free.node[k]);
  const Vector product = full * packed;
  for (std::size_t k = 0; k < f.free.node.size(); ++k)
    CHECK((product.segment<3>(3 * static_cast<int>(k)) - out.segment<3>(3 * f.free.node[k])).norm() <= 1e-13);
}

TEST_CASE("every preconditioner gives the same solution, the exact factor in one iteration") {
  const Fixture f;
  NodesAndSprings springs(f.mesh, f.free, 2);
  IncrementalPotential objective(springs, f.mass, f.free);
  objective.set(3, Vector::Zero(f.size()));
  const Vector x = Vector::Zero(f.size()), r = f.random(0, 1);
  for (const Preconditioner p : every_preconditioner) {
    LinearSolver solver = f.solver(p);
    solver.set_inertia(3);
    Vector d, back;
    objective.linearise(x);
    CHECK(solver.solve(objective, r, 1e-10, d));
    objective.product(d, back);
    CHECK((back - r).norm() <= 1e-9 * r.norm());
    if (p == Preconditioner::cholesky) CHECK(solver.counts().iterations == 1);
  }
}

TEST_CASE("the preconditioner depends on the body's size: full factor, scalar factor, multigrid") {
  CHECK(choose_preconditioner(100, false) == Preconditioner::cholesky);
  CHECK(choose_preconditioner(800, false) == Preconditioner::scalar);
  CHECK(choose_preconditioner(6000, false) == Preconditioner::multilevel);
  CHECK(choose_preconditioner(6000, true) == Preconditioner::cholesky);
  CHECK(choose_preconditioner(60000, true) == Preconditioner::multilevel);
}

TEST_CASE("Newton finds the minimum of a quadratic in one iteration and converges quadratically at a well") {
  const Fixture f;
  LinearSolver solver = f.solver(Preconditioner::cholesky);
  NodesAndSprings springs(f.mesh, f.free, 2);
  Vector x = f.random(0, 1);
  CHECK(minimise(springs, solver, small_residual(1e-9), {}, x).iterations == 1);
  CHECK(x.norm() <= 1e-9);

  Wells wells(f.mesh, f.free, 1e-3);
  for (int n = 0; n < 3; ++n) x.segment<3>(15 * n) = Vec3::Ones();
  for (const int n : f.free.node) x.segment<3>(3 * n).setConstant(1.2);
  const NewtonResult result = minimise(wells, solver, small_residual(1e-10), {}, x);
  CHECK(result.converged());
  CHECK(result.iterations <= 6);
  CHECK(result.projected == 0);
  CHECK((x - Vector::Ones(x.size())).norm() <= 1e-9);
}

TEST_CASE("from a concave start Newton goes downhill to a minimum, with any preconditioner") {
  const Fixture f;
  for (const Preconditioner p : every_preconditioner) {
    CAPTURE(std::string(preconditioner_names[static_cast<std::size_t>(p)]));
    LinearSolver solver = f.solver(p);
    Wells wells(f.mesh, f.free, 0.01);
    Vector x = f.random(0, 0.3);
    const double before = *wells.value(x);
    const NewtonResult result = minimise(wells, solver, small_residual(1e-10), {}, x);
    CHECK(result.converged());
    CHECK(*wells.value(x) < before);
    for (const int n : f.free.node)
      for (int i = 0; i < 3; ++i) CHECK(std::abs(x[3 * n + i]) > 0.5);  // no node stays at the maximum
  }
}

TEST_CASE("stops with what it has when iterations run out") {
  const Fixture f;
  LinearSolver solver = f.solver(Preconditioner::cholesky);
  Wells wells(f.mesh, f.free, 0.01);
  Vector x = f.random(0, 0.3);
  const double before = *wells.value(x);
  const NewtonResult result = minimise(wells, solver, small_residual(1e-10), {2, 1e-2}, x);
  CHECK(result.status == NewtonResult::Status::out_of_iterations);
  CHECK(result.iterations == 2);
  CHECK(*wells.value(x) < before);
}

TEST_CASE("a solve that is interrupted ends after the iteration under way, with what it has") {
  const Fixture f;
  LinearSolver solver = f.solver(Preconditioner::scalar);
  Wells wells(f.mesh, f.free, 0.01);
  for (const bool quasi_newton : {false, true}) {
    Vector x = f.random(0, 0.3);
    const double before = *wells.value(x);
    std::atomic<bool> interrupted{false};
    int asked = 0;
    StoppingCriterion stop = small_residual(1e-10);
    stop.measure = [&](const Vector& r) {
      interrupted = ++asked == 3;
      return r.norm();
    };
    stop.interrupted = &interrupted;
    const NewtonResult result =
        quasi_newton ? minimise_lbfgs(wells, solver, stop, 60, x) : minimise(wells, solver, stop, {}, x);
    CHECK(result.status == NewtonResult::Status::out_of_iterations);
    CHECK(result.iterations == 2);
    CHECK(*wells.value(x) < before);
  }
}

/// Springs with noise in the forces, as of round-off.
class Blurred final : public NodesAndSprings {
 public:
  using NodesAndSprings::NodesAndSprings;
  bool residual(const Vector& x, Vector& r) override {
    NodesAndSprings::residual(x, r);
    for (Eigen::Index i = 0; i < r.size(); ++i)
      if (r[i] != 0 && !sharp_) r[i] += 1e-4 * std::uniform_real_distribution(-1.0, 1.0)(engine_);
    return true;
  }
  double value_round_off() const override { return sharp_ ? 1e-14 : 1; }
  bool is_at_round_off(const Vector& r) const override { return r.norm() < 1e-2; }
  bool refine_precision() override { return may_refine && !std::exchange(sharp_, true); }
  bool is_refined() const { return sharp_; }

  bool may_refine = false;

 private:
  std::mt19937_64 engine_{11};
  bool sharp_ = false;
};

TEST_CASE("where forces are round-off Newton ends soon, with the best it saw there") {
  const Fixture f;
  LinearSolver solver = f.solver(Preconditioner::cholesky);
  Blurred springs(f.mesh, f.free, 2);
  std::vector<double> seen;
  const StoppingCriterion stop{[&](const Vector& r) { return seen.emplace_back(r.norm()); }, 1e-12};
  Vector x = f.random(0, 1);
  const NewtonResult result = minimise(springs, solver, stop, {}, x);
  CHECK(result.status == NewtonResult::Status::stalled);
  CHECK(result.at_round_off);
  CHECK(result.iterations < 12);
  CHECK(result.measure == *std::min_element(seen.begin(), seen.end()));
  CHECK(seen.back() > result.measure);  // the best state was not the last
}

TEST_CASE("where forces are round-off Newton goes on with more precise ones, and where it can do without it does") {
  const Fixture f;
  LinearSolver solver = f.solver(Preconditioner::cholesky);
  for (const double limit : {1e-12, 1e-2}) {
    CAPTURE(limit);
    Blurred springs(f.mesh, f.free, 2);
    springs.may_refine = true;
    Vector x = f.random(0, 1);
    const NewtonResult result = minimise(springs, solver, small_residual(limit), {}, x);
    CHECK(result.converged());
    CHECK(result.iterations < 8);
    CHECK(springs.is_refined() == (limit < 1e-4));
  }
}

TEST_CASE("stages of each method have its order on a damped oscillator, also when the step changes") {
  // x'' = −ω² x − α v: each stage is linear, x = (a y)/(a + ω²).
  const double omega = 3, alpha = 0.4, end = 1;
  const auto solve = [&](const Stage& stage, Vector& x, Vector& v) {
    const double a = stage.a(alpha);
    x = a / (a + omega * omega) * stage.y(alpha);
    v = stage.velocity(x);
  };
  const auto run = [&](int method, int steps) {
    Vector x = Vector::Ones(1), v = Vector::Zero(1), x_before, v_before;
    double h_before = 0;
    for (int k = 0; k < steps; ++k) {
      const double h = end / steps * (k % 2 ? 1.3 : 0.7);
      Vector x_next = x, v_next = v;
      if (method == 1) {
        solve(backward_euler_stage(x, v, h), x_next, v_next);
      } else if (method == 2 && h_before > 0) {
        solve(bdf2_stage(x, v, x_before, v_before, h, h_before), x_next, v_next);
      } else {
        solve(tr_bdf2::first_stage(x, v, -omega * omega * x - alpha * v, h), x_next, v_next);
        const Vector x_gamma = x_next, v_gamma = v_next;
        solve(tr_bdf2::second_stage(x, v, x_gamma, v_gamma, h), x_next, v_next);
      }
      x_before = x, v_before = v, h_before = h;
      x = x_next, v = v_next;
    }
    return std::pair(x[0], v[0]);
  };
  const double w = std::sqrt(omega * omega - alpha * alpha / 4);
  const double x_exact = std::exp(-alpha / 2 * end) * (std::cos(w * end) + alpha / (2 * w) * std::sin(w * end));
  const double v_exact = -std::exp(-alpha / 2 * end) * omega * omega / w * std::sin(w * end);
  for (const int method : {1, 2, 3}) {
    const auto coarse = run(method, 200), fine = run(method, 400);
    const double order = method == 1 ? 1 : 2;
    const auto error = [&](const std::pair<double, double>& end_state) {
      return std::hypot(omega * (end_state.first - x_exact), end_state.second - v_exact);
    };
    CHECK(std::log2(error(coarse) / error(fine)) == doctest::Approx(order).epsilon(0.05));
  }
}

}  // namespace heml::solvers_test
