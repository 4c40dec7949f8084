#pragma once
// Mends surfaces that are open or damaged, so that they can be filled. One that check_surface() accepts stays as it is.
//
//      nodes and triangles   clean_triangles.hpp: welded, split at T-junctions; copies and flat ones removed
//      parts                 parts.hpp: crumbs, inner walls and fins removed
//      holes                 fill_holes.hpp: filled, sheets left out
//      still not closed      remesh.hpp: meshed anew
#include <heml/mesh/from_surface.hpp>
#include <heml/mesh/mend/fill_holes.hpp>
#include <heml/mesh/mend/parts.hpp>

namespace heml {

struct MendReport {
  int welded = 0;                ///< nodes
  int flat = 0, duplicates = 0;  ///< triangles removed
  int split = 0;                 ///< nodes on edges of others, which were split there
  RemovedParts crumbs, walls;
  FilledHoles holes;
  int turned = 0;        ///< triangles that were not turned outward
  int smoothed = 0;      ///< pairs of triangles that crossed at creases, whose nodes were moved apart (untangle.hpp)
  std::string unmended;  ///< what is wrong still, so that the surface is meshed anew; else empty
  int crossings = 0;     ///< pairs of triangles that cross in it, as far as they are counted (intersections.hpp)
};

struct MendedSurface {
  TriangleMesh surface;  ///< one that check_surface() accepts, unless report.unmended
  MendReport report;
};

/// Mends a surface, and warns of each kind of repair in one line. Throws InputError as check_numbers(), for sheets,
/// for surfaces of one side only or without volume, and for a damaged surface of more than 4·10⁶ triangles.
MendedSurface mend_surface(TriangleMesh surface);

/// Fills a mended surface by TetGen; one that is not closed still, or that TetGen cannot fill, is meshed anew.
TetMesh tetrahedralize(const MendedSurface& mended, const TetgenOptions& options = {});

/// What was done, a line each, without the file.
std::vector<std::string> to_lines(const MendReport& report);

}  // namespace heml
