// Worlds in which supports hold every node: there is nothing to solve for, and every method plays their motion.
#include <doctest/doctest.h>

#include <heml/materials/point.hpp>

#include "engine/materials/sample_materials.hpp"
#include "support.hpp"
#include "world_support.hpp"

namespace heml::nothing_free_test {

using namespace heml::test;

namespace {

constexpr double length = 0.06;

enum class Supports { fixed, prescribed, crushing };

/// A block whose ends are all of its nodes.
WorldSetup held_block(const Material& material, Supports supports) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(length, 0.02, 0.02), {1, 1, 1});
  setup.materials = {{std::nullopt, material}};
  Boundary still{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })};
  Boundary other{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 1e-9; })};
  if (supports != Supports::fixed) other.translate = Vec3(supports == Supports::crushing ? -1.5 * length : 0.01, 0, 0);
  other.ramp_time = 0.02;
  setup.boundary = {still, other};
  setup.gravity = Vec3(0, -9.81, 0);
  setup.solver.threads = 1;
  setup.solver.rate = 200;
  return setup;
}

void play(World& world) {
  if (world.setup().solver.is_static()) return world.load_to(1);
  run_until(world, 0.03);
}

void check_played(const WorldSetup& setup) {
  const auto world = make_world(setup);
  play(*world);
  REQUIRE_MESSAGE(!world->halt(), world->halt()->message);
  const auto x = world->positions();
  const double exact = setup.solver.single_precision ? 1e-8 : 1e-15;
  for (std::size_t k = 0; k < 2; ++k)
    for (const int n : setup.boundary[k].nodes) {
      const auto node = static_cast<std::size_t>(n);
      CHECK((x[node] - setup.mesh.nodes[node] - setup.boundary[k].translate).norm() <= exact);
    }
}

/// Ends before an element is flat, and says which would be; explicit methods may run out of steps first.
void check_crushed(const WorldSetup& setup) {
  const auto world = make_world(setup);
  play(*world);
  REQUIRE(world->halt());
  const StopReason& halt = *world->halt();
  if (!is_explicit(setup.solver.integrator) && setup.solver.integrator != Integrator::automatic) {
    CHECK(halt.cause == StopReason::Cause::out_of_range);
    CHECK(halt.element >= 0);
    CHECK(halt.message.find("element ") != halt.message.npos);
  }
  CHECK(halt.message.find("nan") == halt.message.npos);
  CHECK(halt.message.find("inf") == halt.message.npos);
  for (const double J : world->volume_ratios()) CHECK(J > 0);
}

/// Whether a law without continuation has no energy for elements that are inside out.
bool ends_when_flat(const LawInfo& law) {
  if (!law.is_continuum) return false;
  return !make_material_point(sample_material(law.name), false)->valid(Vec3(1, 1, -0.1).asDiagonal());
}

const std::vector<Integrator> all = [] {
  std::vector<Integrator> list;
  for (const IntegratorInfo& info : all_integrators()) list.push_back(info.id);
  return list;
}();

}  // namespace

TEST_CASE("nothing free: every law, method and precision plays what supports prescribe") {
  for (const LawInfo& law : laws())
    for (const Integrator integrator : all)
      for (const bool single : {false, true})
        for (const Supports supports : {Supports::fixed, Supports::prescribed}) {
          CAPTURE(std::string(law.name));
          CAPTURE(std::string(integrator_name(integrator)));
          CAPTURE(single);
          CAPTURE(supports == Supports::fixed);
          WorldSetup setup = held_block(sample_material(law.name), supports);
          setup.solver.integrator = integrator;
          setup.solver.single_precision = single;
          check_played(setup);
        }
}

TEST_CASE("nothing free: an element that supports press flat is named") {
  for (const LawInfo& law : laws()) {
    for (const Integrator integrator : all)
      for (const bool single : {false, true}) {
        CAPTURE(std::string(law.name));
        CAPTURE(std::string(integrator_name(integrator)));
        CAPTURE(single);
        WorldSetup setup = held_block(sample_material(law.name), Supports::crushing);
        setup.solver.integrator = integrator;
        setup.solver.single_precision = single;
        // Equilibria with an element inside out are none, whatever the law.
        if (ends_when_flat(law) || integrator == Integrator::static_equilibrium) {
          check_crushed(setup);
        } else {
          const auto world = make_world(setup);
          play(*world);
          if (world->halt()) CHECK(world->halt()->message.find("nan") == std::string::npos);
        }
      }
  }
}

TEST_CASE("nothing free: supports that twist a block inside out end a static world in words, in float too") {
  for (const LawInfo& law : laws())
    for (const bool single : {false, true}) {
      CAPTURE(std::string(law.name));
      WorldSetup setup = held_block(sample_material(law.name), Supports::fixed);
      setup.boundary[1].axis = Vec3::UnitX();
      setup.boundary[1].degrees = 180;
      setup.boundary[1].translate = Vec3(0.03, 0, 0);
      setup.solver.integrator = Integrator::static_equilibrium;
      setup.solver.single_precision = single;
      check_crushed(setup);
    }
}

TEST_CASE("nothing free: every preconditioner, minimiser and projection, with budget and with recovery") {
  for (const bool single : {false, true}) {
    for (const Integrator integrator : all)
      for (const Preconditioner preconditioner :
           {Preconditioner::cholesky, Preconditioner::scalar, Preconditioner::multilevel, Preconditioner::block_jacobi})
        for (const Minimiser minimiser : {Minimiser::newton, Minimiser::lbfgs})
          for (const bool bounded : {false, true}) {
            CAPTURE(std::string(integrator_name(integrator)));
            WorldSetup setup = held_block(sample_material("neo_hookean"), Supports::prescribed);
            setup.solver.integrator = integrator;
            setup.solver.single_precision = single;
            setup.solver.preconditioner = preconditioner;
            setup.solver.minimiser = minimiser;
            if (bounded) setup.solver.budget = Budget{.iterations = 2};
            check_played(setup);
            setup = held_block(sample_material("neo_hookean"), Supports::crushing);
            setup.solver.integrator = integrator;
            setup.solver.single_precision = single;
            setup.solver.preconditioner = preconditioner;
            setup.solver.minimiser = minimiser;
            if (bounded) setup.solver.budget = Budget{.iterations = 2};
            check_crushed(setup);
            setup.solver.recovery = true;
            play(*make_world(setup));  // what no recovery can bring back is played all the same
          }
    WorldSetup setup = held_block(sample_material("neo_hookean_iso"), Supports::prescribed);
    setup.solver.single_precision = single;
    setup.solver.nodal_pressure = true;
    for (const Integrator integrator : all) {
      setup.solver.integrator = integrator;
      check_played(setup);
    }
  }
}

TEST_CASE("nothing free: pins may constrain all nodes left, and internal state is kept") {
  Material material = sample_material("mooney_rivlin");
  material.viscosity = 1;
  material.relaxation = {{0.5, 0.01}};
  material.plasticity = Plasticity{60, 10};
  for (const Integrator integrator : all)
    for (const bool single : {false, true}) {
      CAPTURE(std::string(integrator_name(integrator)));
      WorldSetup setup = held_block(material, Supports::prescribed);
      setup.solver.integrator = integrator;
      setup.solver.single_precision = single;
      check_played(setup);
      setup.boundary.pop_back();
      const auto world = make_world(setup);
      if (!setup.solver.is_static()) run_until(*world, 0.01);
      const int free = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 1e-9; })[0];
      REQUIRE(world->apply(PinTissue{free, 1}).ok());
      const auto x = world->positions();
      play(*world);
      REQUIRE_MESSAGE(!world->halt(), world->halt()->message);
      CHECK(world->positions() == x);
    }
}

}  // namespace heml::nothing_free_test
