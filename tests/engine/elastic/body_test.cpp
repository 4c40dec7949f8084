#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <heml/elastic/body.hpp>
#include <heml/materials/point.hpp>

#include "small_body.hpp"

namespace heml::body_test {

using test::forces_of;
using test::largest;
using test::law_names;
using test::sample_material;
using test::SmallBody;

TEST_CASE("forces are minus the gradient of the energy, through inversion too when continued") {
  std::mt19937_64 random(11);
  for (const auto law : law_names(true))
    for (const bool continuation : {false, true}) {
      CAPTURE(std::string(law));
      CAPTURE(continuation);
      SmallBody small(random, continuation ? 0.8 : 0.08);
      auto body = small.of(law, continuation);
      int inverted = 0;
      std::vector<ElementState<double>> states;
      body->states(small.x.data(), states);
      for (const auto& s : states) inverted += s.J <= 0;
      CHECK((inverted > 0) == continuation);
      CHECK(test::gradient_error(*body, small.x) <= 1e-6);
    }
}

TEST_CASE("stiffness is minus the gradient of the forces, through inversion too when continued") {
  std::mt19937_64 random(21);
  for (const auto law : law_names(true))
    for (const bool continuation : {false, true}) {
      CAPTURE(std::string(law));
      CAPTURE(continuation);
      SmallBody small(random, continuation ? 0.5 : 0.08);
      auto body = small.of(law, continuation);
      CHECK(test::stiffness_error(*body, small.x, random) <= 1e-5);
    }
}

TEST_CASE("element stiffnesses add up to the stiffness") {
  std::mt19937_64 random(22);
  ThreadTeam team(1);
  for (const auto law : law_names()) {
    CAPTURE(std::string(law));
    SmallBody small(random, 0.1);
    auto body = small.of(law, true);
    std::vector<double> dx(small.x.size()), sum(small.x.size(), 0.0), change(small.x.size());
    for (double& d : dx) d = test::uniform(random, -1, 1);
    body->linearise(small.x.data(), team);
    body->each_stiffness([&](const std::array<int, 4>& node, const ElementMatrix<double>& K) {
      for (std::size_t r = 0; r < 12; ++r)
        for (std::size_t c = 0; c < 12; ++c)
          sum[3 * static_cast<std::size_t>(node[r / 3]) + r % 3] -=
              K[r][c] * dx[3 * static_cast<std::size_t>(node[c / 3]) + c % 3];
    });
    body->force_differential(dx.data(), change.data(), team);
    for (std::size_t i = 0; i < sum.size(); ++i) CHECK(std::abs(sum[i] - change[i]) <= 1e-11 * largest(change));
  }
}

TEST_CASE("tension form equals the form with deformation gradients") {
  std::mt19937_64 random(12);
  for (const auto law : law_names()) {
    CAPTURE(std::string(law));
    SmallBody small(random, 0.1, test::random_gradient(random, 0.7, 1.5));
    auto body = small.of(law, false);
    const auto f = forces_of(*body, small.x);
    const auto point = make_material_point(sample_material(law), false);
    std::vector<double> reference(f.size(), 0.0);
    for (const Tet& tet : small.mesh.tets) {
      Mat3 Dm, Ds;
      for (int a = 0; a < 3; ++a) {
        const auto n = static_cast<std::size_t>(tet[static_cast<std::size_t>(a) + 1]),
                   o = static_cast<std::size_t>(tet[0]);
        Dm.col(a) = small.mesh.nodes[n] - small.mesh.nodes[o];
        Ds.col(a) = Eigen::Map<const Vec3>(&small.x[3 * n]) - Eigen::Map<const Vec3>(&small.x[3 * o]);
      }
      const Mat3 F = Ds * Dm.inverse();
      const Mat3 H = -Dm.determinant() / 6 * point->first_piola(F) * Dm.inverse().transpose();
      for (int a = 0; a < 3; ++a) {
        Eigen::Map<Vec3>(&reference[3 * static_cast<std::size_t>(tet[static_cast<std::size_t>(a) + 1])]) += H.col(a);
        Eigen::Map<Vec3>(&reference[3 * static_cast<std::size_t>(tet[0])]) -= H.col(a);
      }
    }
    for (std::size_t i = 0; i < f.size(); ++i) CHECK(std::abs(f[i] - reference[i]) <= 1e-10 * largest(reference));
  }
}

TEST_CASE("internal forces have no sum and no moment") {
  std::mt19937_64 random(13);
  for (const auto law : law_names()) {
    SmallBody small(random, 0.3);
    auto body = small.of(law, true);
    const auto f = forces_of(*body, small.x);
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    double scale = 0;
    for (std::size_t n = 0; n < f.size() / 3; ++n) {
      const Vec3 F = Eigen::Map<const Vec3>(&f[3 * n]);
      sum += F;
      moment += Vec3(Eigen::Map<const Vec3>(&small.x[3 * n])).cross(F);
      scale += F.norm();
    }
    CHECK(sum.norm() <= 1e-12 * scale);
    CHECK(moment.norm() <= 1e-12 * scale);
  }
}

TEST_CASE("a body turned and carried ten kilometres away feels nothing") {
  std::mt19937_64 random(14);
  for (const auto law : law_names()) {
    SmallBody small(random, 0, test::random_rotation(random), Vec3(1e4, -1e4, 1e4));
    auto body = small.of(law, false);
    if (law.starts_with("paper_")) continue;  // not free of stress at rest
    const double L = 0.1, modulus = small_strain_moduli(sample_material(law)).bulk;
    CHECK(largest(forces_of(*body, small.x)) <= 1e-9 * modulus * L * L);
  }
}

TEST_CASE("forces are the same bits for any number of threads") {
  std::mt19937_64 random(15);
  TetMesh mesh = make_box(Vec3(0.1, 0.1, 0.1), {14, 14, 14});
  std::vector<double> x;
  for (const Vec3& X : mesh.nodes)
    for (int i = 0; i < 3; ++i) x.push_back(X[i] + test::uniform(random, -1e-3, 1e-3));
  const auto body = std::make_unique<ElasticBody<double>>(mesh, std::vector<int>(mesh.tets.size(), 0),
                                                          std::vector{Material{"neo_hookean", {3.1e4, 3.4e3}}},
                                                          BodyOptions{true, false});
  const auto one = forces_of(*body, x, 1);
  for (const int threads : {2, 3, 16}) CHECK(forces_of(*body, x, threads) == one);
}

TEST_CASE("float forces agree with double ones to float's precision") {
  std::mt19937_64 random(16);
  for (const auto law : law_names()) {
    SmallBody small(random, 0.2);
    auto exact = small.of(law, true);
    auto rough = small.of<float>(law, true);
    const auto f = forces_of(*exact, small.x);
    const std::vector<float> x(small.x.begin(), small.x.end());
    std::vector<float> g(x.size());
    ThreadTeam team(1);
    rough->forces(x.data(), g.data(), team);
    for (std::size_t i = 0; i < f.size(); ++i) CHECK(std::abs(f[i] - static_cast<double>(g[i])) <= 1e-5 * largest(f));
  }
}

TEST_CASE("the frequency bound is never below the highest frequency, and near it for regular meshes at rest") {
  std::mt19937_64 random(17);
  for (const auto law : law_names())
    for (const double noise : {-1.0, 0.0, 0.1, 0.5}) {
      SmallBody small(random, std::max(noise, 0.0),
                      noise > 0.2 ? test::random_gradient(random, 0.4, 2) : Mat3::Identity());
      if (noise < 0) {  // regular, at rest
        small.mesh = make_box(Vec3(0.09, 0.06, 0.06), {3, 2, 2});
        for (std::size_t n = 0; n < small.mesh.nodes.size(); ++n)
          Eigen::Map<Vec3>(&small.x[3 * n]) = small.mesh.nodes[n];
      }
      auto body = small.of(law, true);
      const auto mass = body->masses();
      // M^-1/2 K M^-1/2 by differences of forces.
      const auto size = static_cast<Eigen::Index>(small.x.size());
      Eigen::MatrixXd K(size, size);
      const double h = 1e-7;
      for (Eigen::Index i = 0; i < size; ++i) {
        auto up = small.x, down = small.x;
        up[static_cast<std::size_t>(i)] += h;
        down[static_cast<std::size_t>(i)] -= h;
        const auto a = forces_of(*body, up), b = forces_of(*body, down);
        for (Eigen::Index j = 0; j < size; ++j) {
          const auto k = static_cast<std::size_t>(j);
          K(j, i) = (b[k] - a[k]) / (2 * h) / std::sqrt(mass[k / 3] * mass[static_cast<std::size_t>(i) / 3]);
        }
      }
      const double highest =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>((K + K.transpose()) / 2).eigenvalues().maxCoeff();
      ThreadTeam team(2);
      const double bound = body->frequency_bound(small.x.data(), team);
      CHECK(bound >= highest);
      if (noise < 0) CHECK(bound <= 2 * highest);
      MESSAGE(std::string(law) << ", noise " << noise << ": bound / highest = " << bound / highest);
    }
}

TEST_CASE("an element out of its law's range is found") {
  std::mt19937_64 random(18);
  SmallBody small(random, 0);
  auto body = small.of("neo_hookean", false);
  std::vector<double> f(small.x.size());
  ThreadTeam team(1);
  CHECK(body->forces(small.x.data(), f.data(), team));
  // Node 1 of element 7 through the opposite face.
  const Tet& tet = small.mesh.tets[7];
  Eigen::Map<Vec3> moved(&small.x[3 * static_cast<std::size_t>(tet[1])]);
  moved += 3 * (Eigen::Map<const Vec3>(&small.x[3 * static_cast<std::size_t>(tet[0])]) - moved);
  const int first = body->first_undefined(small.x.data());
  REQUIRE(first >= 0);
  CHECK(first <= 7);
  CHECK_FALSE(body->forces(small.x.data(), f.data(), team));
  for (int t = 0; t < first; ++t) {
    const Tet& before = small.mesh.tets[static_cast<std::size_t>(t)];
    const auto at = [&](std::size_t c) {
      return Vec3(Eigen::Map<const Vec3>(&small.x[3 * static_cast<std::size_t>(before[c])]));
    };
    CHECK(signed_volume(at(0), at(1), at(2), at(3)) > 0);
  }
}

TEST_CASE("stretch and von Mises stress of a pulled bar are those of uniaxial tension") {
  TetMesh mesh = make_box(Vec3(0.1, 0.1, 0.1), {2, 2, 2});
  std::vector<double> x;
  const double t = 1.2, s = 0.93;
  for (const Vec3& X : mesh.nodes) x.insert(x.end(), {t * X.x(), s * X.y(), s * X.z()});
  const auto body = std::make_unique<ElasticBody<double>>(mesh, std::vector<int>(mesh.tets.size(), 0),
                                                          std::vector{Material{"neo_hookean", {3.1e4, 3.4e3}}},
                                                          BodyOptions{false, false});
  std::vector<ElementState<double>> states;
  body->states(x.data(), states);
  std::vector<double> ratios;
  body->volume_ratios(x.data(), ratios);
  REQUIRE(ratios.size() == states.size());
  for (std::size_t k = 0; k < states.size(); ++k) CHECK(ratios[k] == states[k].J);
  const double von_mises = 3.4e3 * (t * t - s * s) / (t * s * s);  // mu (t² − s²)/J
  for (const auto& state : states) {
    CHECK(state.J == doctest::Approx(t * s * s).epsilon(1e-12));
    CHECK(state.stretch == doctest::Approx(t).epsilon(1e-7));
    CHECK(state.von_mises == doctest::Approx(von_mises).epsilon(1e-9));
  }
}

}  // namespace heml::body_test
