#pragma once
// Loads and places the mesh of a scene.
#include <heml/mesh/quadratic.hpp>
#include <heml/scenario/scene.hpp>

namespace heml {

struct MendedSurface;

/// Reads or generates the mesh as its source has it, unchecked, with the wanted number of tetrahedra. midedges: those
/// of a file of ten-node tetrahedra; null: they are left out with a warning. Throws InputError.
TetMesh read_mesh_source(const Scene& scene, MidEdges* midedges = nullptr);

/// The mesh improved to the number of tetrahedra that the scene wants, if it wants one. Throws InputError as improve().
TetMesh with_wanted_tets(const Scene& scene, TetMesh mesh);

/// Fills a surface by mesh.tetgen, in the file's units.
TetMesh filled_surface(const Scene& scene, const MendedSurface& surface);

/// Reads or generates the mesh, scales, rotates and translates it (vector fields are rotated too), and checks it;
/// warnings go to warn(). midedges: as above, of a scene with quadratic elements; empty where the source has none.
/// Throws InputError.
TetMesh load_mesh(const Scene& scene, MidEdges* midedges = nullptr);

/// mesh: as load_setup() returns it, with only the fields that materials use.
MeshFingerprint mesh_fingerprint(const TetMesh& mesh);

/// Path of an asset's mesh by its name; the file need not exist.
std::filesystem::path asset_mesh_file(const std::string& name);

/// Throws InputError when the scene is a recording made with another mesh.
void check_recorded_mesh(const Scene& scene, const TetMesh& mesh);

/// Finds a file of the scene: `path`, or, for a recording whose file is gone, one of the same name in the recording's
/// folder, with a warning. Throws InputError naming the key when there is none.
std::filesystem::path find_file(const Scene& scene, const std::string& key, const std::filesystem::path& path);

}  // namespace heml
