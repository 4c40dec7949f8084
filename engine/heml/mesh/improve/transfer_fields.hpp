#pragma once
// Carries element fields from one mesh to another of the same body.
#include <heml/mesh/tet_mesh.hpp>

namespace heml {

/// Gives every element of `to` the field values of the element of `from` with the nearest centroid in the same region.
/// Requires that every region of `to` is one of `from`.
void transfer_fields(const TetMesh& from, TetMesh& to);

}  // namespace heml
