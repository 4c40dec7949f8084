#pragma once
// The surface of a body for those who draw it.
#include <heml/session/frame.hpp>

namespace heml {

/// Boundary of what is there of the mesh, its held nodes and regions. last: what was returned before for the same
/// world, if anything; it is returned again while the topology is the same.
std::shared_ptr<const SurfaceMesh> make_surface_mesh(const World& world,
                                                     std::shared_ptr<const SurfaceMesh> last = nullptr);

/// Fills a frame with what the world is now. skin: make_surface_mesh(world). `ahead`: seconds of extrapolation by
/// velocity, for pictures between two ticks. Pace and paused are left as they are; stretches are filled only when asked
/// for.
void fill_frame(World& world, std::shared_ptr<const SurfaceMesh> surface_mesh, Field field, double ahead, Frame& frame,
                bool with_stretches = false);

}  // namespace heml
