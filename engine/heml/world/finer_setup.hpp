#pragma once
// The same body on a finer mesh.
#include <heml/world/setup.hpp>

namespace heml {

/// mesh: the setup's nodes first, in their order, then middles; ends: of each middle, the nodes it lies between. What
/// was selected takes in the middles between what was selected; a middle starts midway between where its ends start.
WorldSetup on_finer_mesh(WorldSetup setup, TetMesh mesh, const std::vector<std::array<int, 2>>& ends);

}  // namespace heml
