#pragma once
// Fields of elements on pieces of them: after a cut, a subdivision, or on another mesh of the same body.
#include <heml/mesh/tet_mesh.hpp>

namespace heml {

/// Appends a field's values on a piece of an element to `values`: those of the element; of directions at integration
/// points, those at the points of the piece, unit vectors along the linear function through the element's. Directions
/// that differ in sign alone are the same.
/// mesh: with the element, of straight sides; corners: of the piece, m.
void append_piece(const ElementField& field, const TetMesh& mesh, int element, const std::array<Vec3, 4>& corners,
                  std::vector<double>& values);

/// The field on a mesh of pieces of `mesh`. parents: #T of pieces, elements of mesh.
ElementField field_of_pieces(const ElementField& field, const TetMesh& mesh, const TetMesh& pieces,
                             const std::vector<int>& parents);

}  // namespace heml
