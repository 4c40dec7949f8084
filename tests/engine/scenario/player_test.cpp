#include <doctest/doctest.h>

#include <heml/scenario/player.hpp>

namespace heml::player_test {

TEST_CASE("a scene that changes its rate is played to its times") {
  const Scene scene = parse_scene(R"({"schema_version": 1, "gravity": [0, -9.81, 0],
    "mesh": {"box": {"size": [0.1, 0.02, 0.02], "cells": [4, 1, 1], "origin": [0, 0, 0]}},
    "materials": [{"law": "neo_hookean", "young": 1e5, "poisson": 0.3}],
    "boundary": [{"box": [[-1, -1, -1], [1e-6, 1, 1]], "fix": true}],
    "solver": {"integrator": "backward_euler", "rate": 100, "duration": 0.5},
    "events": [{"step": 10, "rate": 20}, {"step": 14, "rate": 400}]})",
                                  "scene.json");
  const auto world = load_world(scene);
  Player player(scene, *world);
  for (const double time : {0.05, 0.12, 0.2, 0.29, 0.31, 0.5}) {
    player.to(time);
    CHECK(world->time() == doctest::Approx(time).epsilon(1e-9));
  }
  CHECK(world->ticks() == 10 + 4 + 80);
}

}  // namespace heml::player_test
