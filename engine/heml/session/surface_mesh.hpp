#pragma once
// Fills the surface mesh and frames that are drawn.
#include <heml/session/frame.hpp>

namespace heml {

/// Boundary of the present elements with its constrained nodes and regions. last: the previous result for the same
/// world, if any; it is returned again while the topology version is the same.
std::shared_ptr<const SurfaceMesh> make_surface_mesh(const World& world,
                                                     std::shared_ptr<const SurfaceMesh> last = nullptr);

/// Fills a frame with the world's current state. surface_mesh: make_surface_mesh(world). ahead: s, extrapolation of
/// positions by velocity, for frames between two ticks. with_stretches: whether Frame::stretches is filled. Leaves
/// members that belong to the session (pace, paused, ...) unchanged.
void fill_frame(World& world, std::shared_ptr<const SurfaceMesh> surface_mesh, Field field, double ahead, Frame& frame,
                bool with_stretches = false);

/// Fills the frame's solid, its positions and its values of Frame::field; call after fill_frame(). `last`: the solid of
/// the last fill, shared while the topology is the same.
void fill_solid(World& world, double ahead, std::shared_ptr<const Solid>& last, Frame& frame);

/// Removes it from the frame.
void clear_solid(Frame& frame);

}  // namespace heml
