// What a world that goes no further says of it.
#include <doctest/doctest.h>

#include "engine/materials/sample_materials.hpp"
#include "support.hpp"
#include "world_support.hpp"

namespace heml::halt_message_test {

using namespace heml::test;

TEST_CASE("halt: a stiffness beyond what float holds is told in words, not as a step of nan seconds") {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(0.1, 0.02, 0.02), {1, 1, 1});
  Material soft_one = sample_material("mooney_rivlin"), ogden = sample_material("ogden");
  soft_one.parameters = {1000, 500, 1e5};
  ogden.parameters = {1000, -200, 3, -2, 3e4};
  soft_one.density = 1;
  setup.materials = {{std::nullopt, soft_one}};
  setup.solver.threads = 1;
  setup.solver.continuation = true;
  for (const bool single : {true, false}) {
    setup.solver.single_precision = single;
    const auto world = make_world(setup);
    const Vec3 place(0.1, 0.02, 0);
    const int tip = nodes_where(setup.mesh, [&](const Vec3& X) { return (X - place).norm() < 1e-9; })[0];
    REQUIRE(world->apply(Grasp{tip, 0.008}).ok());
    for (int k = 0; k < 2000 && !world->halt(); ++k) {
      if (k == 32)
        REQUIRE(world->apply(MoveTool{Vec3(-497427.9272425366, -392511.39734036976, -399879.89734429074)}).ok());
      if (k == 41) REQUIRE(world->apply(SetMaterial{std::nullopt, ogden}).ok());
      world->tick();
    }
    if (single) {
      REQUIRE(world->halt());
      CHECK(world->halt()->message.find("single precision") != std::string::npos);
    }
    if (!world->halt()) continue;
    CHECK(world->halt()->message.find("nan") == std::string::npos);
    CHECK(world->halt()->message.find("inf") == std::string::npos);
  }
}

}  // namespace heml::halt_message_test
