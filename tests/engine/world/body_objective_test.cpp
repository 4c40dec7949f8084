// What implicit methods minimise, as it is kept between steps.
#include <doctest/doctest.h>

#include <heml/world/implicit_state.hpp>
#include <heml/world/simulation.hpp>

#include "world_support.hpp"

namespace heml::body_objective_test {

using namespace heml::test;

namespace {

/// A block under no load, held at x = 0.
WorldSetup block(const Material& material) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(0.1, 0.02, 0.02), {5, 1, 1});
  setup.materials = {{std::nullopt, material}};
  setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })});
  setup.solver.integrator = Integrator::backward_euler;
  setup.solver.threads = 1;
  setup.gravity = Vec3::Zero();
  return setup;
}

Vector stretched(const Simulation<double>& s, double a) {
  Vector x(3 * static_cast<Eigen::Index>(s.model->mesh.nodes.size()));
  for (std::size_t n = 0; n < s.model->mesh.nodes.size(); ++n) {
    const Vec3& X = s.model->mesh.nodes[n];
    x.segment<3>(3 * static_cast<int>(n)) = Vec3(a * X.x(), X.y(), X.z());
  }
  return x;
}

}  // namespace

TEST_CASE("objective: the energy of a muscle follows its activation, at a place where it has been asked for before") {
  Material material = soft("stvk", 1e4, 0);
  material.fibre = Vec3::UnitX();
  material.active_stress = 1800;
  Simulation<double> s(block(material));
  BodyObjective<double>& objective = s.implicit_state().body;
  const Vector x = stretched(s, 1.1);
  std::vector<double> values;
  for (const double activation : {0.0, 0.5, 1.0, 0.5}) {
    s.body.set_activation(activation);
    objective.set_time(0, Vec3::Zero());
    values.push_back(objective.value(x).value());
    CHECK(values.back() == s.body.potential(x.data(), s.team));
  }
  CHECK(values[1] == values[3]);
  CHECK(values[0] != values[1]);
  CHECK(values[1] != values[2]);
}

TEST_CASE("objective: the energy of tissue that remembers is found anew in each step") {
  Material material = soft("neo_hookean", 1e4, 0.3);
  material.viscosity = 200;
  Simulation<double> s(block(material));
  BodyObjective<double>& objective = s.implicit_state().body;
  const Vector x = stretched(s, 1.1);
  s.body.begin_step(0.01);
  objective.set_time(0.01, Vec3::Zero());
  const double moved = objective.value(x).value();
  CHECK(moved == s.body.potential(x.data(), s.team));
  s.body.commit(x.data());
  s.body.begin_step(0.01);
  objective.set_time(0.02, Vec3::Zero());
  const double stayed = objective.value(x).value();
  CHECK(stayed == s.body.potential(x.data(), s.team));
  CHECK(stayed < moved);  // by what flows take on the way
}

TEST_CASE("objective: loads change the value at a place whose elastic energy is known") {
  Simulation<double> s(block(soft("neo_hookean", 1e4, 0.3)));
  BodyObjective<double>& objective = s.implicit_state().body;
  const Vector x = stretched(s, 1.1);
  objective.set_time(0, Vec3::Zero());
  const double elastic = objective.value(x).value();
  objective.set_time(0, Vec3(-9.81, 0, 0));
  double raised = 0;  // kg m
  for (std::size_t n = 0; n < s.masses->lumped.size(); ++n)
    raised += s.masses->heavy()[n] * (x[3 * static_cast<int>(n)] - s.model->mesh.nodes[n].x());
  CHECK(objective.value(x).value() == doctest::Approx(elastic + 9.81 * raised));
}

}  // namespace heml::body_objective_test
