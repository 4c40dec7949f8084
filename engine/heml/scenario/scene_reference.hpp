#pragma once
// What the reference page of the scene format says beside its tables (scene_keys.hpp, command_table.hpp): the values
// that hold where keys are not given, as reading and writing a scene shows them.
#include <heml/scenario/command_table.hpp>
#include <heml/scenario/scene_keys.hpp>
#include <string>

namespace heml {

/// The smallest scene that has such an object.
Json smallest_scene(const ObjectInfo& object);

/// The object in a scene, by its path; the first of a list.
Json& object_in(Json& scene, const ObjectInfo& object);

/// What holds where the key is not given: "required", "`0`", "none". Empty where nothing says it.
std::string usual_text(const ObjectInfo& object, const KeyInfo& key);
std::string usual_text(const CommandInfo& command, const KeyInfo& key);

/// A JSON value on one line, numbers as people write them.
std::string short_json(const Json& value);

}  // namespace heml
