#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <heml/dynamics/low_rank_update.hpp>

#include "small_objectives.hpp"
#include "support.hpp"

namespace heml::low_rank_update_test {

using namespace heml::test;

namespace {

/// A cube that is free, but for three held coordinates and, if asked for, its nodes at x = 0.
struct Cube {
  TetMesh mesh;
  FreeNodes free;
  Vector mass;
  std::vector<double> modulus;
  ThreadTeam team{1};

  explicit Cube(int cells, bool constrained = false)
      : mesh(make_box(Vec3(1, 1, 1), {cells, cells, cells})),
        free(is_free(mesh, constrained), {3 * held_node, 3 * held_node + 2}),
        mass(Vector::Constant(3 * static_cast<Eigen::Index>(mesh.nodes.size()), 0.1)),
        modulus(mesh.tets.size(), 10.0) {}

  static constexpr int held_node = 14;  // free in cubes of 3 and of 12 cells
  static std::vector<bool> is_free(const TetMesh& mesh, bool constrained) {
    std::vector<bool> result;
    for (const Vec3& X : mesh.nodes) result.push_back(!constrained || X.x() > 1e-9);
    return result;
  }
  SmoothedAggregation preconditioner() {
    SmoothedAggregation result(free, mesh, modulus, mass, 1000, team);
    REQUIRE(result.set_inertia(1));
    return result;
  }
  /// aM + L for all three axes, 3 #free square.
  Eigen::MatrixXd matrix() const {
    const Eigen::MatrixXd scalar = scalar_mass(free, mass) + scalar_stiffness(free, mesh, modulus);
    Eigen::MatrixXd P = Eigen::MatrixXd::Zero(3 * scalar.rows(), 3 * scalar.cols());
    for (Eigen::Index i = 0; i < scalar.rows(); ++i)
      for (Eigen::Index j = 0; j < scalar.cols(); ++j) P.block<3, 3>(3 * i, 3 * j) = scalar(i, j) * Mat3::Identity();
    return P;
  }
};

/// Terms between one to four nodes of a cube, stiffness 1e4 and less, some of them at its held coordinates, some at
/// nodes that are not free.
std::vector<RankOneTerm> terms_of(const Cube& cube, std::size_t number) {
  std::mt19937_64 random(7);
  std::vector<RankOneTerm> terms;
  const int nodes = static_cast<int>(cube.mesh.nodes.size());
  for (std::size_t k = 0; k < number; ++k) {
    RankOneTerm term{};
    term.count = 1 + static_cast<int>(k % 4);
    for (std::size_t c = 0; c < 4; ++c) {
      term.nodes[c] = (static_cast<int>(5 * k + 7 * c) + (k % 4 == 1 ? Cube::held_node : 0)) % nodes;
      term.g[c] = random_vector(random, k % 3 == 2 ? 1e-3 : 100);
    }
    terms.push_back(term);
  }
  return terms;
}

/// The terms as columns, 3 #free × #terms.
Eigen::MatrixXd columns_of(const Cube& cube, const std::vector<RankOneTerm>& terms) {
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(cube.free.node.size()),
                                            static_cast<Eigen::Index>(terms.size()));
  for (std::size_t t = 0; t < terms.size(); ++t)
    for (std::size_t k = 0; k < static_cast<std::size_t>(terms[t].count); ++k) {
      const int row = cube.free.number[static_cast<std::size_t>(terms[t].nodes[k])];
      if (row < 0) continue;
      Vec3 g = terms[t].g[k];
      if (terms[t].nodes[k] == Cube::held_node) g[0] = g[2] = 0;
      G.block<3, 1>(3 * row, static_cast<Eigen::Index>(t)) += g;
    }
  return G;
}

MultiVector random_rows(std::size_t size) {
  std::mt19937_64 random(9);
  MultiVector result(size);
  for (auto& row : result) row << random_vector(random, 1).cast<float>().array(), 0.0f;
  return result;
}

Eigen::VectorXd flat(const MultiVector& rows) {
  Eigen::VectorXd result(3 * static_cast<Eigen::Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k)
    result.segment<3>(3 * static_cast<Eigen::Index>(k)) = rows[k].head<3>().cast<double>().matrix();
  return result;
}

/// Springs along edges, and terms beside them.
class Pegged final : public NodesAndSprings {
 public:
  Pegged(const Cube& cube, std::vector<RankOneTerm> terms)
      : NodesAndSprings(cube.mesh, cube.free, 1), cube_(cube), terms_(std::move(terms)), G_(columns_of(cube, terms_)) {}
  double curvature(double) const override { return 0.1; }
  void product(const Vector& dx, Vector& out) override {
    NodesAndSprings::product(dx, out);
    Eigen::VectorXd packed(G_.rows());
    for (std::size_t k = 0; k < cube_.free.node.size(); ++k)
      packed.segment<3>(3 * static_cast<Eigen::Index>(k)) = dx.segment<3>(3 * cube_.free.node[k]);
    const Eigen::VectorXd pushed = G_ * (G_.transpose() * packed);
    for (std::size_t k = 0; k < cube_.free.node.size(); ++k)
      out.segment<3>(3 * cube_.free.node[k]) += pushed.segment<3>(3 * static_cast<Eigen::Index>(k));
    cube_.free.clear_held(out);
  }
  void add_rank_one_terms(std::vector<RankOneTerm>& terms) const override {
    terms.insert(terms.end(), terms_.begin(), terms_.end());
  }
  void add_stiffness(BlockMatrix& matrix) override {
    NodesAndSprings::add_stiffness(matrix);
    for (const RankOneTerm& term : terms_)
      for (std::size_t a = 0; a < static_cast<std::size_t>(term.count); ++a) {
        matrix.add_node(term.nodes[a], term.g[a] * term.g[a].transpose());
        for (std::size_t b = 0; b < a; ++b)
          matrix.add_pair(term.nodes[a], term.nodes[b], term.g[a] * term.g[b].transpose());
      }
  }
  void add_coupled_pairs(std::vector<std::array<int, 2>>& pairs) const override {
    for (const RankOneTerm& term : terms_)
      for (std::size_t a = 0; tells_pairs && a < static_cast<std::size_t>(term.count); ++a)
        for (std::size_t b = 0; b < a; ++b) pairs.push_back({term.nodes[a], term.nodes[b]});
  }
  bool tells_pairs = true;

 private:
  const Cube& cube_;
  std::vector<RankOneTerm> terms_;
  Eigen::MatrixXd G_;
};

/// At random, #V·3.
Vector forces_on(const Cube& cube) {
  std::mt19937_64 random(3);
  Vector r = Vector::Zero(cube.mass.size());
  for (const int n : cube.free.node) r.segment<3>(3 * n) = random_vector(random, 1);
  cube.free.clear_held(r);
  return r;
}

/// Pushes single nodes 1e4 times as hard as springs do.
std::vector<RankOneTerm> pegs(const Cube& cube, std::size_t number) {
  std::mt19937_64 random(11);
  std::vector<RankOneTerm> terms;
  for (std::size_t k = 0; k < number; ++k)
    terms.push_back({1, {cube.free.node[3 * k], 0, 0, 0}, {100 * random_vector(random, 1).normalized()}});
  return terms;
}

}  // namespace

TEST_CASE("the update of a preconditioner is the inverse of both together, as a dense matrix has it") {
  for (const bool constrained : {false, true}) {
    Cube cube(3, constrained);
    SmoothedAggregation P = cube.preconditioner();
    const std::vector<RankOneTerm> terms = terms_of(cube, 24);
    const Eigen::MatrixXd G = columns_of(cube, terms), both = cube.matrix() + G * G.transpose();
    LowRankUpdate update(cube.free, cube.team);
    CHECK(update.bytes() == 0);
    update.set(P, terms);
    CHECK(update.bytes() > 24 * 24 * sizeof(double));
    const MultiVector r = random_rows(cube.free.node.size());
    MultiVector z;
    P.apply(r, z);
    MultiVector before = z;
    update.correct(z);
    const Eigen::VectorXd expected = both.ldlt().solve(flat(r));
    CHECK((flat(before) - expected).norm() > 0.3 * expected.norm());
    CHECK((flat(z) - expected).norm() < 2e-3 * expected.norm());  // weak terms are left out
    Vector all = Vector::Zero(cube.mass.size());
    for (std::size_t k = 0; k < r.size(); ++k)
      all.segment<3>(3 * cube.free.node[k]) = before[k].head<3>().cast<double>().matrix();
    update.correct(all);
    double difference = 0;
    for (std::size_t k = 0; k < r.size(); ++k)
      difference += (all.segment<3>(3 * cube.free.node[k]) - z[k].head<3>().cast<double>().matrix()).norm();
    CHECK(difference < 1e-4 * expected.norm());
  }
}

TEST_CASE("the product of rank-one terms is that of their matrix, of either sign, but for held coordinates") {
  Cube cube(3, true);
  SmoothedAggregation P = cube.preconditioner();
  for (const std::size_t number : {24, 5000}) {  // of so many the preconditioner knows the strongest
    std::vector<RankOneTerm> terms = terms_of(cube, number);
    Eigen::VectorXd signs = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(number));
    for (std::size_t k = 0; k < number; k += 8) terms[k].sign = signs[static_cast<Eigen::Index>(k)] = -1;
    LowRankUpdate update(cube.free, cube.team);
    update.set(P, terms);
    const MultiVector p = random_rows(cube.free.node.size());
    MultiVector q(p.size(), Eigen::Array4f::Zero());
    update.add_product(p, q);
    const Eigen::MatrixXd G = columns_of(cube, terms);
    const Eigen::VectorXd expected = G * signs.cwiseProduct(G.transpose() * flat(p));
    CHECK((flat(q) - expected).norm() < 1e-5 * expected.norm());
    MultiVector z;
    P.apply(p, z);
    const double before = flat(p).dot(flat(z));
    update.correct(z);
    CHECK(flat(p).dot(flat(z)) > 0);
    CHECK(flat(p).dot(flat(z)) < 0.9 * before);
  }
}

TEST_CASE("stiff points cost conjugate gradients few iterations, in float and in double") {
  Cube cube(12, true);
  for (const double tolerance : {1e-3, min_float_tolerance / 2}) {  // the second: in double
    long iterations[2];
    for (const std::size_t number : {std::size_t{0}, std::size_t{60}}) {
      Pegged objective(cube, pegs(cube, number));
      objective.linearise(Vector::Zero(cube.mass.size()));
      LinearSolver solver(cube.free, cube.mesh, cube.modulus, cube.mass, Preconditioner::multilevel, Projection::none,
                          cube.team);
      solver.set_inertia(1);
      const Vector r = forces_on(cube);
      Vector d, back;
      CHECK(solver.solve(objective, r, tolerance, d));
      objective.product(d, back);
      CHECK((back - r).norm() <= 1.1 * tolerance * r.norm());
      iterations[number > 0 ? 1 : 0] = solver.counts().iterations;
    }
    MESSAGE("to " << tolerance << ": " << iterations[0] << " iterations, with stiff points " << iterations[1]);
    CHECK(iterations[1] <= 2 * iterations[0]);  // without the update: 61 and 89, instead of 8 and 10
  }
}

TEST_CASE("the exact factor knows what couples nodes that share no element, whatever coupled them before") {
  Cube cube(3, true);
  LinearSolver solver(cube.free, cube.mesh, cube.modulus, cube.mass, Preconditioner::cholesky, Projection::none,
                      cube.team);
  const Vector r = forces_on(cube);
  const auto iterations_with = [&](Pegged& objective) {
    objective.linearise(Vector::Zero(cube.mass.size()));
    const long before = solver.counts().iterations;
    Vector d, back;
    CHECK(solver.solve(objective, r, 1e-9, d));
    objective.product(d, back);
    CHECK((back - r).norm() <= 1e-9 * r.norm());
    return solver.counts().iterations - before;
  };
  Pegged few(cube, terms_of(cube, 8)), many(cube, terms_of(cube, 24)), none(cube, {});
  for (Pegged* objective : {&none, &few, &many, &few, &none}) CHECK(iterations_with(*objective) <= 2);
  many.tells_pairs = false;
  CHECK(iterations_with(many) > 20);
}

TEST_CASE("where more points are stiff than a preconditioner can know, the stiffness is factored, and only there") {
  Cube cube(12, true);
  LinearSolver solver(cube.free, cube.mesh, cube.modulus, cube.mass, Preconditioner::multilevel, Projection::none,
                      cube.team);
  solver.set_inertia(1);
  const Vector r = forces_on(cube);
  Vector once;
  for (const std::size_t number : {0, 40, 600, 40, 600}) {
    CAPTURE(number);
    Pegged objective(cube, terms_of(cube, number));
    objective.linearise(Vector::Zero(cube.mass.size()));
    const long before = solver.counts().iterations;
    Vector d, back;
    CHECK(solver.solve(objective, r, 1e-3, d));
    objective.product(d, back);
    CHECK((back - r).norm() <= 1.1e-3 * r.norm());
    const long iterations = solver.counts().iterations - before;
    CHECK((iterations <= 2) == (number == 600));
    if (number == 600 && once.size() > 0) CHECK(d == once);  // whatever came between
    if (number == 600) once = d;
  }
}

TEST_CASE("an update does not depend on which columns earlier ones have needed, nor on the number of threads") {
  Cube cube(12);
  SmoothedAggregation P = cube.preconditioner();
  const std::vector<RankOneTerm> terms = pegs(cube, 50), others = pegs(cube, 70);
  MultiVector first;
  for (const int threads : {1, 2, 3, 5}) {
    ThreadTeam team(threads);
    for (const bool has_history : {false, true}) {
      LowRankUpdate update(cube.free, team);
      if (has_history) update.set(P, {others.begin() + 30, others.end()});
      update.set(P, terms);
      MultiVector z = random_rows(cube.free.node.size());
      update.correct(z);
      if (first.empty()) first = z;
      CHECK(flat(z) == flat(first));
    }
  }
}

}  // namespace heml::low_rank_update_test
