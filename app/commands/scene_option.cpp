#include <app/commands/scene_option.hpp>
#include <heml/scenario/installed_scene.hpp>

namespace heml {

CLI::Option* takes_scene(CLI::Option* option) {
  return option->transform(
      CLI::Validator([](std::string& given) { return given = scene_path(given), std::string(); }, ""));
}

CLI::Option* add_scene(CLI::App& command, std::string& scene) {
  return takes_scene(
      command.add_option("SCENE", scene, "scene, recording, mesh or surface, or the name of an installed scene")
          ->required());
}

CLI::Option* add_scene_or_default(CLI::App& command, std::string& scene) {
  return takes_scene(command.add_option(
      "SCENE", scene, "scene, recording, mesh or surface, or the name of an installed scene; none: the default scene"));
}

}  // namespace heml
