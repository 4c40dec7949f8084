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
#include <vector>

namespace heml::render {

/// What a person's hand holds: where it took hold, and where it is now.
struct Hold {
  SurfacePoint at;
  Vec3f hand = Vec3f::Zero();  ///< m
  int number = 0;              ///< of the hand: GraspState::hand
};

/// What is drawn of a person's hands; forceps of a grasp without a hold stand at the grasped node.
struct HandDrawing {
  std::vector<Hold> holds;
  std::vector<Vec3f> free_tips;  ///< m, of open forceps that hold nothing

  std::optional<Hold> hold_of(int hand) const;
};

/// Held tissue as it lies in a frame.
struct HeldPatch {
  Vec3f place = Vec3f::Zero();   ///< m, on the drawn skin
  Vec3f normal = Vec3f::Zero();  ///< unit, outward
  Vec3f pull = Vec3f::Zero();    ///< m, from there to where the tool pulls it
};

/// Whether a grasp is drawn as a clamp: forceps are those of a person's hands.
inline bool is_clamp(const GraspState& grasp) { return !is_persons_hand(grasp.hand); }

/// The patch of a grasp: at the hand's hold, else, where the script holds or a cut took that triangle, at the grasped
/// node. A node that is not on the surface has the tool's own place and faces the eye.
HeldPatch held_patch(const GraspState& grasp, const std::optional<Hold>& hold, const Frame& frame,
                     const SurfaceMesh* surface_mesh, const Vec3f& eye);

/// Where open forceps that hold nothing are drawn: as if they stood on a skin that faces the eye.
HeldPatch free_patch(const Vec3f& tip, const Camera& camera);

/// From the tips to the end of the handle, unit. It leans to the upper right, as held by a right hand, so that one does
/// not look along it where the skin faces the eye, and it follows the pull; it always rises from the skin. radius: m.
Vec3f handle_axis(const HeldPatch& patch, const Camera& camera, float radius);

/// Length of a drawn clamp from its tips to its rings, in body radii.
inline constexpr float clamp_length = 0.8f;

/// Placements of the two halves of a clamp (scissors_half(), solid_mesh.hpp), closed, tips on the patch.
std::array<Mat4f, 2> clamp_models(const HeldPatch& patch, const Camera& camera, float radius);

/// Placements of the two jaws (forceps_jaw(), solid_mesh.hpp). radius: m, of the body at rest. open: they hold nothing.
std::array<Mat4f, 2> jaw_models(const HeldPatch& patch, const Camera& camera, float radius, bool open = false);

}  // namespace heml::render
