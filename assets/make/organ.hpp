#pragma once
// An organ as the mesher sees it.
#include <heml/mesh/tet_mesh.hpp>
#include <string>

#include "shape.hpp"

namespace heml::make {

struct Organ {
  std::string name;
  Shape shape;
  std::function<int(const Vec3& p)> region;     ///< tag of the part nearest to p
  std::function<double(const Vec3& p)> detail;  ///< edge length at p as a share of `edge`
  Vec3 low, high;                               ///< m, a box that holds the body
  double edge;                                  ///< m, edge length of the surface triangles where detail is 1
  double depth;                                 ///< m, how far under the surface interior nodes start
  double spacing;                               ///< m, their mutual distance
  double enough;                                ///< Quality from which on surface nodes are left where they are
};

/// A left kidney, 11 cm, with renal artery, renal vein and ureter. x medial, y superior, z anterior.
/// Regions: 1 parenchyma, 2 vessels and ureter. edge: m, of the surface's triangles.
Organ kidney(std::string name, double edge);

/// A uterus, 8 cm, with its cavity, cervical canal and the roots of both tubes. x left, y superior, z anterior.
/// Regions: 1 wall of the body, 2 cervix, 3 tubes.
Organ uterus();

/// A liver, 21 cm, with the inferior vena cava above it. x left, y superior, z anterior.
/// Regions: 1 parenchyma, 2 vena cava.
Organ liver();

/// A cube of 0.1 m with irregular tetrahedra: 151 nodes, 407 tetrahedra.
TetMesh irregular_cube();

/// A cube of 0.1 m of 7 × 7 × 7 cells: 512 nodes, 1715 tetrahedra. Regions: 1, and 2 a ball of 4 cm across inside it.
TetMesh inclusion();

}  // namespace heml::make
