#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>

#include "small_body.hpp"

namespace heml::nodal_pressure_test {

using test::forces_of;
using test::largest;
using test::sample_material;
using test::SmallBody;

TEST_CASE("averaged nodal pressure: forces and stiffness are derivatives of its energy") {
  std::mt19937_64 random(41);
  for (const char* law : {"neo_hookean_iso", "mooney_rivlin", "ogden", "hgo"})
    for (const VolumeTerm term : {VolumeTerm::quadratic, VolumeTerm::simo_taylor}) {
      CAPTURE(law);
      SmallBody small(random, 0.1);
      Material material = sample_material(law);
      material.volume_term = term;
      auto body = small.of(material, true, true);
      CHECK(test::gradient_error(*body, small.x) <= 1e-6);
      CHECK(test::stiffness_error(*body, small.x, random) <= 1e-5);
    }
}

TEST_CASE("where every element has the same volume ratio, nodal pressure changes nothing") {
  std::mt19937_64 random(42);
  SmallBody small(random, 0, test::random_gradient(random, 0.8, 1.3));
  auto plain = small.of(sample_material("mooney_rivlin"), false);
  auto averaged = small.of(sample_material("mooney_rivlin"), false, true);
  const auto f = forces_of(*plain, small.x), g = forces_of(*averaged, small.x);
  for (std::size_t i = 0; i < f.size(); ++i) CHECK(std::abs(f[i] - g[i]) <= 1e-12 * largest(f));
  ThreadTeam team(1);
  CHECK(averaged->energy(small.x.data(), team) == doctest::Approx(plain->energy(small.x.data(), team)).epsilon(1e-13));
}

TEST_CASE("several materials share nodes: the bulk moduli are averaged there and the forces stay a gradient") {
  std::mt19937_64 random(43);
  SmallBody small(random, 0.1);
  Material soft = sample_material("neo_hookean_iso"), hard = sample_material("mooney_rivlin");
  hard.parameters.back() *= 20;
  std::vector<int> material_of;
  for (std::size_t t = 0; t < small.mesh.tets.size(); ++t) material_of.push_back(t % 3 == 0);
  ElasticBody<double> body(small.mesh, material_of, {soft, hard}, {true, true});
  CHECK(test::gradient_error(body, small.x) <= 1e-6);
  CHECK(test::stiffness_error(body, small.x, random) <= 1e-5);
}

TEST_CASE("stiffness for preconditioners is that of the point of linearise(), whatever is evaluated since") {
  std::mt19937_64 random(45);
  SmallBody small(random, 0.1);
  Material material = sample_material("mooney_rivlin");
  material.volume_term = VolumeTerm::simo_taylor;
  auto body = small.of(material, true, true);
  ThreadTeam team(1);
  const auto stiffness = [&] {
    std::vector<double> all;
    body->each_stiffness([&](const Tet&, const ElementMatrix<double>& K) {
      for (const auto& row : K) all.insert(all.end(), row, row + 12);
    });
    return all;
  };
  forces_of(*body, small.x);
  body->linearise(small.x.data(), team);
  const auto expected = stiffness();
  std::vector<double> trial = small.x, change(small.x.size());
  for (double& x : trial) x *= 1.3;
  body->energy(trial.data(), team);
  CHECK(stiffness() == expected);
  body->force_differential(trial.data(), change.data(), team);
  const auto expected_change = change;
  forces_of(*body, trial);
  body->frequency_bound(trial.data(), team);
  CHECK(stiffness() == expected);
  body->force_differential(trial.data(), change.data(), team);
  CHECK(change == expected_change);
}

TEST_CASE("the frequency bound holds with nodal pressure, and threads change no bit") {
  std::mt19937_64 random(44);
  for (const double noise : {0.0, 0.2}) {
    SmallBody small(random, noise);
    auto body = small.of(sample_material("mooney_rivlin"), true, true);
    const auto mass = body->masses();
    const auto size = static_cast<Eigen::Index>(small.x.size());
    Eigen::MatrixXd K(size, size);
    ThreadTeam team(2);
    body->linearise(small.x.data(), team);
    std::vector<double> unit(small.x.size(), 0.0), column(small.x.size());
    for (Eigen::Index i = 0; i < size; ++i) {
      const auto k = static_cast<std::size_t>(i);
      unit[k] = 1;
      body->force_differential(unit.data(), column.data(), team);
      unit[k] = 0;
      for (std::size_t j = 0; j < column.size(); ++j)
        K(static_cast<Eigen::Index>(j), i) = -column[j] / std::sqrt(mass[j / 3] * mass[k / 3]);
    }
    const double highest =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>((K + K.transpose()) / 2).eigenvalues().maxCoeff();
    CHECK(body->frequency_bound(small.x.data(), team) >= highest);
  }
  SmallBody small(random, 0.1);
  auto body = small.of(sample_material("mooney_rivlin"), true, true);
  const auto one = forces_of(*body, small.x, 1);
  for (const int threads : {2, 5}) CHECK(forces_of(*body, small.x, threads) == one);
}

}  // namespace heml::nodal_pressure_test
