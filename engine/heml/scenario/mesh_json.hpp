#pragma once
// Reads and writes the `mesh` object of a scene.
#include <filesystem>
#include <heml/scenario/json_cursor.hpp>
#include <heml/scenario/scene.hpp>

namespace heml {

/// A path given in a scene in `folder`, resolved against it. Throws InputError when it is empty.
std::filesystem::path path_from(const JsonCursor& key, const std::filesystem::path& folder);

/// A path as written into a scene in `folder`: relative when the file lies below it, else absolute.
std::string path_text(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Throws InputError naming the key.
MeshSpec mesh_from(const JsonCursor& key, const std::filesystem::path& folder);

Json mesh_json(const MeshSpec& mesh, const std::filesystem::path& folder);

/// `rotate`: {axis, origin, degrees} of a mesh or a boundary entry; the axis read is normalised.
void read_rotation(const JsonCursor& key, Vec3& axis, Vec3& origin, double& degrees);
Json rotation_json(const Vec3& axis, const Vec3& origin, double degrees);

}  // namespace heml
