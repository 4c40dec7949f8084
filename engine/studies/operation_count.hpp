#pragma once
// How many operations the engine's element code takes.
#include <heml/mesh/tet_mesh.hpp>
#include <optional>
#include <studies/counting_scalar.hpp>

namespace heml {

/// Of one force field of a body of one material (a law that is a continuum): the code of every element, and the sums at
/// nodes, run on counted numbers at positions x (3 #V, metres).
Operations force_operations(const TetMesh& mesh, const Material& material, const double* x);

/// Of one tetrahedron, without the sums at nodes; none of springs. Fans share edges, and take fewer
/// (elastic/fan_force_kernel.hpp).
std::optional<Operations> element_operations(const Material& material);

}  // namespace heml
