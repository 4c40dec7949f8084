#pragma once
// Reads and writes the `view` object of a scene.
#include <heml/scenario/json_cursor.hpp>
#include <heml/scenario/scene.hpp>

namespace heml {

/// Throws InputError naming the key.
View view_from(const JsonCursor& key);

Json view_json(const View& view);

}  // namespace heml
