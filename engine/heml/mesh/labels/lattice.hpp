#pragma once
// A body-centred cubic lattice of tetrahedra over a field of regions, finest where labels meet, twice and four times as
// coarse inside (after F. Labelle & J. Shewchuk, Isosurface stuffing, ACM Transactions on Graphics 26(3), 2007).
//
//      two cells of equal size share a face      a tetrahedron has both centres c, c' and one edge of the face; where
//         +-----+-----+                          a smaller cell touches that edge, it is halved at the edge's middle
//         |  c  |  c' |
//         +-----+-----+                          cells of unequal size: each centre with the triangles (M, m, C) of
//                                                the larger face's middle, an edge's middle and a corner
#include <cstdint>
#include <heml/mesh/labels/region_field.hpp>
#include <heml/mesh/tet_mesh.hpp>

namespace heml {

struct Lattice {
  std::vector<Vec3> nodes;
  std::vector<std::uint8_t> labels;  ///< #V
  std::vector<Tet> tets;             ///< #T, positive; all but those whose nodes all lie outside
  double cell = 0;                   ///< side of the finest cells, m
};

/// low, high: box of the labels, m. cell: side of the finest cells, m. An element with several labels has nodes of
/// finest cells only. Throws InputError for more than 2·10⁸ cells.
Lattice make_lattice(const RegionField& field, const Vec3& low, const Vec3& high, double cell,
                     const std::string& source);

}  // namespace heml
