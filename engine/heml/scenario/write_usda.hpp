#pragma once
// Bodies over time as OpenUSD text (.usda).
#include <filesystem>
#include <functional>
#include <heml/scenario/animation.hpp>
#include <map>
#include <string>

namespace heml {

/// Writes a layer of OpenUSD (openusd.org, UsdGeom), metres, y up:
///
///   /body/part_1          Xform; part_2, ... after each edit of the mesh, visible from its first frame to that of the
///   next /body/part_1/tissue   TetMesh (UsdGeomTetMesh): all present tetrahedra and nodes; its purpose is guide
///   /body/part_1/skin     Mesh: their boundary, with colours of the regions by face
///
/// points have a time sample a frame, at the frame's time × fps; timeCodesPerSecond is fps. Needs an animation of whole
/// bodies (Animation::Extent::body). Throws InputError when it cannot be written.
void write_usda(const std::filesystem::path& path, const Animation& animation, double fps,
                const std::function<Vec3f(int region)>& colour);

}  // namespace heml
