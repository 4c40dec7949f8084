#pragma once
// Where the lips of a wound are drawn at rest. A cut passes through nodes that lie beside the blade's path, so that its
// rim zigzags by a fraction of an element. The rim and the faces below it are smoothed across the cut, by the same
// amount on both sides; the lips then part a little, so that a closed cut shows:
//
//      rim in the mesh      smoothed        parted
//        ╲    ╱   ╲           │              │ │
//         ╲  ╱     ╲          │              │ │      the skin beside the rim moves with it
//          ╲╱       ╲         │              │ │
#include <heml/session/original_skin.hpp>

namespace heml::render {

/// Nodes of a surface with the same position at rest: the two sides of a cut, or more where cuts cross.
struct WoundSite {
  std::vector<int> nodes;        ///< indices into SurfaceMesh::nodes
  std::vector<int> rim, around;  ///< neighbouring sites along the rim, over exposed faces
  Vec3f across = Vec3f::Zero();  ///< unit, normal of the exposed faces, of either sign
};

/// The sites of all nodes of exposed faces.
std::vector<WoundSite> wound_sites(const SurfaceMesh& surface_mesh, const std::vector<char>& exposed);

/// Displacements of the nodes at rest, #S×3, m: zero far from wounds. Turns no face of the skin over. opening: m, half
/// the gap at the rim of a closed cut.
std::vector<Vec3f> lip_displacements(const SurfaceMesh& surface_mesh, const OriginalSkin& skin,
                                     const std::vector<WoundSite>& sites, float opening);

}  // namespace heml::render
