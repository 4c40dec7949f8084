#pragma once
// A surface that is drawn: triangles with texture coordinates or colours, as a modelling program exports them. Vertices
// at one place are one, unless they differ in these (seams).
#include <filesystem>
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

struct TexturedSurface {
  TriangleMesh mesh;                         ///< in the file's unit
  std::vector<std::array<float, 2>> places;  ///< #V: u, and v upwards, of the texture; or empty
  std::vector<Vec3f> colours;                ///< #V: sRGB, 0 to 1; or empty
  std::filesystem::path texture;             ///< image; empty: none
};

/// Reads a surface in any format of assimp (OBJ with its MTL, PLY, glTF, ...) by the helper process. A texture that it
/// names is looked for beside it, unless with_texture is false. Throws InputError, also where that image is missing.
TexturedSurface read_textured_surface(const std::filesystem::path& path, bool with_texture = true);

}  // namespace heml
