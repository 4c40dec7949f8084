#include <fmt/format.h>

#include <algorithm>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/scene_reference.hpp>

namespace heml {
namespace {

constexpr const char* smallest_file = "scene.json";

std::string value_text(const Json& object, const KeyInfo& key) {
  const auto found = object.find(std::string(key.name));
  return found == object.end() ? "" : fmt::format("`{}`", short_json(*found));
}

}  // namespace

Json smallest_scene(const ObjectInfo& object) {
  Json scene = Json::parse(R"({
    "schema_version": 1,
    "mesh": {"box": {"size": [1, 1, 1], "cells": [1, 1, 1]}},
    "materials": [{"law": "stvk", "young": 1, "poisson": 0}]
  })");
  scene.merge_patch(Json::parse(object.example));
  return scene;
}

Json& object_in(Json& scene, const ObjectInfo& object) {
  Json* place = &scene;
  for (std::string_view path = object.path; !path.empty();) {
    std::string_view name = path.substr(0, path.find('.'));
    path.remove_prefix(std::min(name.size() + 1, path.size()));
    const bool is_list = name.ends_with("[]");
    if (is_list) name.remove_suffix(2);
    place = &(*place)[std::string(name)];
    if (is_list) place = &place->at(0);
  }
  return *place;
}

std::string usual_text(const ObjectInfo& object, const KeyInfo& key) {
  if (!key.usual.empty()) return std::string(key.usual);
  const Scene scene = parse_scene(smallest_scene(object).dump(), smallest_file);
  Json written = Json::parse(scene_line(scene, "."));
  return value_text(object_in(written, object), key);
}

std::string usual_text(const CommandInfo& command, const KeyInfo& key) {
  if (!key.usual.empty()) return std::string(key.usual);
  Json value = Json::parse(command.example);
  value.erase(std::string(key.name));
  std::vector<Vec3> points;
  return value_text(command.write(command_with(command.key).read(JsonCursor(value, smallest_file), points)), key);
}

std::string short_json(const Json& value) {
  if (value.is_number_float()) return fmt::format("{}", value.get<double>());
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const Json& entry : value) text += (text.empty() ? "[" : ", ") + short_json(entry);
  return text.empty() ? "[]" : text + "]";
}

}  // namespace heml
