#pragma once
// The mesh of a scene, put where the scene wants it.
#include <heml/mesh/tet_mesh.hpp>
#include <heml/scenario/scene.hpp>

namespace heml {

/// Reads or makes the mesh, scales, rotates and moves it (fields of vectors are rotated with it), and checks it; what
/// is odd about it goes to warn(). Throws InputError.
TetMesh load_mesh(const Scene& scene);

/// mesh: as load_setup() leaves it, with the fields that materials use and no others.
MeshFingerprint mesh_fingerprint(const TetMesh& mesh);

/// Of an asset by its name; it need not exist.
std::filesystem::path asset_mesh_file(const std::string& name);

/// Throws InputError when the scene was recorded with another mesh.
void check_recorded_mesh(const Scene& scene, const TetMesh& mesh);

/// Where a file of the scene is: the path, or, for a recording whose file is gone, one of the same name beside the
/// recording. Throws InputError naming the key when there is none.
std::filesystem::path find_file(const Scene& scene, const std::string& key, const std::filesystem::path& path);

}  // namespace heml
