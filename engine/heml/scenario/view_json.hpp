#pragma once
// Reads and writes the objects `view` and `skin` of a scene.
#include <heml/scenario/json_cursor.hpp>
#include <heml/scenario/scene.hpp>

namespace heml {

/// Throws InputError naming the key.
View view_from(const JsonCursor& key);

Json view_json(const View& view);

/// Throws InputError naming the key. folder: of the scene.
SkinSpec skin_from(const JsonCursor& key, const std::filesystem::path& folder);

Json skin_json(const SkinSpec& skin, const std::filesystem::path& folder);

}  // namespace heml
