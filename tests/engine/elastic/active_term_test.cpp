// Active stress of muscle: its energy against forces, stiffness and step bound, and a cube that contracts freely.
#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <heml/elastic/body.hpp>

#include "small_body.hpp"

namespace heml::active_term_test {

using test::SmallBody;

namespace {

Material muscle(std::string_view law, double stress) {
  Material material = test::sample_material(law);
  material.fibre = Vec3(2, -1, 2) / 3;
  material.active_stress = stress;
  return material;
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i] - b[i];
  return result;
}

/// Forces of V Ta/2 (|F a0|² − 1) by deformation gradients, of linear tetrahedra: −P g_a V with P = Ta F a0 ⊗ a0.
std::vector<double> active_forces(const TetMesh& mesh, const std::vector<double>& x, double stress,
                                  const std::vector<Vec3>& fibres) {
  std::vector<double> f(x.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Tet& tet = mesh.tets[t];
    Mat3 Dm, Ds;
    for (int a = 0; a < 3; ++a) {
      const auto n = static_cast<std::size_t>(tet[static_cast<std::size_t>(a) + 1]),
                 o = static_cast<std::size_t>(tet[0]);
      Dm.col(a) = mesh.nodes[n] - mesh.nodes[o];
      for (int i = 0; i < 3; ++i)
        Ds(i, a) = x[3 * n + static_cast<std::size_t>(i)] - x[3 * o + static_cast<std::size_t>(i)];
    }
    const Vec3 a0 = fibres[t];
    const Mat3 F = Ds * Dm.inverse(),
               H = -Dm.determinant() / 6 * stress * F * a0 * a0.transpose() * Dm.inverse().transpose();
    for (int a = 0; a < 3; ++a)
      for (int i = 0; i < 3; ++i) {
        f[3 * static_cast<std::size_t>(tet[static_cast<std::size_t>(a) + 1]) + static_cast<std::size_t>(i)] += H(i, a);
        f[3 * static_cast<std::size_t>(tet[0]) + static_cast<std::size_t>(i)] -= H(i, a);
      }
  }
  return f;
}

}  // namespace

TEST_CASE("active stress: forces and stiffness are differences of the energy, with every law") {
  std::mt19937_64 random(3);
  for (const std::string_view law : test::law_names()) {
    CAPTURE(std::string(law));
    SmallBody small(random, 0.05);
    const auto body = small.of(muscle(law, 800), false);
    CHECK(test::gradient_error(*body, small.x) <= 1e-6);
    CHECK(test::stiffness_error(*body, small.x, random) <= 1e-5);
  }
}

TEST_CASE("active stress: what it adds to a law is Ta F a0 ⊗ a0, by every instruction set and in float") {
  std::mt19937_64 random(4);
  ThreadTeam team(1);
  for (const char* law : {"neo_hookean", "guccione", "ogden"}) {
    CAPTURE(std::string(law));
    SmallBody small(random, 0.05);
    const double stress = 5e3;
    Material passive = muscle(law, 0);
    const std::vector<double> expected =
        active_forces(small.mesh, small.x, stress, std::vector<Vec3>(small.mesh.tets.size(), passive.fibre));
    for (const InstructionSet isa : instruction_sets()) {
      std::vector<std::vector<double>> f;
      for (const double Ta : {0.0, stress}) {
        ElasticBody<double> body(small.mesh, std::vector<int>(small.mesh.tets.size(), 0), {muscle(law, Ta)},
                                 BodyOptions{false, false, isa});
        f.push_back(test::forces_of(body, small.x));
      }
      CHECK(test::largest(difference(difference(f[1], f[0]), expected)) <= 1e-11 * test::largest(f[1]));
    }
    const std::vector<float> x(small.x.begin(), small.x.end());
    std::vector<float> with(x.size()), without(x.size());
    small.of<float>(muscle(law, stress), false)->forces(x.data(), with.data(), team);
    small.of<float>(passive, false)->forces(x.data(), without.data(), team);
    for (std::size_t i = 0; i < x.size(); ++i)
      CHECK(std::abs(with[i] - without[i] - expected[i]) <= 1e-4 * test::largest(expected));
  }
}

TEST_CASE("active stress: fibres of a field are those of each element") {
  std::mt19937_64 random(8);
  SmallBody small(random, 0.05);
  std::vector<Vec3> fibres;
  ElementField field{"f", 3, {}};
  for (std::size_t t = 0; t < small.mesh.tets.size(); ++t) {
    fibres.push_back(test::random_vector(random, 1).normalized());
    field.values.insert(field.values.end(), fibres.back().begin(), fibres.back().end());
  }
  small.mesh.fields.push_back(field);
  Material material = muscle("neo_hookean", 0);
  material.fibre = Vec3::Zero();
  material.fibre_field = "f";
  const auto body = small.of(material, false);
  const std::vector<double> passive = test::forces_of(*body, small.x);
  body->set_active_stress(0, 3e3);
  const std::vector<double> active = difference(test::forces_of(*body, small.x), passive);
  const std::vector<double> expected = active_forces(small.mesh, small.x, 3e3, fibres);
  CHECK(test::largest(difference(active, expected)) <= 1e-11 * test::largest(expected));
}

TEST_CASE("active stress: the bound of the step is not below the largest eigenvalue") {
  std::mt19937_64 random(5);
  ThreadTeam team(1);
  for (const char* law : {"neo_hookean", "guccione"}) {
    SmallBody small(random, 0.03);
    const auto body = small.of(muscle(law, 1e8), false);  // far above the law's own stiffness
    const std::vector<double> mass = body->masses();
    const auto size = static_cast<Eigen::Index>(small.x.size());
    Eigen::MatrixXd K(size, size);
    body->linearise(small.x.data(), team);
    std::vector<double> unit(small.x.size()), column(small.x.size());
    for (Eigen::Index j = 0; j < size; ++j) {
      std::fill(unit.begin(), unit.end(), 0.0);
      unit[static_cast<std::size_t>(j)] = 1;
      body->force_differential(unit.data(), column.data(), team);
      for (Eigen::Index i = 0; i < size; ++i)
        K(i, j) = -column[static_cast<std::size_t>(i)] /
                  std::sqrt(mass[static_cast<std::size_t>(i / 3)] * mass[static_cast<std::size_t>(j / 3)]);
    }
    const Eigen::MatrixXd symmetric = (K + K.transpose()) / 2;
    const double highest =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()[size - 1];
    const double bound = body->frequency_bound(small.x.data(), team);
    CHECK(bound >= highest);
    CHECK(bound <= 3 * highest);
  }
}

TEST_CASE("active stress: changed while the body lives it is that of a body made so, and viscosity remembers") {
  std::mt19937_64 random(6);
  SmallBody small(random, 0.05);
  ThreadTeam team(1);
  for (const double viscosity : {0.0, 30.0}) {
    Material material = muscle("guccione", 0);
    material.viscosity = viscosity;
    material.relaxation = {{0.5, 0.1}};
    const auto changed = small.of(material, false);
    changed->begin_step(0.01);
    std::vector<double> there = small.rest();
    for (double& value : there) value += test::uniform(random, -1e-3, 1e-3);
    test::forces_of(*changed, there);
    changed->commit(there.data());
    changed->begin_step(0.01);
    material.active_stress = 4e3;
    const auto made = small.of(material, false);
    made->begin_step(0.01);
    test::forces_of(*made, there);
    made->commit(there.data());  // the same passive history
    made->begin_step(0.01);
    const std::vector<double> before = test::forces_of(*changed, small.x);
    changed->set_active_stress(0, 4e3);
    CHECK(test::forces_of(*changed, small.x) == test::forces_of(*made, small.x));
    changed->set_activation(0.25);
    made->set_active_stress(0, 1e3);
    CHECK(test::forces_of(*changed, small.x) == test::forces_of(*made, small.x));
    const BodySnapshot<double> snapshot = changed->snapshot();
    changed->set_active_stress(0, 0);
    CHECK(test::forces_of(*changed, small.x) == before);
    changed->restore_all(snapshot, small.x.data());
    CHECK(test::forces_of(*changed, small.x) == test::forces_of(*made, small.x));
  }
}

}  // namespace heml::active_term_test
