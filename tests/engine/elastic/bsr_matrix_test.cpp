#include <doctest/doctest.h>

#include <heml/elastic/bsr_matrix.hpp>
#include <numeric>

#include "small_body.hpp"

namespace heml::bsr_matrix_test {

using test::law_names;
using test::SmallBody;

namespace {

/// Row numbers of the nodes; every third node has no row.
std::vector<int> some_rows(std::size_t nodes) {
  std::vector<int> number(nodes, -1);
  int next = 0;
  for (std::size_t n = 0; n < nodes; ++n)
    if (n % 3 != 1) number[n] = next++;
  return number;
}

MultiVector random_triples(std::size_t count, std::mt19937_64& random) {
  MultiVector result(count);
  for (auto& triple : result) triple << test::random_vector(random, 1).cast<float>().array(), 0.0f;
  return result;
}

/// That K of a body at x, between nodes with a row, does what force_differential() does.
void check_products(ElasticBody<double>& body, const std::vector<double>& x, const std::vector<int>& number,
                    BsrMatrix& rows, std::mt19937_64& random) {
  ThreadTeam team(1);
  body.linearise(x.data(), team);
  CHECK(body.assemble(rows, team));
  const MultiVector dx_rows = random_triples(rows.rows(), random);
  MultiVector y(rows.rows());
  rows.multiply(dx_rows, y, team);
  std::vector<double> dx(x.size(), 0.0), change(x.size());
  for (std::size_t n = 0; n < number.size(); ++n)
    for (int i = 0; number[n] >= 0 && i < 3; ++i)
      dx[3 * n + static_cast<std::size_t>(i)] = static_cast<double>(dx_rows[static_cast<std::size_t>(number[n])][i]);
  body.force_differential(dx.data(), change.data(), team);
  for (std::size_t n = 0; n < number.size(); ++n)
    for (int i = 0; number[n] >= 0 && i < 4; ++i) {
      const double expected = i < 3 ? -change[3 * n + static_cast<std::size_t>(i)] : 0;
      const auto row = static_cast<std::size_t>(number[n]);
      CHECK(std::abs(static_cast<double>(y[row][i]) - expected) <= 2e-6 * test::largest(change));
    }
}

}  // namespace

TEST_CASE("products in float equal those of the assembled stiffness, for every law and for springs") {
  std::mt19937_64 random(71);
  for (const auto law : law_names(true)) {
    CAPTURE(std::string(law));
    SmallBody small(random, 0.1);
    const auto body = small.of(law, true);
    const auto number = some_rows(small.mesh.nodes.size());
    BsrMatrix rows(number, small.mesh.tets);
    check_products(*body, small.x, number, rows, random);
  }
}

TEST_CASE("products in float equal those of quadratic elements of two materials") {
  std::mt19937_64 random(76);
  SmallBody small(random, 0);
  const MidEdges midedges = add_midedge_nodes(small.mesh);
  std::vector<std::array<int, 10>> elements;
  std::vector<int> material_of;
  for (std::size_t t = 0; t < small.mesh.tets.size(); ++t) {
    elements.push_back(quadratic_nodes(small.mesh.tets[t], midedges[t]));
    material_of.push_back(t % 3 == 1);
  }
  std::vector<double> x;
  for (const Vec3& X : small.mesh.nodes)
    for (int i = 0; i < 3; ++i) x.push_back(X[i] + test::uniform(random, -1e-3, 1e-3));
  std::vector<int> all(small.mesh.nodes.size());
  std::iota(all.begin(), all.end(), 0);
  const Material iso{"neo_hookean_iso", {500, 5e4}}, mooney{"mooney_rivlin", {1e3, 2e2, 4e4}};
  for (const bool mean_dilatation : {false, true}) {
    BodyOptions options;
    options.nodal_pressure = mean_dilatation;
    const Material first = mean_dilatation ? iso : Material{"neo_hookean", {3.1e4, 3.4e3}};
    ElasticBody<double> body(small.mesh, material_of, {first, mooney}, options, midedges);
    for (const std::vector<int>& number : {some_rows(all.size()), all}) {
      BsrMatrix rows(number, elements);
      check_products(body, x, number, rows, random);
    }
  }
}

TEST_CASE("the matrix is symmetric to the last bit, and no translation strains what nothing holds") {
  std::mt19937_64 random(75);
  ThreadTeam team(1);
  SmallBody small(random, 0.1);
  const auto body = small.of("mooney_rivlin", false);
  body->linearise(small.x.data(), team);
  for (const bool all : {false, true}) {
    std::vector<int> number(small.mesh.nodes.size());
    std::iota(number.begin(), number.end(), 0);
    BsrMatrix rows(all ? number : some_rows(number.size()), small.mesh.tets);
    CHECK(body->assemble(rows, team));
    Eigen::MatrixXf K(3 * rows.rows(), 3 * rows.rows());
    for (int c = 0; c < K.cols(); ++c) {
      MultiVector unit(rows.rows(), Eigen::Array4f::Zero()), y(rows.rows());
      unit[static_cast<std::size_t>(c) / 3][c % 3] = 1;
      rows.multiply(unit, y, team);
      for (std::size_t row = 0; row < rows.rows(); ++row)
        K.col(c).segment<3>(3 * static_cast<int>(row)) = y[row].head<3>();
    }
    CHECK(K == K.transpose());
    for (std::size_t row = 0; row < rows.rows(); ++row)
      CHECK(rows.diagonal_block(row) == K.block<3, 3>(3 * static_cast<int>(row), 3 * static_cast<int>(row)));
    if (!all) continue;
    for (int i = 0; i < 3; ++i) {
      Eigen::VectorXf sum = Eigen::VectorXf::Zero(K.rows());
      for (int c = i; c < K.cols(); c += 3) sum += K.col(c);
      CHECK(sum.cwiseAbs().maxCoeff() < 1e-5f * K.cwiseAbs().maxCoeff());
    }
  }
}

TEST_CASE("a block of two nodes is added with its transpose, and not where a node has no row") {
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{0, 1, 2, 3}};
  BsrMatrix rows({0, -1, 2, 1}, mesh.tets);
  rows.set_zero();
  Mat3 B;
  B << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  rows.add_pair(0, 2, B);
  rows.add_pair(1, 3, B);
  MultiVector x(3, Eigen::Array4f::Zero()), y(3);
  x[0] = {1, 10, 100, 0};
  x[2] = {2, 20, 200, 0};
  ThreadTeam team(1);
  rows.multiply(x, y, team);
  CHECK((y[0] == Eigen::Array4f(642, 1308, 1974, 0)).all());  // B x₂
  CHECK((y[1] == Eigen::Array4f::Zero()).all());
  CHECK((y[2] == Eigen::Array4f(741, 852, 963, 0)).all());  // Bᵀ x₀
}

TEST_CASE("a matrix of averaged nodal pressure is refused") {
  std::mt19937_64 random(72);
  ThreadTeam team(1);
  SmallBody small(random, 0.1);
  const auto body = small.of(Material{"neo_hookean_iso", {500, 5e4}}, true, true);
  BsrMatrix rows(some_rows(small.mesh.nodes.size()), small.mesh.tets);
  body->linearise(small.x.data(), team);
  CHECK(!body->assemble(rows, team));
}

TEST_CASE("the matrix and its products are bit-identical for any number of threads") {
  std::mt19937_64 random(73);
  TetMesh mesh = make_box(Vec3(0.1, 0.1, 0.1), {14, 14, 14});
  std::vector<double> x;
  for (const Vec3& X : mesh.nodes)
    for (int i = 0; i < 3; ++i) x.push_back(X[i] + test::uniform(random, -1e-3, 1e-3));
  ElasticBody<double> body(mesh, std::vector<int>(mesh.tets.size(), 0), {Material{"neo_hookean", {3.1e4, 3.4e3}}},
                           BodyOptions{true, false});
  const auto check = [&](BsrMatrix& rows) {
    const MultiVector in = random_triples(rows.rows(), random);
    MultiVector first(rows.rows()), out(rows.rows());
    for (const int threads : {1, 2, 3, 5, 16}) {
      CAPTURE(threads);
      ThreadTeam team(threads);
      body.linearise(x.data(), team);
      body.assemble(rows, team);
      rows.multiply(in, threads == 1 ? first : out, team);
      for (std::size_t row = 0; threads > 1 && row < rows.rows(); ++row) CHECK((out[row] == first[row]).all());
    }
  };
  std::vector<int> all_rows(mesh.nodes.size());
  std::iota(all_rows.begin(), all_rows.end(), 0);
  BsrMatrix some(some_rows(mesh.nodes.size()), mesh.tets), all(all_rows, mesh.tets);
  check(some);
  check(all);
}

TEST_CASE("a matrix that lost elements has the bits of one made of those left, for any number of threads") {
  std::mt19937_64 random(74);
  TetMesh mesh = make_box(Vec3(0.1, 0.1, 0.1), {12, 12, 12}), less = mesh;
  std::vector<int> kept;
  less.tets.clear();
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (t % 5 == 2) continue;
    kept.push_back(static_cast<int>(t));
    less.tets.push_back(mesh.tets[t]);
  }
  std::vector<double> x;
  for (const Vec3& X : mesh.nodes)
    for (int i = 0; i < 3; ++i) x.push_back(X[i] + test::uniform(random, -1e-3, 1e-3));
  ElasticBody<double> body(less, std::vector<int>(less.tets.size(), 0), {Material{"neo_hookean", {3.1e4, 3.4e3}}},
                           BodyOptions{true, false});
  BsrMatrix cut(some_rows(mesh.nodes.size()), mesh.tets), fresh(some_rows(mesh.nodes.size()), less.tets);
  cut.keep_elements(kept);
  const MultiVector in = random_triples(cut.rows(), random);
  MultiVector of_cut(cut.rows()), of_fresh(cut.rows());
  for (const int threads : {1, 2, 5}) {
    CAPTURE(threads);
    ThreadTeam team(threads);
    body.linearise(x.data(), team);
    for (BsrMatrix* rows : {&cut, &fresh}) {
      body.assemble(*rows, team);
      rows->multiply(in, rows == &cut ? of_cut : of_fresh, team);
    }
    for (std::size_t row = 0; row < cut.rows(); ++row) CHECK((of_cut[row] == of_fresh[row]).all());
  }
}

}  // namespace heml::bsr_matrix_test
