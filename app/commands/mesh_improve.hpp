#pragma once
// The part of `heml mesh` that improves shapes.
#include <app/commands/commands.hpp>
#include <heml/mesh/tet_mesh.hpp>

namespace heml {

constexpr double default_min_angle = 10;  ///< degrees

/// The improved mesh. Prints a line of JSON before and after, and warns of elements that miss the wanted angle.
TetMesh improve_and_print(const TetMesh& mesh, const MeshArguments& arguments);

}  // namespace heml
