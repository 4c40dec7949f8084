#pragma once
// Where a pair of forceps holds the tissue, and how it is drawn there: the tips stand on the skin on both sides of what
// they hold, the handle rises from it, and the skin under them is what the frame shows.
//
//              / handle: along the normal, leaning to the hand's side and along the pull
//             /
//        || ─ ─ ─ ─ ─ ─ ─►  line of the pull, as far as the tissue has not followed
//      ──┘└────────
//         held patch
#include <app/render/camera.hpp>
#include <app/render/surface_point.hpp>
#include <array>
#include <heml/session/frame.hpp>

namespace heml::render {

/// What the mouse holds: where it took hold, and where it is now.
struct Hold {
  SurfacePoint at;
  Vec3f hand = Vec3f::Zero();  ///< m
};

/// Held tissue as it lies in a frame.
struct HeldPatch {
  Vec3f place = Vec3f::Zero();   ///< m, on the drawn skin
  Vec3f normal = Vec3f::Zero();  ///< unit, outward
  Vec3f pull = Vec3f::Zero();    ///< m, from there to where the tool pulls it
};

/// The patch of a grasp: at the mouse's hold, else, where the script holds or a cut took that triangle, at the grasped
/// node. A node that is not on the surface has the tool's own place and faces the eye.
HeldPatch held_patch(const GraspState& grasp, const std::optional<Hold>& hold, const Frame& frame,
                     const SurfaceMesh* surface_mesh, const Vec3f& eye);

/// Placements of the two jaws (forceps_jaw(), solid_mesh.hpp). radius: m, of the body at rest.
std::array<Mat4f, 2> jaw_models(const HeldPatch& patch, const Camera& camera, float radius);

}  // namespace heml::render
