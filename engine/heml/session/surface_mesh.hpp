#pragma once
// Fills the surface mesh and frames that are drawn.
#include <heml/session/frame.hpp>

namespace heml {

/// Boundary of the present elements with its constrained nodes and regions. last: the previous result for the same
/// world, if any; it is returned again while the topology version is the same. hidden: regions that are left out,
/// ascending; the boundary is that of the others, closed where they meet hidden ones.
std::shared_ptr<const SurfaceMesh> make_surface_mesh(const World& world,
                                                     std::shared_ptr<const SurfaceMesh> last = nullptr,
                                                     const std::vector<int>& hidden = {});

/// Fills a frame with the world's current state. surface_mesh: make_surface_mesh(world). ahead: s, extrapolation of
/// positions by velocity, for frames between two ticks. with_stretches: whether Frame::stretches is filled. Leaves
/// members that belong to the session (pace, paused, ...) unchanged.
void fill_frame(World& world, std::shared_ptr<const SurfaceMesh> surface_mesh, Field field, double ahead, Frame& frame,
                bool with_stretches = false);

/// Fills the frame's solid, its positions and its values of Frame::field; call after fill_frame(). It leaves out the
/// regions that the frame's surface does. `last`: the solid of the last fill, shared while the topology is the same.
void fill_solid(World& world, double ahead, std::shared_ptr<const Solid>& last, Frame& frame);

/// Removes it from the frame.
void clear_solid(Frame& frame);

class SkinCutter;

/// A scene's skin, cut as the body is, and shown while no region is hidden.
class SkinAttachment {
 public:
  SkinAttachment() = default;  ///< no skin
  explicit SkinAttachment(std::shared_ptr<const Skin> skin) : skin_(std::move(skin)) {}
  bool exists() const { return skin_ != nullptr; }
  /// The same skin for another world of the same mesh, whose cuts may be others.
  SkinAttachment for_another_world() const { return SkinAttachment(skin_); }
  /// Gives the skin to a frame of the world with a solid; the same one while the topology is the same.
  void attach(const World& world, Frame& frame);

 private:
  std::shared_ptr<const Skin> skin_, cut_;
  std::shared_ptr<const SkinCutter> cutter_;  ///< from the first cut on
  long cut_version_ = 0;                      ///< Topology::version of cut_
};

}  // namespace heml
