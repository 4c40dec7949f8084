#pragma once
// From an organ to its mesh: contour, remesh, fill, improve.
#include "organ.hpp"

namespace heml::make {

/// Tetrahedra of an organ with its regions. Depends on the organ alone.
TetMesh mesh_of(const Organ& organ);

}  // namespace heml::make
