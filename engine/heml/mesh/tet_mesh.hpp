#pragma once
// Tetrahedral and triangle meshes: plain data without invariants, until check_tets() (quality.hpp) has checked them.
#include <algorithm>
#include <array>
#include <heml/math/types.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace heml {

using Tet = std::array<int, 4>;
using Triangle = std::array<int, 3>;

/// Local nodes of the six edges of a tetrahedron; edges k and 5 − k are opposite.
inline constexpr std::array<std::array<std::size_t, 2>, 6> tet_edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Of a field that has a vector for each of the four integration points of a quadratic tetrahedron (quadratic.hpp).
inline constexpr std::size_t point_components = 12;

/// Whether a field may have as many numbers an element.
constexpr bool is_field_size(std::size_t components) {
  return components == 1 || components == 3 || components == point_components;
}

/// A named field of scalars or vectors per tetrahedron from a mesh file. NaN where the file gives no value; users of a
/// field check its values.
struct ElementField {
  std::string name;
  std::size_t components;      ///< as in is_field_size()
  std::vector<double> values;  ///< components × #T, contiguous per tetrahedron
};

/// What heat has done to a tetrahedron (mesh/burn.hpp).
struct Burn {
  double level = 0;   ///< 0: nothing, 1: coagulated all through
  double shrink = 0;  ///< part that lengths of its rest shape lose in the end
  double scale = 1;   ///< lengths of its rest shape now over those of the mesh
  bool operator==(const Burn&) const = default;
};

/// A tetrahedral mesh as in its file.
struct TetMesh {
  std::vector<Vec3> nodes;                       ///< #V×3, metres, in the file's order (orphans included)
  std::vector<Tet> tets;                         ///< #T×4, node indices from 0; positive volume after check_tets()
  std::vector<int> regions;                      ///< #T, the file's integer tag; 0 if it gives none
  std::string source;                            ///< file or generator, for messages
  std::vector<ElementField> fields = {};         ///< in the file's order
  std::map<int, std::string> region_names = {};  ///< where the file names regions
  std::vector<Burn> burns = {};                  ///< #T; empty: nothing is burnt
};

/// Lengths of the rest shape of tetrahedron t over those between the nodes of the mesh.
inline double rest_scale(const TetMesh& mesh, std::size_t t) { return mesh.burns.empty() ? 1 : mesh.burns[t].scale; }

/// The corners of an element at rest, m. tet: of nodes of the mesh.
inline std::array<Vec3, 4> rest_corners(const TetMesh& mesh, const Tet& tet) {
  std::array<Vec3, 4> corners;
  for (std::size_t c = 0; c < 4; ++c) corners[c] = mesh.nodes[static_cast<std::size_t>(tet[c])];
  return corners;
}

/// The field of that name; nullptr if there is none.
inline const ElementField* find_field(const TetMesh& mesh, std::string_view name) {
  const auto found = std::find_if(mesh.fields.begin(), mesh.fields.end(),
                                  [&](const ElementField& field) { return field.name == name; });
  return found == mesh.fields.end() ? nullptr : &*found;
}

/// A triangulated surface.
struct TriangleMesh {
  std::vector<Vec3> nodes;          ///< #V×3, metres
  std::vector<Triangle> triangles;  ///< #F×3, node indices, outward by the right-hand rule
  std::string source;
};

/// Signed volume of a tetrahedron, m³; positive when (x1−x0, x2−x0, x3−x0) is right-handed.
inline double signed_volume(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) {
  return (x1 - x0).cross(x2 - x0).dot(x3 - x0) / 6.0;
}

}  // namespace heml
