#pragma once
// Scenes for tests, as text.
#include <heml/scenario/json_text.hpp>
#include <heml/scenario/scene.hpp>
#include <messages.hpp>
#include <string>

namespace heml::test {

/// A small valid scene: a box of 2×1×1 cells, fixed at x = 0.
inline Json small_scene() {
  return Json::parse(R"({
    "schema_version": 1,
    "mesh": {"box": {"size": [0.2, 0.1, 0.1], "cells": [2, 1, 1]}},
    "materials": [{"law": "stvk", "young": 1e4, "poisson": 0.3}],
    "boundary": [{"box": [[0, -1, -1], [0, 1, 1]], "fix": true}],
    "solver": {"rate": 100, "duration": 0.1}
  })");
}

/// The small scene after a JSON merge patch (RFC 7396: null removes a key).
inline std::string scene_with(const std::string& patch) {
  Json scene = small_scene();
  scene.merge_patch(Json::parse(patch));
  return scene.dump();
}

/// Whether a message contains a part.
inline Scene small_scene_with(const std::string& patch) { return parse_scene(scene_with(patch), "folder/scene.json"); }

}  // namespace heml::test
