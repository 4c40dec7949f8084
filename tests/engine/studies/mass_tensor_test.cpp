#include <studies/counting_scalar.hpp>
#include <studies/mass_tensor.hpp>

#include "engine/elastic/small_body.hpp"

namespace heml::mass_tensor_test {

using test::largest;
using test::SmallBody;

namespace {

constexpr double lambda = 1.5e3, mu = 1e3;

double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst / largest(b);
}

Operations operations_of_forces(const SmallBody& small, MassTensorSums sums) {
  const MassTensor<CountingScalar> method(small.mesh, lambda, mu, sums);
  const std::vector<CountingScalar> x(small.x.begin(), small.x.end());
  std::vector<CountingScalar> f(x.size());
  return operations_of([&] { method.forces(x.data(), f.data()); });
}

}  // namespace

TEST_CASE("Mass-Tensor forces are HEML's to round-off, turned and strained as far as you like") {
  std::mt19937_64 random(91);
  for (const MassTensorSums sums : {MassTensorSums::as_printed, MassTensorSums::without_zeros})
    for (int trial = 0; trial < 5; ++trial) {
      const SmallBody small(random, 0.3, test::random_gradient(random, 0.5, 1.5));
      Material material = test::sample_material("stvk");
      material.parameters = {lambda, mu};
      auto body = small.of(material, false);
      const MassTensor<double> method(small.mesh, lambda, mu, sums);
      std::vector<double> f(small.x.size());
      method.forces(small.x.data(), f.data());
      CHECK(apart(f, test::forces_of(*body, small.x)) < 1e-11);
    }
}

TEST_CASE("the linear part of Mass-Tensor is HEML's stiffness at rest") {
  std::mt19937_64 random(92);
  const SmallBody small(random, 0.2);
  Material material = test::sample_material("stvk");
  material.parameters = {lambda, mu};
  auto body = small.of(material, false);
  const auto rest = small.rest();
  std::vector<double> displacement(rest.size()), expected(rest.size()), f(rest.size());
  for (std::size_t i = 0; i < rest.size(); ++i) displacement[i] = small.x[i] - rest[i];
  ThreadTeam team(1);
  body->linearise(rest.data(), team);
  body->force_differential(displacement.data(), expected.data(), team);
  MassTensor<double>(small.mesh, lambda, mu, MassTensorSums::without_zeros).linear_forces(small.x.data(), f.data());
  CHECK(apart(f, expected) < 1e-11);
}

TEST_CASE("leaving zeros out changes no force of Mass-Tensor, only how many operations it takes") {
  std::mt19937_64 random(93);
  const SmallBody small(random, 0.2);
  const MassTensor<double> all(small.mesh, lambda, mu, MassTensorSums::as_printed);
  const MassTensor<double> some(small.mesh, lambda, mu, MassTensorSums::without_zeros);
  std::vector<double> f(small.x.size()), g(small.x.size());
  all.forces(small.x.data(), f.data());
  some.forces(small.x.data(), g.data());
  CHECK(apart(f, g) < 1e-14);
  CHECK(some.coefficients() < all.coefficients());

  // Counted by hand. Per neighbour: B 9 ×, 6 +, 3 + to sum. Per pair: 3 + 3 ×, 2 + 2 +, 6 ×, 3 + 3 +. Per triple:
  // 1 + 3 ×, 3 +. Per node: 3 − for its displacement.
  std::vector<std::vector<char>> near(small.mesh.nodes.size(), std::vector<char>(small.mesh.nodes.size(), 0));
  for (const Tet& tet : small.mesh.tets)
    for (const int a : tet)
      for (const int b : tet) near[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] = 1;
  long multiplications = 0, additions = 0;
  for (const auto& row : near) {
    const long m = std::count(row.begin(), row.end(), 1);
    multiplications += 9 * m + 12 * m * m + 4 * m * m * m;
    additions += 3 + 9 * m + 10 * m * m + 3 * m * m * m;
  }
  const Operations counted = operations_of_forces(small, MassTensorSums::as_printed);
  CHECK(counted.multiplications == multiplications);
  CHECK(counted.additions == additions);
  CHECK(operations_of_forces(small, MassTensorSums::without_zeros).multiplications < multiplications);
}

}  // namespace heml::mass_tensor_test
