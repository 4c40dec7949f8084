#pragma once
// What a file is taken for, by its ending.
#include <filesystem>

namespace heml {

/// other: read_scene() looks inside.
enum class FileKind { other, scene, recording, tetrahedra, surface };
FileKind kind_of(const std::filesystem::path& path);

}  // namespace heml
