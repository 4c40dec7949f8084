#include <doctest/doctest.h>

#include <heml/mesh/generate.hpp>
#include <studies/problem.hpp>
#include <studies/sample_motion.hpp>

namespace heml::problem_test {

namespace {
Problem block() {
  return problem_of(parse_scene(R"({
    "schema_version": 1, "name": "block",
    "mesh": {"box": {"size": [0.2, 0.1, 0.1], "cells": [2, 1, 1]}},
    "materials": [{"law": "stvk", "young": 1e4, "poisson": 0.3, "density": 500}],
    "boundary": [{"box": [[0, -1, -1], [0, 1, 1]], "fix": true}],
    "loads": [{"box": [[0.2, -1, -1], [1, 1, 1]], "traction": [1, 0, 0]}],
    "solver": {"rate": 100, "duration": 0.1},
    "events": [{"at": 0.05, "remove": {"tets": [3]}}, {"at": 0.07, "grasp": {"point": [0.2, 0.1, 0.1]}}]
  })",
                                "folder/scene.json"));
}
}  // namespace

TEST_CASE("a finer problem has the same constrained and loaded faces, mass and removals") {
  const Problem coarse = block(), fine = finer(coarse);
  CHECK(fine.setup.mesh.tets.size() == 8 * coarse.setup.mesh.tets.size());
  CHECK(fine.setup.boundary[0].nodes.size() == 9);  // a square of 3 × 3
  for (const int node : fine.setup.boundary[0].nodes)
    CHECK(fine.setup.mesh.nodes[static_cast<std::size_t>(node)].x() == 0);
  CHECK(fine.setup.loads[0].nodes.size() == 9);
  double mass = 0, fine_mass = 0;
  for (const double m : coarse.mass) mass += m;
  for (const double m : fine.mass) fine_mass += m;
  CHECK(mass == doctest::Approx(1));
  CHECK(fine_mass == doctest::Approx(mass));
  const auto& removed = std::get<RemoveElements>(fine.scene.events[0].command).which.tets;
  CHECK(removed.size() == 8);
  CHECK(removed.front() == 24);
  CHECK(std::get<Grasp>(fine.scene.events[1].command).node == std::get<Grasp>(coarse.scene.events[1].command).node);
}

TEST_CASE("a scene solved by another method keeps the times of its events") {
  const Problem problem = block();
  CHECK(problem.scene.events[0].tick == 5);
  CHECK(with_method(problem.scene, {Integrator::verlet}).events[0].tick == 50);
  const Scene coarse = with_method(problem.scene, {Integrator::backward_euler, 0.025, 2, true});
  CHECK(coarse.events[0].tick == 2);
  CHECK(coarse.solver.budget->iterations == 2);
  CHECK(coarse.solver.single_precision);
  CHECK(text_of(Method{Integrator::backward_euler, 0.025, 2, true, 0}) ==
        "backward_euler, steps of 25 ms, 2 iterations, float, all cores");
}

TEST_CASE("keys of problems differ with anything in their scene") {
  const Problem one = block();
  Problem other = one;
  CHECK(key_of(one) == key_of(other));
  other.scene.solver.damping = 1;
  CHECK(key_of(one) != key_of(other));
  CHECK(key_of(finer(one)) != key_of(one));
}

TEST_CASE("other elements of a problem: quadratic ones of all edges, and back to their corners") {
  Problem linear = block();
  CHECK(elements_of(linear) == std::vector<std::string>{"p1"});  // it removes elements
  linear.scene.events.clear();
  CHECK(elements_of(linear) == std::vector<std::string>{"p1", "p2"});
  linear.scene.solver.recovery = true;
  const Problem quadratic = with_element(linear, "p2");
  CHECK(quadratic.element() == "p2");
  CHECK(quadratic.scene.solver.element() == "p2");
  CHECK_FALSE(quadratic.scene.solver.recovery);
  CHECK(quadratic.setup.midedges.size() == linear.setup.mesh.tets.size());
  CHECK(quadratic.setup.mesh.nodes.size() == 12 + 31);  // corners and edges
  CHECK(quadratic.setup.boundary[0].nodes.size() == 9);
  CHECK(quadratic.setup.loads[0].nodes.size() == 9);
  double mass = 0;
  for (const double m : quadratic.mass) {
    CHECK(m > 0);
    mass += m;
  }
  CHECK(mass == doctest::Approx(1));
  CHECK(text_of(quadratic) == "p2, 10 tetrahedra");
  CHECK(elements_of(quadratic) == std::vector<std::string>{"p2"});
  const auto base = linear_base(quadratic);
  REQUIRE(base);
  CHECK(base->element() == "p1");
  CHECK(base->setup.mesh.nodes == linear.setup.mesh.nodes);
  CHECK(base->setup.boundary[0].nodes == linear.setup.boundary[0].nodes);
  CHECK(base->mass == linear.mass);
  Problem shuffled = quadratic;  // a node of the mesh file in the middle of an edge, before a corner
  std::swap(shuffled.setup.mesh.tets[0][0], shuffled.setup.midedges[0][0]);
  CHECK_FALSE(linear_base(shuffled));
}

TEST_CASE("elements of a problem: mean dilatation where Poisson's ratio is high") {
  Problem problem = block();
  problem.scene.events.clear();
  const auto with = [&](double bulk) {
    problem.setup.materials[0].material = sample_material(*find_law("neo_hookean_iso"), {1e3, bulk});
    return elements_of(problem);
  };
  CHECK(with(2e3) == std::vector<std::string>{"p1", "nodal_pressure", "p2"});
  CHECK(with(1e5) == std::vector<std::string>{"p1", "nodal_pressure", "p2_pressure"});
  problem.setup.self_contact.emplace();
  CHECK(with(1e5) == std::vector<std::string>{"p1", "nodal_pressure"});
}

TEST_CASE("a linear motion is sampled exactly, at nodes, inside and outside") {
  const TetMesh mesh = make_box(Vec3(1, 1, 1), {3, 2, 2});
  Mat3 A;
  A << 1.1, 0.2, 0, -0.1, 0.9, 0.3, 0, 0.1, 1.2;
  std::vector<Vec3> x;
  for (const Vec3& X : mesh.nodes) x.push_back(A * X + Vec3(1, 2, 3));
  const std::vector<Vec3> points{mesh.nodes[5], Vec3(0.31, 0.77, 0.12), Vec3(1.01, 0.5, 0.5)};
  const auto there = sample_motion(mesh, x, points);
  for (std::size_t k = 0; k < points.size(); ++k) CHECK((there[k] - (A * points[k] + Vec3(1, 2, 3))).norm() < 1e-12);
}

}  // namespace heml::problem_test
