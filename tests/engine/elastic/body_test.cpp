#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <heml/elastic/body.hpp>
#include <heml/materials/continuum.hpp>
#include <heml/materials/laws.hpp>
#include <heml/mesh/generate.hpp>

#include "support.hpp"

using namespace heml;

namespace {

const char* const law_names[] = {"stvk", "neo_hookean"};

Material material(const char* law) { return {law, {3.1e4, 3.4e3}, 1000}; }

/// A small irregular body, its nodes moved by `noise` of an edge from rest, stretched by F.
struct Fixture {
  TetMesh mesh = make_box(Vec3(0.1, 0.08, 0.06), {3, 2, 2});
  std::vector<double> x;
  Fixture(std::mt19937_64& random, double noise, const Mat3& F = Mat3::Identity(), const Vec3& shift = Vec3::Zero()) {
    for (Vec3& X : mesh.nodes) X += test::random_vector(random, 0.004);
    for (const Vec3& X : mesh.nodes) {
      const Vec3 moved = F * X + shift + test::random_vector(random, noise * 0.03);
      x.insert(x.end(), {moved.x(), moved.y(), moved.z()});
    }
  }
  template <class Real = double>
  ElasticBody<Real> body(const char* law, bool continuation) const {
    return ElasticBody<Real>(mesh, std::vector<int>(mesh.tets.size(), 0), {material(law)}, continuation);
  }
};

std::vector<double> forces(ElasticBody<double>& body, const std::vector<double>& x, int threads = 1) {
  ThreadTeam team(threads);
  std::vector<double> f(x.size());
  body.forces(x.data(), f.data(), team);
  return f;
}

double largest(const std::vector<double>& values) {
  double result = 0;
  for (const double v : values) result = std::max(result, std::abs(v));
  return result;
}

}  // namespace

TEST_CASE("forces are minus the gradient of the energy, through inversion too when continued") {
  std::mt19937_64 random(11);
  for (const char* law : law_names)
    for (const bool continuation : {false, true}) {
      Fixture fixture(random, continuation ? 0.8 : 0.1);
      auto body = fixture.body(law, continuation);
      const auto f = forces(body, fixture.x);
      int inverted = 0;
      std::vector<ElementState<double>> states;
      body.states(fixture.x.data(), states);
      for (const auto& s : states) inverted += s.J <= 0;
      CHECK((inverted > 0) == continuation);
      for (std::size_t i = 0; i < fixture.x.size(); ++i) {
        const double h = 1e-7;
        const auto U = [&](double by) {
          auto x = fixture.x;
          x[i] += by;
          return body.energy(x.data());
        };
        const double slope = (8 * (U(h) - U(-h)) - (U(2 * h) - U(-2 * h))) / (12 * h);
        CHECK(std::abs(f[i] + slope) <= 1e-6 * largest(f));
      }
    }
}

TEST_CASE("tension form equals the form with deformation gradients") {
  std::mt19937_64 random(12);
  for (const char* law : law_names) {
    Fixture fixture(random, 0.15, test::random_gradient(random, 0.6, 2.5));
    auto body = fixture.body(law, false);
    const auto f = forces(body, fixture.x);
    std::vector<double> reference(f.size(), 0.0);
    for (const Tet& tet : fixture.mesh.tets) {
      Mat3 Dm, Ds;
      for (int a = 0; a < 3; ++a) {
        const auto n = static_cast<std::size_t>(tet[static_cast<std::size_t>(a) + 1]),
                   o = static_cast<std::size_t>(tet[0]);
        Dm.col(a) = fixture.mesh.nodes[n] - fixture.mesh.nodes[o];
        Ds.col(a) = Eigen::Map<const Vec3>(&fixture.x[3 * n]) - Eigen::Map<const Vec3>(&fixture.x[3 * o]);
      }
      const Mat3 F = Ds * Dm.inverse();
      Mat3 P;
      with_law<double>(material(law), false, [&](const auto& l) { P = first_piola(l, F); });
      const Mat3 H = -Dm.determinant() / 6 * P * Dm.inverse().transpose();
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
  for (const char* law : law_names) {
    Fixture fixture(random, 0.3);
    auto body = fixture.body(law, true);
    const auto f = forces(body, fixture.x);
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    double scale = 0;
    for (std::size_t n = 0; n < f.size() / 3; ++n) {
      const Vec3 F = Eigen::Map<const Vec3>(&f[3 * n]);
      sum += F;
      moment += Vec3(Eigen::Map<const Vec3>(&fixture.x[3 * n])).cross(F);
      scale += F.norm();
    }
    CHECK(sum.norm() <= 1e-12 * scale);
    CHECK(moment.norm() <= 1e-12 * scale);
  }
}

TEST_CASE("a body turned and carried ten kilometres away feels nothing") {
  std::mt19937_64 random(14);
  for (const char* law : law_names) {
    Fixture fixture(random, 0, test::random_rotation(random), Vec3(1e4, -1e4, 1e4));
    auto body = fixture.body(law, false);
    const double E = engineering_from({3.1e4, 3.4e3}).young, L = 0.1;
    CHECK(largest(forces(body, fixture.x)) <= 1e-9 * E * L * L);
  }
}

TEST_CASE("forces are the same bits for any number of threads") {
  std::mt19937_64 random(15);
  TetMesh mesh = make_box(Vec3(0.1, 0.1, 0.1), {14, 14, 14});
  std::vector<double> x;
  for (const Vec3& X : mesh.nodes)
    for (int i = 0; i < 3; ++i) x.push_back(X[i] + test::uniform(random, -1e-3, 1e-3));
  ElasticBody<double> body(mesh, std::vector<int>(mesh.tets.size(), 0), {material("neo_hookean")}, true);
  const auto one = forces(body, x, 1);
  for (const int threads : {2, 3, 16}) CHECK(forces(body, x, threads) == one);
}

TEST_CASE("float forces agree with double ones to float's precision") {
  std::mt19937_64 random(16);
  for (const char* law : law_names) {
    Fixture fixture(random, 0.2);
    auto exact = fixture.body(law, true);
    auto rough = fixture.body<float>(law, true);
    const auto f = forces(exact, fixture.x);
    const std::vector<float> x(fixture.x.begin(), fixture.x.end());
    std::vector<float> g(x.size());
    ThreadTeam team(1);
    rough.forces(x.data(), g.data(), team);
    for (std::size_t i = 0; i < f.size(); ++i) CHECK(std::abs(f[i] - static_cast<double>(g[i])) <= 1e-5 * largest(f));
  }
}

TEST_CASE("the frequency bound is never below the highest frequency, and near it for regular meshes at rest") {
  std::mt19937_64 random(17);
  for (const char* law : law_names)
    for (const double noise : {-1.0, 0.0, 0.1, 0.5}) {
      Fixture fixture(random, std::max(noise, 0.0),
                      noise > 0.2 ? test::random_gradient(random, 0.4, 2) : Mat3::Identity());
      if (noise < 0) {  // regular, at rest
        fixture.mesh = make_box(Vec3(0.09, 0.06, 0.06), {3, 2, 2});
        for (std::size_t n = 0; n < fixture.mesh.nodes.size(); ++n)
          Eigen::Map<Vec3>(&fixture.x[3 * n]) = fixture.mesh.nodes[n];
      }
      auto body = fixture.body(law, true);
      const auto mass = body.masses();
      // M^-1/2 K M^-1/2 by differences of forces.
      const auto size = static_cast<Eigen::Index>(fixture.x.size());
      Eigen::MatrixXd K(size, size);
      const double h = 1e-7;
      for (Eigen::Index i = 0; i < size; ++i) {
        auto up = fixture.x, down = fixture.x;
        up[static_cast<std::size_t>(i)] += h;
        down[static_cast<std::size_t>(i)] -= h;
        const auto a = forces(body, up), b = forces(body, down);
        for (Eigen::Index j = 0; j < size; ++j) {
          const auto k = static_cast<std::size_t>(j);
          K(j, i) = (b[k] - a[k]) / (2 * h) / std::sqrt(mass[k / 3] * mass[static_cast<std::size_t>(i) / 3]);
        }
      }
      const double highest =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>((K + K.transpose()) / 2).eigenvalues().maxCoeff();
      ThreadTeam team(2);
      const double bound = body.frequency_bound(fixture.x.data(), team);
      CHECK(bound >= highest);
      if (noise < 0) CHECK(bound <= 2 * highest);
      MESSAGE(std::string(law) << ", noise " << noise << ": bound / highest = " << bound / highest);
    }
}

TEST_CASE("an element out of its law's range is found") {
  std::mt19937_64 random(18);
  Fixture fixture(random, 0);
  auto body = fixture.body("neo_hookean", false);
  CHECK(body.first_invalid(fixture.x.data()) == -1);
  // Node 1 of element 7 through the opposite face.
  const Tet& tet = fixture.mesh.tets[7];
  Eigen::Map<Vec3> moved(&fixture.x[3 * static_cast<std::size_t>(tet[1])]);
  moved += 3 * (Eigen::Map<const Vec3>(&fixture.x[3 * static_cast<std::size_t>(tet[0])]) - moved);
  const int first = body.first_invalid(fixture.x.data());
  REQUIRE(first >= 0);
  CHECK(first <= 7);
  std::vector<double> f(fixture.x.size());
  ThreadTeam team(1);
  CHECK_FALSE(body.forces(fixture.x.data(), f.data(), team));
  for (int t = 0; t < first; ++t) {
    const Tet& before = fixture.mesh.tets[static_cast<std::size_t>(t)];
    const auto at = [&](std::size_t c) {
      return Vec3(Eigen::Map<const Vec3>(&fixture.x[3 * static_cast<std::size_t>(before[c])]));
    };
    CHECK(signed_volume(at(0), at(1), at(2), at(3)) > 0);
  }
}

TEST_CASE("stretch and von Mises stress of a pulled bar are those of uniaxial tension") {
  TetMesh mesh = make_box(Vec3(0.1, 0.1, 0.1), {2, 2, 2});
  std::vector<double> x;
  const double t = 1.2, s = 0.93;
  for (const Vec3& X : mesh.nodes) x.insert(x.end(), {t * X.x(), s * X.y(), s * X.z()});
  ElasticBody<double> body(mesh, std::vector<int>(mesh.tets.size(), 0), {material("neo_hookean")}, false);
  std::vector<ElementState<double>> states;
  body.states(x.data(), states);
  const double von_mises = 3.4e3 * (t * t - s * s) / (t * s * s);  // mu (t² − s²)/J
  for (const auto& state : states) {
    CHECK(state.J == doctest::Approx(t * s * s).epsilon(1e-12));
    CHECK(state.stretch == doctest::Approx(t).epsilon(1e-7));
    CHECK(state.von_mises == doctest::Approx(von_mises).epsilon(1e-9));
  }
}
