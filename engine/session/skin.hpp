#pragma once
// The surface of a body for those who draw it.
#include <heml/session/frame.hpp>

namespace heml {

/// Boundary of the mesh, its held nodes and regions.
Skin make_skin(const WorldSetup& setup);

/// Fills a frame with what the world is now. `ahead`: seconds of extrapolation by velocity, for pictures between two
/// ticks. Pace and paused are left as they are; stretches are filled only when asked for.
void fill_frame(World& world, const Skin& skin, Field field, double ahead, Frame& frame, bool with_stretches = false);

}  // namespace heml
