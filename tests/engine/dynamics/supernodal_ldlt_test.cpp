#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <heml/dynamics/supernodal_ldlt.hpp>
#include <heml/mesh/generate.hpp>
#include <limits>
#include <random>
#include <string>

#include "support.hpp"

namespace heml::supernodal_ldlt_test {

using namespace heml::test;

namespace {

/// Nodes coupled by the pairs of a list, all free.
struct Pattern {
  std::string name;
  std::vector<Vec3> position;
  std::vector<Tet> coupled;
  FreeNodes free;

  Pattern(std::string called, std::vector<Vec3> positions, std::vector<Tet> tets)
      : name(std::move(called)),
        position(std::move(positions)),
        coupled(std::move(tets)),
        free(std::vector<bool>(position.size(), true)) {}
};

std::vector<Vec3> scattered(std::size_t count) {
  std::mt19937_64 engine(count);
  std::vector<Vec3> list(count);
  for (Vec3& x : list) x = random_vector(engine, 1);
  return list;
}

Tet pair(std::size_t a, std::size_t b) {
  const int i = static_cast<int>(a), j = static_cast<int>(b);
  return {i, j, i, j};
}

Pattern box(int cells) {
  const TetMesh mesh = make_box(Vec3(1, 1, 1), {cells, cells, cells});
  return {"box", mesh.nodes, mesh.tets};
}

std::vector<Pattern> patterns() {
  std::vector<Pattern> list;
  list.emplace_back("one node", scattered(1), std::vector<Tet>());
  list.emplace_back("nodes without neighbours", scattered(120), std::vector<Tet>());
  std::vector<Tet> chain, star, all, random, two;
  for (std::size_t n = 1; n < 150; ++n) chain.push_back(pair(n - 1, n));
  list.emplace_back("chain", scattered(150), chain);
  for (std::size_t n = 0; n < 120; ++n)
    if (n != 17) star.push_back(pair(17, n));
  list.emplace_back("a node coupled with all", scattered(120), star);
  for (std::size_t a = 0; a < 110; ++a)
    for (std::size_t b = 0; b < a; ++b) all.push_back(pair(a, b));
  list.emplace_back("all coupled", scattered(110), all);
  std::mt19937_64 engine(3);
  for (int e = 0; e < 280; ++e) random.push_back(pair(engine() % 140, engine() % 140));
  list.emplace_back("random pairs", scattered(140), random);
  for (std::size_t n = 1; n < 150; ++n)
    if (n != 75) two.push_back(pair(n - 1, n)), two.push_back(pair(n - 1 - (n - 1) % 3, n));
  list.emplace_back("parts, all nodes in one place", std::vector<Vec3>(150, Vec3(1, 2, 3)), two);
  list.push_back(box(4));
  return list;
}

/// Random blocks, and diagonals that make it diagonally dominant: positive, or of both signs.
BlockMatrix random_matrix(const Pattern& pattern, bool definite, std::uint64_t seed = 1) {
  BlockMatrix matrix(pattern.free, pattern.coupled);
  std::mt19937_64 engine(seed);
  std::vector<double> sum(pattern.position.size(), 0.5);
  for (std::size_t c = 0; c < pattern.position.size(); ++c)
    for (const int r : matrix.later_neighbours(c)) {
      Mat3 B;
      for (double& entry : B.reshaped()) entry = uniform(engine, -1, 1);
      matrix.add_pair(r, static_cast<int>(c), B);
      sum[c] += 3;
      sum[static_cast<std::size_t>(r)] += 3;
    }
  for (std::size_t n = 0; n < sum.size(); ++n) {
    const double sign = definite || engine() % 2 ? 1 : -1;
    matrix.add_node(static_cast<int>(n), sign * (Mat3::Identity() * sum[n] + Mat3::Constant(0.1)));
  }
  return matrix;
}

Eigen::MatrixXd dense(const BlockMatrix& matrix) {
  return Eigen::MatrixXd(matrix.lower()).selfadjointView<Eigen::Lower>();
}

Eigen::VectorXd random_side(Eigen::Index size) {
  std::mt19937_64 engine(5);
  Eigen::VectorXd b(size);
  for (double& entry : b) entry = uniform(engine, -1, 1);
  return b;
}

}  // namespace

TEST_CASE("solutions, determinants and signs of pivots are those of a dense factor") {
  ThreadTeam team(1);
  for (const Pattern& pattern : patterns())
    for (const bool definite : {true, false}) {
      const BlockMatrix matrix = random_matrix(pattern, definite);
      const Eigen::MatrixXd A = dense(matrix);
      const Eigen::VectorXd b = random_side(A.rows()), expected = A.partialPivLu().solve(b);
      const Eigen::VectorXd eigenvalues = A.selfadjointView<Eigen::Lower>().eigenvalues();
      for (const InstructionSet isa : instruction_sets()) {
        CAPTURE(pattern.name);
        CAPTURE(definite);
        CAPTURE(name_of(isa));
        SupernodalLdlt factor(matrix, pattern.position, isa, team);
        REQUIRE(factor.factor(matrix));
        Eigen::VectorXd x = b;
        factor.solve(x, factor.pivots());
        CHECK((A * x - b).norm() <= 1e-14 * A.norm() * x.norm());
        CHECK((x - expected).norm() <= 1e-12 * x.norm());
        CHECK((factor.pivots().array() > 0).count() == (eigenvalues.array() > 0).count());
        CHECK(factor.pivots().array().abs().log().sum() ==
              doctest::Approx(eigenvalues.array().abs().log().sum()).epsilon(1e-11));
      }
    }
}

TEST_CASE("other divisors replace the pivots") {
  ThreadTeam team(1);
  const Pattern pattern = box(3);
  const BlockMatrix matrix = random_matrix(pattern, false);
  SupernodalLdlt factor(matrix, pattern.position, InstructionSet::best, team);
  REQUIRE(factor.factor(matrix));
  const Eigen::VectorXd b = random_side(factor.pivots().size());
  Eigen::VectorXd x = b, twice = b, positive = b;
  factor.solve(x, factor.pivots());
  factor.solve(twice, 2 * factor.pivots());
  CHECK((x - 2 * twice).norm() <= 1e-13 * x.norm());
  factor.solve(positive, factor.pivots().cwiseAbs());
  CHECK(b.dot(x) < b.dot(positive));
  CHECK(b.dot(positive) > 0);
}

TEST_CASE("the number of threads does not change a bit") {
  const Pattern pattern = box(9);
  const BlockMatrix matrix = random_matrix(pattern, false);
  const Eigen::VectorXd b = random_side(3 * static_cast<Eigen::Index>(pattern.position.size()));
  for (const InstructionSet isa : instruction_sets()) {
    Eigen::VectorXd pivots, x;
    for (const int threads : {1, 2, 3, 5}) {
      CAPTURE(threads);
      ThreadTeam team(threads);
      SupernodalLdlt factor(matrix, pattern.position, isa, team);
      for (int time = 0; time < 2; ++time) {
        REQUIRE(factor.factor(matrix));
        Eigen::VectorXd solution = b;
        factor.solve(solution, factor.pivots());
        if (pivots.size() == 0) {
          pivots = factor.pivots();
          x = solution;
        }
        CHECK(factor.pivots() == pivots);
        CHECK(solution == x);
      }
    }
  }
}

TEST_CASE("a pivot that is zero or not a number is reported, and the next matrix is factored as if it had not been") {
  ThreadTeam team(2);
  const Pattern pattern = box(5);
  const BlockMatrix good = random_matrix(pattern, true);
  SupernodalLdlt factor(good, pattern.position, InstructionSet::best, team);
  REQUIRE(factor.factor(good));
  const Eigen::VectorXd pivots = factor.pivots();
  CHECK_FALSE(factor.factor(BlockMatrix(pattern.free, pattern.coupled)));
  for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const int node : {0, 7, 100, 215}) {
      BlockMatrix bad = random_matrix(pattern, true);
      bad.add_diagonal(node, wrong);
      CHECK_FALSE(factor.factor(bad));
    }
  CHECK(factor.factor(good));
  CHECK(factor.pivots() == pivots);
}

TEST_CASE("no unknowns at all") {
  ThreadTeam team(1);
  const Pattern pattern("none", {}, {});
  const BlockMatrix matrix(pattern.free, pattern.coupled);
  SupernodalLdlt factor(matrix, pattern.position, InstructionSet::best, team);
  CHECK(factor.factor(matrix));
  Eigen::VectorXd nothing(0);
  factor.solve(nothing, factor.pivots());
  CHECK(factor.pivots().size() == 0);
}

TEST_CASE("the memory of a factor grows with the body") {
  ThreadTeam team(1);
  const Pattern small = box(3), large = box(6);
  const SupernodalLdlt a(BlockMatrix(small.free, small.coupled), small.position, InstructionSet::best, team);
  const SupernodalLdlt b(BlockMatrix(large.free, large.coupled), large.position, InstructionSet::best, team);
  CHECK(b.bytes() > 8 * a.bytes());
  CHECK(b.multiplications() > 8 * a.multiplications());
}

}  // namespace heml::supernodal_ldlt_test
