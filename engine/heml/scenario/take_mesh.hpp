#pragma once
// A file of tetrahedra, a surface or a label map becomes the mesh of a scene around it (bare_mesh.hpp).
#include <heml/scenario/scene.hpp>

namespace heml {

/// Names the file in scene.mesh and reads or fills it (MeshSpec::source), with the number of tetrahedra that
/// scene.chosen->given wants; lists there what was wrong. A label map is meshed with that number; other meshes are
/// improved to it. The mesh of the last call is taken again where file and number are the same. From any thread.
/// Requires scene.chosen. Throws InputError.
void take_mesh(Scene& scene, const std::filesystem::path& path);

}  // namespace heml
