#pragma once
// The scene that a command is about: a file, or the name of an installed scene.
#include <CLI/CLI.hpp>
#include <string>

namespace heml {

/// Adds the argument SCENE.
CLI::Option* add_scene(CLI::App& command, std::string& scene);

/// Adds the argument SCENE, without which the command takes the default scene.
CLI::Option* add_scene_or_default(CLI::App& command, std::string& scene);

/// Turns the name of an installed scene into its path.
CLI::Option* takes_scene(CLI::Option* option);

}  // namespace heml
