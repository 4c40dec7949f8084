#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <heml/elastic/step_bound.hpp>
#include <heml/elastic/step_weights.hpp>
#include <numeric>

#include "quadratic_body.hpp"
#include "small_body.hpp"

namespace heml::step_weights_test {

using namespace heml::test;

namespace {

std::vector<double> bent(const TetMesh& mesh) {
  std::vector<double> x;
  for (const Vec3& X : mesh.nodes)
    x.insert(x.end(), {X.x() + 3 * X.y() * X.z(), 1.1 * X.y(), X.z() - 2 * X.x() * X.x()});
  return x;
}

struct TwoMaterials {
  TetMesh mesh;
  MidEdges midedges;
  std::vector<int> material_of;
  std::vector<Material> materials{sample_material("neo_hookean"), sample_material("mooney_rivlin")};

  TwoMaterials(TetMesh of, bool quadratic) : mesh(std::move(of)) {
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) material_of.push_back(static_cast<int>(t % 2));
    if (quadratic) midedges = add_midedge_nodes(mesh);
  }
  ElasticBody<double> body() const { return {mesh, material_of, materials, BodyOptions{true, false}, midedges}; }
  /// The largest of the bounds of elements alone.
  double of_elements(ThreadTeam& team) const {
    double largest = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      TetMesh one;
      for (const int n : mesh.tets[t]) one.nodes.push_back(mesh.nodes[static_cast<std::size_t>(n)]);
      one.tets = {{0, 1, 2, 3}};
      one.regions = {0};
      const MidEdges middles = midedges.empty() ? MidEdges{} : add_midedge_nodes(one);
      ElasticBody<double> alone(one, {0}, {materials[static_cast<std::size_t>(material_of[t])]},
                                BodyOptions{true, false}, middles);
      largest = std::max(largest, alone.frequency_bound(bent(one).data(), team));
    }
    return largest;
  }
};

}  // namespace

TEST_CASE_TEMPLATE("step weights: γ is at most 2 % above the largest eigenvalue, of elements of any size and shape",
                   Real, float, double) {
  std::mt19937_64 random(10);
  for (int k = 0; k < 3000; ++k) {
    // From regular ones to slivers, from a tenth of a micrometre to a hundred metres.
    const double size = std::pow(10.0, uniform(random, -7, 2)), flat = std::pow(10.0, uniform(random, -2, 0));
    Mat3 g;  // row a−1: g_a
    do
      for (int i = 0; i < 9; ++i) g(i / 3, i % 3) = uniform(random, -1, 1);
    while (std::abs(g.determinant()) < 0.05);
    g.col(0) /= flat;
    g /= size;
    const Mat3 A = g * g.transpose();
    const Real entries[6] = {Real(A(0, 0)), Real(A(1, 1)), Real(A(2, 2)), Real(A(0, 1)), Real(A(0, 2)), Real(A(1, 2))};
    CornerWeights<Real> weights;
    for (Real& w : weights.w) w = static_cast<Real>(std::pow(10.0, uniform(random, -1, 0)));
    const Vec3 g0 = -g.colwise().sum().transpose();
    Mat3 sum = static_cast<double>(weights.w[0]) * g0 * g0.transpose();
    for (int a = 0; a < 3; ++a) sum += static_cast<double>(weights.w[a + 1]) * g.row(a).transpose() * g.row(a);
    const double exact = Eigen::SelfAdjointEigenSolver<Mat3>(sum).eigenvalues()[2];
    const auto bound = static_cast<double>(max_gradient(entries, weights));
    CHECK(bound >= exact);
    CHECK(bound <= 1.021 * exact);
  }
}

TEST_CASE_TEMPLATE("step weights: γ of regular elements, where all eigenvalues are one but for round-off", Real, float,
                   double) {
  std::mt19937_64 random(12);
  const Mat3 regular = (Mat3() << 1, 1, -1, 1, -1, 1, -1, 1, 1).finished();
  for (int k = 0; k < 10000; ++k) {
    const double size = std::pow(10.0, uniform(random, -7, 2));
    const Mat3 turned = k % 2 == 0 ? Mat3(Mat3::Identity()) : random_rotation(random);
    const Mat3 g = regular / size * turned;
    const Mat3 A = g * g.transpose();
    Real entries[6] = {Real(A(0, 0)), Real(A(1, 1)), Real(A(2, 2)), Real(A(0, 1)), Real(A(0, 2)), Real(A(1, 2))};
    CornerWeights<Real> weights;
    std::fill_n(weights.w, 4, static_cast<Real>(uniform(random, 0.5, 1)));
    const auto round = [&](Real& value) {  // by at most one unit in the last place
      value *= 1 + std::numeric_limits<Real>::epsilon() * static_cast<Real>(static_cast<int>(uniform(random, -2, 2)));
    };
    for (Real& entry : entries) round(entry);
    for (Real& w : weights.w) round(w);
    const double exact = 4 * static_cast<double>(weights.w[0]) / (size * size);
    const auto bound = static_cast<double>(max_gradient(entries, weights));
    CHECK(bound >= exact);
    CHECK(bound <= 1.021 * exact);
  }
}

TEST_CASE("step weights: the factor of a quadratic element is that of its nodes' weights") {
  std::mt19937_64 random(11);
  ThreadTeam team(1);
  TetMesh mesh = irregular_box(random, {3, 2, 2});
  const MidEdges midedges = add_midedge_nodes(mesh);
  BodyLayout<double> layout;
  layout.mesh = virtual_tets(mesh, midedges);
  layout.virtual_corners.emplace(mesh, midedges);
  std::vector<int> points(layout.mesh.tets.size());
  std::iota(points.begin(), points.end(), 0);
  const auto group = make_group<double>(layout.mesh, points, sample_material("neo_hookean"));
  const StepWeights<double> weights = find_step_weights<double>({{&group, 3e3, 2e4}}, layout, team);
  REQUIRE(weights.factor.size() == mesh.tets.size());
  double least = 1, most = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    // uᵀ Σ_q m_q |B_q u less its mean|² u over uᵀ M Z u, in one coordinate.
    Eigen::MatrixXd strained = Eigen::MatrixXd::Zero(10, 10), mass = Eigen::MatrixXd::Zero(10, 10);
    for (std::size_t q = 0; q < element_points; ++q)
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
          for (const auto& a : virtual_corner(q, i))
            for (const auto& b : virtual_corner(q, j))
              strained(static_cast<int>(a.node), static_cast<int>(b.node)) +=
                  a.weight * b.weight * ((i == j ? 1 : 0) - 0.25) / 16;
    const QuadraticNodes& nodes = layout.virtual_corners->nodes_of(t);
    for (int a = 0; a < 10; ++a) {
      const double w = weights.node[static_cast<std::size_t>(nodes[static_cast<std::size_t>(a)])];
      mass(a, a) = (a < 4 ? 1.0 / 36 : 4.0 / 27) / w;
      least = std::min(least, w), most = std::max(most, w);
    }
    const double largest =
        Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(strained, mass).eigenvalues().maxCoeff();
    CHECK(weights.factor[t] == doctest::Approx(largest / frequency_ratio).epsilon(1e-9));
  }
  CHECK(least < 0.7 * most);
}

TEST_CASE("step weights: the bound is between the highest eigenvalue and that of the worst element alone") {
  std::mt19937_64 random(6);
  ThreadTeam team(1);
  for (const bool quadratic : {false, true}) {
    CAPTURE(quadratic);
    const TwoMaterials two(irregular_box(random, {4, 3, 2}), quadratic);
    ElasticBody<double> body = two.body();
    const std::vector<double> x = bent(two.mesh);
    NodeBounds<double> nodes;
    const double bound = body.frequency_bound(x.data(), team, nodes, 0);
    const double highest = highest_eigenvalue(body, x), worst = two.of_elements(team);
    CHECK(bound == nodes.bounds()[nodes.largest_node()]);
    CHECK(bound >= highest);
    CHECK(bound <= 0.75 * worst);
    const auto [element, share] = body.largest_contribution(nodes.largest_node());
    CHECK(element >= 0);
    CHECK((share > 0.05 && share <= 1));
    MESSAGE("bound / highest = " << bound / highest << ", worst element / highest = " << worst / highest);
  }
}

TEST_CASE("step weights: the bound holds where a body stiffens far from what limits it at rest") {
  std::mt19937_64 random(9);
  ThreadTeam team(1);
  for (const bool quadratic : {false, true}) {
    CAPTURE(quadratic);
    TetMesh mesh = irregular_box(random, {4, 3, 2});
    for (Vec3& X : mesh.nodes) X.x() = X.x() < 0.02 ? X.x() : 0.02 + 4 * (X.x() - 0.02);  // small ones at one end
    TwoMaterials two(mesh, quadratic);
    two.materials = {sample_material("fung_demiray"), sample_material("veronda_westmann")};
    ElasticBody<double> body = two.body();
    std::vector<double> x;
    for (const Vec3& X : two.mesh.nodes) x.insert(x.end(), {X.x(), X.y(), X.z()});
    const double at_rest = highest_eigenvalue(body, x);
    for (std::size_t n = 0; n < two.mesh.nodes.size(); ++n)
      if (x[3 * n] > 0.2) x[3 * n] = 0.2 + 2.5 * (x[3 * n] - 0.2);
    const double stretched = highest_eigenvalue(body, x), bound = body.frequency_bound(x.data(), team);
    CHECK(stretched > 4 * at_rest);
    CHECK(bound >= stretched);
    CHECK(bound < 10 * stretched);
    MESSAGE("stretched / at rest = " << stretched / at_rest << ", bound / highest = " << bound / stretched);
  }
}

TEST_CASE("step weights: a sliver in a body hardly raises the bound") {
  std::mt19937_64 random(7);
  ThreadTeam team(1);
  TetMesh mesh = irregular_box(random, {3, 3, 2});
  const auto bound = [&] {
    const TwoMaterials two(mesh, false);
    ElasticBody<double> body = two.body();
    const double value = body.frequency_bound(bent(two.mesh).data(), team);
    CHECK(value >= highest_eigenvalue(body, bent(two.mesh)));
    return std::pair{value, two.of_elements(team)};
  };
  const auto [without, worst_without] = bound();
  // A node close above a face of one element, which becomes four: one of them has a hundredth of its height.
  const Tet whole = mesh.tets[20];
  Vec3 inside = Vec3::Zero();
  const double at[4] = {0.33, 0.33, 0.33, 0.01};
  for (std::size_t a = 0; a < 4; ++a) inside += at[a] * mesh.nodes[static_cast<std::size_t>(whole[a])];
  const int added = static_cast<int>(mesh.nodes.size());
  mesh.nodes.push_back(inside);
  for (std::size_t a = 0; a < 4; ++a) {
    Tet part = whole;
    part[a] = added;
    if (a == 0) {
      mesh.tets[20] = part;
    } else {
      mesh.tets.push_back(part);
      mesh.regions.push_back(mesh.regions[20]);
    }
  }
  const auto [with, worst_with] = bound();
  MESSAGE("bound with the sliver / without = " << with / without
                                               << ", worst element with / without = " << worst_with / worst_without);
  CHECK(worst_with > 50 * worst_without);
  CHECK(with < 10 * without);
}

TEST_CASE("step weights: the same for any number of threads, in float and double") {
  std::mt19937_64 random(8);
  ThreadTeam one(1), three(3);
  for (const bool quadratic : {false, true}) {
    const TwoMaterials two(irregular_box(random, {10, 9, 8}), quadratic);
    ElasticBody<double> a = two.body(), b = two.body();
    CHECK(a.frequency_bound(bent(two.mesh).data(), one) == b.frequency_bound(bent(two.mesh).data(), three));
  }
}

}  // namespace heml::step_weights_test
