// An edit that is taken back: the body goes on as if there had been none, whatever it remembers.
#include <doctest/doctest.h>

#include <heml/materials/material.hpp>

#include "engine/materials/sample_materials.hpp"
#include "support.hpp"
#include "world_support.hpp"

namespace heml::undo_test {

using namespace heml::test;

namespace {

constexpr double length = 0.06;

/// A bar that is drawn out within the first ticks, and then kept so.
WorldSetup drawn_bar(const Material& material, Integrator integrator, bool single) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(length, 0.02, 0.02), {4, 1, 1});
  setup.materials = {{std::nullopt, material}};
  for (const double at : {0.0, length}) {
    Boundary end{nodes_where(setup.mesh, [at](const Vec3& X) { return std::abs(X.x() - at) < 1e-9; })};
    end.translate = Vec3(at / 4, at / 8, 0);
    end.ramp_time = 0.02;
    setup.boundary.push_back(end);
  }
  setup.gravity = Vec3(0, -9.81, 0);
  setup.solver.integrator = integrator;
  setup.solver.single_precision = single;
  setup.solver.continuation = true;
  setup.solver.threads = 1;
  setup.solver.rate = 200;
  return setup;
}

const RemoveElements removal{{{3, 18}, {}, {}, {}}};

void tick(World& world, int times) {
  for (int k = 0; k < times; ++k) world.tick();
}

/// before: edits that stay, of both worlds: then the order of slots is no longer that of a body made anew.
void check_undone(const WorldSetup& setup, const std::vector<Command>& before, const std::vector<Command>& edits) {
  const auto plain = make_world(setup), edited = make_world(setup);
  for (World* world : {plain.get(), edited.get()}) {
    tick(*world, 3);
    for (const Command& command : before) REQUIRE(world->apply(command).ok());
    tick(*world, 5);
    REQUIRE_FALSE(world->halt());
  }
  const std::size_t stay = edited->edits().size();
  for (const Command& edit : edits) REQUIRE(edited->apply(edit).ok());
  REQUIRE(edited->edits().size() == stay + edits.size());
  for (std::size_t k = 0; k < edits.size(); ++k) REQUIRE(edited->apply(Undo{}).ok());
  CHECK(edited->stable_step() == plain->stable_step());
  CHECK(edited->energies().elastic == plain->energies().elastic);
  for (int k = 0; k < 12; ++k) {
    REQUIRE(edited->state_hash() == plain->state_hash());
    plain->tick();
    edited->tick();
  }
  CHECK_FALSE(plain->halt());
  CHECK(edited->state_hash() == plain->state_hash());
}

const std::vector<Integrator> moving = moving_integrators();

}  // namespace

TEST_CASE("undo: restores the state to the bit, for every kind of internal state") {
  for (const LawInfo& law : laws()) {
    CAPTURE(std::string(law.name));
    if (law.name.starts_with("paper_")) continue;
    const Material sample = sample_material(law.name);
    for (const Material& material : law.is_continuum ? with_internal_state(sample) : std::vector{sample}) {
      if (material_problem(material)) continue;
      for (const bool single : {false, true})
        for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler}) {
          CAPTURE(single);
          CAPTURE(integrator_name(integrator));
          check_undone(drawn_bar(material, integrator, single), {}, {removal});
        }
    }
  }
}

TEST_CASE("undo: the same with every integrator, for removals and cuts, alone, together, and after others that stay") {
  Material material = sample_material("mooney_rivlin");
  material.viscosity = 2;
  material.relaxation = {{0.5, 0.01}};
  Material plastic = material;
  plastic.plasticity = Plasticity{60, 10};
  for (const Material& of_two : {material, plastic, sample_material("mooney_rivlin")})
    for (const bool single : {false, true})
      for (const Integrator integrator : moving) {
        CAPTURE(single);
        CAPTURE(integrator_name(integrator));
        const WorldSetup setup = drawn_bar(of_two, integrator, single);
        check_undone(setup, {}, {blade_at(0.034)});
        check_undone(setup, {}, {blade_at(0.034), removal});
        check_undone(setup, {blade_at(0.027)}, {blade_at(0.05)});
        check_undone(setup, {blade_at(0.027)}, {removal});
        check_undone(setup, {removal}, {blade_at(0.05)});
        check_undone(setup, {removal}, {RemoveElements{{{1}, {}, {}, {}}}});
      }
}

TEST_CASE("undo: the same with two materials, of which one loses all its elements, and with nodal pressure") {
  for (const bool nodal : {false, true})
    for (const Integrator integrator : {Integrator::verlet, Integrator::bdf2}) {
      CAPTURE(nodal);
      CAPTURE(integrator_name(integrator));
      Material first = sample_material("neo_hookean_iso"), second = first;
      second.plasticity = Plasticity{60, 10};
      WorldSetup setup = drawn_bar(first, integrator, false);
      setup.solver.nodal_pressure = nodal;
      setup.materials = {{1, second}, {2, first}};
      for (std::size_t t = 0; t < setup.mesh.tets.size(); ++t) setup.mesh.regions[t] = t < 4 ? 1 : 2;
      check_undone(setup, {}, {RemoveElements{{{0, 1, 2, 3}, {}, {}, {}}}});
    }
}

TEST_CASE("undo: what is grasped and pinned stays so, and preconditioners that are made once go on") {
  for (const bool single : {false, true})
    for (const Integrator integrator : moving)
      for (const Preconditioner preconditioner :
           {Preconditioner::cholesky, Preconditioner::scalar, Preconditioner::multilevel}) {
        CAPTURE(integrator_name(integrator));
        if (is_explicit(integrator) && preconditioner != Preconditioner::cholesky) continue;
        WorldSetup setup = cantilever();
        setup.materials[0].material.viscosity = 1;
        setup.solver.integrator = integrator;
        setup.solver.single_precision = single;
        setup.solver.preconditioner = preconditioner;
        const auto at = [&](const Vec3& X) {
          return nodes_where(setup.mesh, [&](const Vec3& Y) { return (X - Y).norm() < 1e-9; })[0];
        };
        const Vec3 tip(0.1, 0.02, 0.02);
        const std::vector<Command> constrained = {Grasp{at(tip), 0.015}, MoveTool{tip + Vec3(0.01, 0.01, 0)},
                                                  PinTissue{at(Vec3(0.05, 0.02, 0.01)), 0.011}};
        check_undone(setup, constrained, {RemoveElements{{{190, 60}, {}, {}, {}}}});
        check_undone(setup, constrained, {blade_at(0.083)});
        std::vector<Command> after_others = constrained;
        after_others.push_back(RemoveElements{{{195, 61}, {}, {}, {}}});
        check_undone(setup, after_others, {RemoveElements{{{190, 60}, {}, {}, {}}}});
      }
}

TEST_CASE("undo: later, too, the internal state of the time of the edit is restored") {
  for (const bool single : {false, true})
    for (const Integrator integrator : moving) {
      CAPTURE(integrator_name(integrator));
      Material material = sample_material("mooney_rivlin");
      material.relaxation = {{0.5, 1}};
      material.plasticity = Plasticity{60, 10};
      const WorldSetup setup = drawn_bar(material, integrator, single);
      const auto plain = make_world(setup), edited = make_world(setup);
      tick(*plain, 8);
      tick(*edited, 8);
      REQUIRE(edited->apply(removal).ok());
      tick(*edited, 5);
      REQUIRE(edited->apply(Undo{}).ok());
      CHECK(edited->state_hash() == plain->state_hash());
      CHECK(edited->energies().elastic == plain->energies().elastic);
      REQUIRE(plain->apply(SetDamping{0}).ok());  // forces are found anew at any command
      CHECK(edited->reactions() == plain->reactions());
    }
}

TEST_CASE("undo: a material switched since loses its internal state, and grasps changed since stay changed") {
  Material material = sample_material("mooney_rivlin");
  material.plasticity = Plasticity{60, 10};
  const WorldSetup setup = drawn_bar(material, Integrator::verlet, false);
  const auto world = make_world(setup);
  const int middle = nodes_where(setup.mesh, [](const Vec3& X) { return std::abs(X.x() - length / 2) < 1e-9; })[0];
  REQUIRE(world->apply(Grasp{middle, 0.01}).ok());
  tick(*world, 8);
  REQUIRE(world->apply(removal).ok());
  REQUIRE(world->apply(Release{}).ok());
  REQUIRE(world->apply(SetMaterial{std::nullopt, sample_material("stvk")}).ok());
  tick(*world, 2);
  REQUIRE(world->apply(Undo{}).ok());
  CHECK_FALSE(has_tool<GraspState>(*world));
  tick(*world, 5);
  CHECK_FALSE(world->halt());
  REQUIRE(world->apply(Grasp{middle, 0.01}).ok());
  const Vec3 target = tool_of<GraspState>(*world).target + Vec3(0, 0.002, 0);
  REQUIRE(world->apply(removal).ok());
  REQUIRE(world->apply(MoveTool{target}).ok());
  tick(*world, 2);
  REQUIRE(world->apply(Undo{}).ok());
  CHECK(has_tool<GraspState>(*world));
  CHECK(tool_of<GraspState>(*world).target == target);
  tick(*world, 5);
  CHECK_FALSE(world->halt());
}

}  // namespace heml::undo_test
