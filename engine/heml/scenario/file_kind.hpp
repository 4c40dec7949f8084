#pragma once
// Kind of an input file, by its extension.
#include <filesystem>

namespace heml {

/// other: read_scene() inspects the content.
enum class FileKind { other, scene, recording, tetrahedra, surface, labels };
FileKind kind_of(const std::filesystem::path& path);

}  // namespace heml
