#pragma once
// Counts the operations of the engine's element code.
#include <heml/mesh/tet_mesh.hpp>
#include <optional>
#include <studies/counting_scalar.hpp>

namespace heml {

/// Of one force evaluation of a body of one material (a continuum law): the code of every element and the sums at
/// nodes, run with CountingScalar at positions x (3 #V, m).
Operations force_operations(const TetMesh& mesh, const Material& material, const double* x);

/// Of one tetrahedron, without the sums at nodes; none for springs. Fans share edges and need fewer
/// (elastic/fan_force_kernel.hpp).
std::optional<Operations> element_operations(const Material& material);

}  // namespace heml
