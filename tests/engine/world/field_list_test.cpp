#include <doctest/doctest.h>

#include <cmath>
#include <heml/world/field_list.hpp>
#include <numeric>
#include <set>

#include "world_support.hpp"

namespace heml::field_list_test {

using namespace test;

namespace {

constexpr double young = 1e4, poisson = 0.3;

/// A block of Saint Venant-Kirchhoff tissue, whose stress is known at an affine map.
std::unique_ptr<World> mapped_block(const Mat3& F, bool single) {
  WorldSetup setup = cantilever("stvk", young);
  setup.materials = {{std::nullopt, soft("stvk", young, poisson)}};
  setup.boundary.clear();  // which would hold nodes at rest
  setup.solver.single_precision = single;
  for (const Vec3& X : setup.mesh.nodes) setup.initial_positions.emplace_back(F * X);
  return make_world(std::move(setup));
}

std::vector<float> values_of(World& world, Field field) {
  std::vector<int> nodes(world.setup().mesh.nodes.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  std::vector<float> values;
  world.write_field(field, nodes, values);
  return values;
}

void check_all(World& world, Field field, double expected, double tolerance) {
  CAPTURE(info(field).name);
  for (const float value : values_of(world, field)) CHECK(std::abs(value - expected) < tolerance);
}

}  // namespace

TEST_CASE("names and titles of fields differ") {
  std::set<std::string_view> names, titles;
  for (const FieldInfo& row : field_list) {
    names.insert(row.name);
    titles.insert(row.title);
    CHECK_FALSE(row.meaning.empty());
  }
  CHECK(names.size() == field_count);
  CHECK(titles.size() == field_count);
}

TEST_CASE("components and principal values are those of the closed form at an affine map") {
  Mat3 F;
  F << 1.2, 0.15, 0, 0.05, 0.9, 0.1, 0, 0.02, 1.05;
  const LameParameters lame = lame_parameters(young, poisson);
  const Mat3 strain = (F.transpose() * F - Mat3::Identity()) / 2;
  const Mat3 S = lame.lambda * strain.trace() * Mat3::Identity() + 2 * lame.mu * strain;
  const Mat3 cauchy = F * S * F.transpose() / F.determinant();
  const Vec3 stresses = Eigen::SelfAdjointEigenSolver<Mat3>(cauchy).eigenvalues(),
             strains = Eigen::SelfAdjointEigenSolver<Mat3>(strain).eigenvalues();
  for (const bool single : {false, true}) {
    const auto world = mapped_block(F, single);
    const double of_stress = young * 2e-5, of_strain = 2e-5;  // values are floats
    check_all(*world, Field::stress_xx, cauchy(0, 0), of_stress);
    check_all(*world, Field::stress_yy, cauchy(1, 1), of_stress);
    check_all(*world, Field::stress_zz, cauchy(2, 2), of_stress);
    check_all(*world, Field::stress_xy, cauchy(0, 1), of_stress);
    check_all(*world, Field::stress_yz, cauchy(1, 2), of_stress);
    check_all(*world, Field::stress_zx, cauchy(2, 0), of_stress);
    check_all(*world, Field::stress_max, stresses[2], of_stress);
    check_all(*world, Field::stress_mid, stresses[1], of_stress);
    check_all(*world, Field::stress_min, stresses[0], of_stress);
    check_all(*world, Field::max_shear, (stresses[2] - stresses[0]) / 2, of_stress);
    check_all(*world, Field::pressure, -stresses.sum() / 3, of_stress);
    check_all(*world, Field::strain_xx, strain(0, 0), of_strain);
    check_all(*world, Field::strain_yy, strain(1, 1), of_strain);
    check_all(*world, Field::strain_zz, strain(2, 2), of_strain);
    check_all(*world, Field::strain_xy, strain(0, 1), of_strain);
    check_all(*world, Field::strain_yz, strain(1, 2), of_strain);
    check_all(*world, Field::strain_zx, strain(2, 0), of_strain);
    check_all(*world, Field::strain_max, strains[2], of_strain);
    check_all(*world, Field::strain_mid, strains[1], of_strain);
    check_all(*world, Field::strain_min, strains[0], of_strain);
    const auto& rest = world->setup().mesh.nodes;
    const Field along[] = {Field::displacement_x, Field::displacement_y, Field::displacement_z};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::vector<float> values = values_of(*world, along[i]);
      for (std::size_t n = 0; n < rest.size(); ++n)
        CHECK(std::abs(values[n] - (F * rest[n] - rest[n])[static_cast<int>(i)]) < 1e-7);
    }
  }
}

}  // namespace heml::field_list_test
