// Mean dilatation of quadratic elements: derivatives, bounds, and what it leaves as it is.
#include <doctest/doctest.h>

#include "quadratic_body.hpp"

namespace heml::mean_dilatation_test {

using test::largest;
using test::QuadraticBody;
using test::sample_material;

/// Laws with a volume term of their own, near Poisson's ratio 0.5.
std::vector<Material> nearly_incompressible() {
  std::vector<Material> result;
  for (const LawInfo& law : laws())
    if (law.has_volume_term) result.push_back(sample_material(law, {1e3, 5e5}));
  REQUIRE(result.size() >= 5);
  return result;
}

std::vector<double> homogeneous(const TetMesh& mesh, const Mat3& F) {
  std::vector<double> x;
  for (const Vec3& X : mesh.nodes) {
    const Vec3 moved = F * X + Vec3(1, 2, 3);
    x.insert(x.end(), {moved.x(), moved.y(), moved.z()});
  }
  return x;
}

TEST_CASE("mean dilatation: forces are minus the gradient of the energy, stiffness that of the forces") {
  std::mt19937_64 random(41);
  for (Material material : nearly_incompressible())
    for (const VolumeTerm term : {VolumeTerm::quadratic, VolumeTerm::logarithmic, VolumeTerm::simo_taylor}) {
      CAPTURE(material.law);
      material.volume_term = term;
      const QuadraticBody small(random, 0.05, true);
      auto body = small.of(material, false, true);
      CHECK(test::gradient_error(*body, small.x) <= 1e-6);
      CHECK(test::stiffness_error(*body, small.x, random) <= 1e-5);
    }
}

TEST_CASE("mean dilatation: stiffnesses of the elements add up to the stiffness, projected or not") {
  std::mt19937_64 random(42);
  ThreadTeam team(1);
  const QuadraticBody small(random, 0.1);
  Material material = sample_material(*find_law("neo_hookean_iso"), {1e3, 5e5});
  material.volume_term = VolumeTerm::logarithmic;
  for (const Projection projection : {Projection::none, Projection::element, Projection::tension}) {
    auto body = small.of(material, false, true);
    std::vector<double> dx(small.x.size()), sum(small.x.size(), 0.0), change(small.x.size());
    for (double& d : dx) d = test::uniform(random, -1, 1);
    body->linearise(small.x.data(), team);
    body->project(projection, team);
    body->each_stiffness([&](const auto& node, const auto& K) {
      for (std::size_t r = 0; r < 3 * node.size(); ++r)
        for (std::size_t c = 0; c < 3 * node.size(); ++c)
          sum[3 * static_cast<std::size_t>(node[r / 3]) + r % 3] -=
              K[r][c] * dx[3 * static_cast<std::size_t>(node[c / 3]) + c % 3];
    });
    body->force_differential(dx.data(), change.data(), team);
    double work = 0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
      CHECK(std::abs(sum[i] - change[i]) <= 1e-11 * largest(change));
      work -= dx[i] * change[i];
    }
    if (projection != Projection::none) CHECK(work > 0);
  }
}

TEST_CASE("mean dilatation: a homogeneous deformation has the energy and forces of p2") {
  std::mt19937_64 random(43);
  ThreadTeam team(1);
  for (const Material& material : nearly_incompressible()) {
    CAPTURE(material.law);
    const QuadraticBody small(random, 0);
    const auto x = homogeneous(small.mesh, test::random_gradient(random, 0.9, 1.1));
    auto plain = small.of(material), mean = small.of(material, false, true);
    std::vector<double> f(x.size()), g(x.size());
    plain->forces(x.data(), f.data(), team);
    mean->forces(x.data(), g.data(), team);
    for (std::size_t i = 0; i < f.size(); ++i) CHECK(std::abs(f[i] - g[i]) <= 1e-9 * largest(f));
    CHECK(mean->energy(x.data(), team) == doctest::Approx(plain->energy(x.data(), team)).epsilon(1e-9));
    const auto P = plain->stresses(x.data(), team), Q = mean->stresses(x.data(), team);
    for (std::size_t k = 0; k < P.size(); ++k) CHECK((P[k] - Q[k]).norm() <= 1e-9 * P[k].norm());
  }
}

TEST_CASE("mean dilatation: up to Poisson's ratio 0.3 elements are those of p2") {
  std::mt19937_64 random(44);
  ThreadTeam team(1);
  const QuadraticBody small(random, 0.05);
  for (const auto& [bulk, same] : {std::pair{2.1e3, true}, std::pair{2.3e3, false}}) {
    const Material material = sample_material(*find_law("neo_hookean_iso"), {1e3, bulk});
    std::vector<double> f(small.x.size()), g(small.x.size());
    small.of(material)->forces(small.x.data(), f.data(), team);
    small.of(material, false, true)->forces(small.x.data(), g.data(), team);
    CHECK((f == g) == same);
  }
}

TEST_CASE("mean dilatation: a linear dilatation within an element costs what Poisson's ratio 0.3 says") {
  ThreadTeam team(1);
  std::mt19937_64 random(45);
  QuadraticBody small(random, 0);
  small.mesh.tets.resize(1);
  small.midedges.resize(1);
  Vec3 centre = Vec3::Zero();
  for (const int n : small.mesh.tets[0]) centre += small.mesh.nodes[static_cast<std::size_t>(n)] / 4;
  // A conformal field: dilatation 3 ε a·r, no change of shape
  const Vec3 a(1, 0.5, -0.3);
  for (std::size_t n = 0; n < small.mesh.nodes.size(); ++n) {
    const Vec3 r = small.mesh.nodes[n] - centre;
    Eigen::Map<Vec3>(&small.x[3 * n]) = small.mesh.nodes[n] + 1e-3 * (a.dot(r) * r - r.squaredNorm() / 2 * a);
  }
  const auto energy = [&](double bulk, bool mean) {
    return small.of(sample_material(*find_law("neo_hookean_iso"), {1e3, bulk}), false, mean)
        ->energy(small.x.data(), team);
  };
  CHECK(energy(5e5, true) == doctest::Approx(energy(13e3 / 6, false)).epsilon(1e-3));
  CHECK(energy(5e5, false) > 50 * energy(5e5, true));
}

TEST_CASE("mean dilatation: the frequency bound bounds the highest eigenvalue, and not by much") {
  std::mt19937_64 random(46);
  ThreadTeam team(1);
  for (const Material& material : nearly_incompressible()) {
    CAPTURE(material.law);
    const QuadraticBody small(random, 0.03, true);
    auto body = small.of(material, false, true);
    const double highest = test::highest_eigenvalue(*body, small.x),
                 bound = body->frequency_bound(small.x.data(), team);
    CHECK(bound >= highest);
    CHECK(bound <= 4 * highest);
  }
}

TEST_CASE("mean dilatation: moduli from fields are split element by element, in both precisions") {
  std::mt19937_64 random(47);
  ThreadTeam team(1), many(3);
  QuadraticBody small(random, 0.05);
  Material material = sample_material(*find_law("neo_hookean_iso"), {1e3, 5e5});
  auto uniform = small.of(material, false, true);
  for (std::size_t k = 0; k < 2; ++k) {
    material.fields.push_back({k, k == 0 ? "a" : "b"});
    small.mesh.fields.push_back(
        {k == 0 ? "a" : "b", 1, std::vector<double>(small.mesh.tets.size(), material.parameters[k])});
  }
  auto varied = small.of(material, false, true);
  auto single = small.of<float>(material, false, true);
  std::vector<double> f(small.x.size()), g(small.x.size());
  uniform->forces(small.x.data(), f.data(), many);
  varied->forces(small.x.data(), g.data(), team);
  const std::vector<float> x(small.x.begin(), small.x.end());
  std::vector<float> h(x.size());
  single->forces(x.data(), h.data(), team);
  for (std::size_t i = 0; i < f.size(); ++i) {
    CHECK(std::abs(f[i] - g[i]) <= 1e-11 * largest(f));
    CHECK(std::abs(f[i] - static_cast<double>(h[i])) <= 1e-3 * largest(f));
  }
}

TEST_CASE("mean dilatation: of one modulus from a field the other is split as well") {
  std::mt19937_64 random(49);
  ThreadTeam team(1);
  QuadraticBody small(random, 0.05);
  Material material = sample_material(*find_law("neo_hookean_iso"), {1e3, 5e5});
  std::vector<double> expected(small.x.size()), f(small.x.size());
  small.of(material, false, true)->forces(small.x.data(), expected.data(), team);
  for (std::size_t k = 0; k < 2; ++k) {
    CAPTURE(k);
    material.fields = {{k, "modulus"}};
    small.mesh.fields = {{"modulus", 1, std::vector<double>(small.mesh.tets.size(), material.parameters[k])}};
    auto varied = small.of(material, false, true);
    const auto check = [&] {
      varied->forces(small.x.data(), f.data(), team);
      for (std::size_t i = 0; i < f.size(); ++i) CHECK(std::abs(f[i] - expected[i]) <= 1e-11 * largest(expected));
    };
    check();
    varied->restore(varied->snapshot(), small.x.data());
    check();
  }
}

TEST_CASE("mean dilatation: a flattened element is outside the range of a logarithm") {
  std::mt19937_64 random(48);
  ThreadTeam team(1);
  const QuadraticBody small(random, 0);
  Material material = sample_material(*find_law("neo_hookean_iso"), {1e3, 5e5});
  material.volume_term = VolumeTerm::logarithmic;
  const auto x = homogeneous(small.mesh, Vec3(1, 1, -1e-3).asDiagonal());
  std::vector<double> f(x.size());
  CHECK_FALSE(small.of(material, false, true)->forces(x.data(), f.data(), team));
  CHECK(small.of(material, true, true)->forces(x.data(), f.data(), team));
}

}  // namespace heml::mean_dilatation_test
