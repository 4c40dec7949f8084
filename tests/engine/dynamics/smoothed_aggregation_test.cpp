#include <doctest/doctest.h>

#include <Eigen/SparseCholesky>
#include <heml/dynamics/prolongation.hpp>
#include <heml/dynamics/smoothed_aggregation.hpp>
#include <heml/mesh/generate.hpp>

#include "support.hpp"

namespace heml::smoothed_aggregation_test {

using namespace heml::test;

namespace {

constexpr double inertia = 3600;  // 1/s², of steps of 1/60 s

/// A cube of tissue, 10 cm, n cells per side, with displaced inner nodes; constrained at x = 0, or free.
struct Cube {
  TetMesh mesh;
  FreeNodes free;
  Vector mass;
  std::vector<double> modulus;

  explicit Cube(int n, bool constrained = true, double shaken = 0.2)
      : mesh(shaken_box(n, shaken)), free(free_mask(mesh, constrained)) {
    mass = Vector::Zero(3 * static_cast<Eigen::Index>(mesh.nodes.size()));
    for (const Tet& tet : mesh.tets) {
      const auto X = [&](std::size_t c) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(tet[c])]; };
      for (const int node : tet) mass.segment<3>(3 * node).array() += 1000 * signed_volume(X(0), X(1), X(2), X(3)) / 4;
    }
    modulus.assign(mesh.tets.size(), 4e3);
  }
  static TetMesh shaken_box(int n, double shaken) {
    TetMesh mesh = make_box(Vec3(0.1, 0.1, 0.1), {n, n, n});
    std::mt19937_64 random(5);
    for (Vec3& X : mesh.nodes)
      if (X.minCoeff() > 1e-6 && X.maxCoeff() < 0.1 - 1e-6) X += random_vector(random, shaken * 0.1 / n);
    return mesh;
  }
  static std::vector<bool> free_mask(const TetMesh& mesh, bool constrained) {
    std::vector<bool> result;
    for (const Vec3& X : mesh.nodes) result.push_back(!constrained || X.x() > 1e-9);
    return result;
  }
  /// Multiplies the modulus of the elements with y > 5 cm by a factor.
  void stiffen(double factor) {
    for (std::size_t t = 0; t < modulus.size(); ++t)
      if (mesh.nodes[static_cast<std::size_t>(mesh.tets[t][0])].y() > 0.05) modulus[t] *= factor;
  }
  SmoothedAggregation levels(std::size_t max_direct_unknowns, ThreadTeam& team) const {
    return {free, mesh, modulus, mass, max_direct_unknowns, team};
  }
  ScalarMatrix matrix(double a) const { return a * scalar_mass(free, mass) + scalar_stiffness(free, mesh, modulus); }
  Vector random(std::uint64_t seed) const {
    std::mt19937_64 engine(seed);
    Vector r = Vector::Zero(mass.size());
    for (const int n : free.node) r.segment<3>(3 * n) = random_vector(engine, 1);
    return r;
  }
  /// Applies a scalar operator (A or A⁻¹) to each axis of r.
  template <class Apply>
  Vector by_axes(const Vector& r, const Apply& apply) const {
    Vector z = Vector::Zero(r.size()), one(static_cast<Eigen::Index>(free.node.size()));
    for (int i = 0; i < 3; ++i) {
      for (Eigen::Index k = 0; k < one.size(); ++k) one[k] = r[3 * free.node[static_cast<std::size_t>(k)] + i];
      const Vector result = apply(one);
      for (Eigen::Index k = 0; k < one.size(); ++k) z[3 * free.node[static_cast<std::size_t>(k)] + i] = result[k];
    }
    return z;
  }
};

/// Solves (aM + L) d = r by conjugate gradients to a residual of tolerance ‖r‖. Returns the number of iterations.
int solve(const Cube& cube, double a, SmoothedAggregation& levels, const Vector& r, double tolerance, Vector& d) {
  const ScalarMatrix A = cube.matrix(a);
  Vector left = r, z, p, q;
  d = Vector::Zero(r.size());
  levels.apply(left, z);
  p = z;
  double progress = left.dot(z);
  int count = 0;
  while (count < 100) {
    q = cube.by_axes(p, [&](const Vector& x) { return Vector(A * x); });
    const double step = progress / p.dot(q);
    d += step * p;
    left -= step * q;
    ++count;
    if (left.norm() <= tolerance * r.norm()) break;
    levels.apply(left, z);
    const double next = left.dot(z);
    p = z + next / progress * p;
    progress = next;
  }
  return count;
}

}  // namespace

TEST_CASE("aggregates shrink a mesh by an order of magnitude and carry constants exactly") {
  const Cube cube(8, false);
  const ScalarMatrix P = smoothed_prolongation(scalar_stiffness(cube.free, cube.mesh, cube.modulus));
  CHECK(P.cols() * 8 < P.rows());
  CHECK((P * Vector::Ones(P.cols()) - Vector::Ones(P.rows())).lpNorm<Eigen::Infinity>() <= 1e-12);
}

TEST_CASE("a cycle over levels is symmetric and positive definite, across jumps of stiffness too") {
  ThreadTeam team(1);
  for (const double factor : {1.0, 1e6})
    for (const double a : {0.0, inertia}) {
      Cube cube(8);
      cube.stiffen(factor);
      SmoothedAggregation levels = cube.levels(20, team);
      REQUIRE(levels.levels() >= 2);
      REQUIRE(levels.set_inertia(a));
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const Vector u = cube.random(seed), v = cube.random(100 + seed);
        Vector Bu, Bv;
        levels.apply(u, Bu);
        levels.apply(v, Bv);
        CHECK(std::abs(u.dot(Bv) - v.dot(Bu)) <= 1e-5 * std::sqrt(u.dot(Bu) * v.dot(Bv)));
        CHECK(u.dot(Bu) > 0);
      }
    }
}

TEST_CASE("conjugate gradients on cycles need the same few iterations on a mesh of any size") {
  ThreadTeam team(2);
  for (const double a : {0.0, inertia}) {
    int least = 100, most = 0;
    for (const int n : {5, 10, 20}) {
      const Cube cube(n);
      SmoothedAggregation levels = cube.levels(30, team);
      REQUIRE(levels.levels() >= 2);
      REQUIRE(levels.set_inertia(a));
      Vector d;
      const int count = solve(cube, a, levels, cube.random(3), 1e-8, d);
      MESSAGE("a = " << a << ", " << cube.free.node.size() << " unknowns: " << count << " iterations, "
                     << levels.levels() << " levels");
      least = std::min(least, count);
      most = std::max(most, count);
    }
    CHECK(most <= 13);
    CHECK(most <= least + 4);
  }
}

TEST_CASE("conjugate gradients on cycles end at the solution of a direct solver") {
  ThreadTeam team(1);
  Cube cube(7);
  cube.stiffen(100);
  SmoothedAggregation levels = cube.levels(20, team);
  REQUIRE(levels.set_inertia(inertia));
  const Vector r = cube.random(4);
  Vector d;
  solve(cube, inertia, levels, r, 1e-11, d);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> direct(cube.matrix(inertia));
  const Vector expected = cube.by_axes(r, [&](const Vector& x) { return Vector(direct.solve(x)); });
  CHECK((d - expected).norm() <= 1e-9 * expected.norm());
}

TEST_CASE("a cycle of one level is the exact factor") {
  ThreadTeam team(1);
  const Cube cube(6);
  SmoothedAggregation levels = cube.levels(cube.free.node.size(), team);
  CHECK(levels.levels() == 1);
  REQUIRE(levels.set_inertia(inertia));
  const Vector r = cube.random(6);
  Vector z;
  levels.apply(r, z);
  const ScalarMatrix A = cube.matrix(inertia);
  CHECK((cube.by_axes(z, [&](const Vector& x) { return Vector(A * x); }) - r).norm() <= 1e-5 * r.norm());
}

TEST_CASE("a cycle after a change of inertia is that of levels made for it, to the bit") {
  ThreadTeam team(1);
  const Cube cube(8);
  SmoothedAggregation changed = cube.levels(20, team), fresh = cube.levels(20, team);
  CHECK(changed.set_inertia(inertia));
  CHECK(changed.set_inertia(9 * inertia));
  CHECK(fresh.set_inertia(9 * inertia));
  Vector z, expected;
  changed.apply(cube.random(7), z);
  fresh.apply(cube.random(7), expected);
  CHECK((z.array() == expected.array()).all());
}

TEST_CASE("a cycle gives the same bits with any number of threads") {
  const Cube cube(24);  // rows enough for three threads in every loop
  std::vector<Vector> results;
  for (const int threads : {1, 2, 3, 5}) {
    ThreadTeam team(threads);
    SmoothedAggregation levels = cube.levels(200, team);
    REQUIRE(levels.set_inertia(inertia));
    results.emplace_back();
    levels.apply(cube.random(8), results.back());
  }
  for (const Vector& z : results) CHECK((z.array() == results[0].array()).all());
}

}  // namespace heml::smoothed_aggregation_test
