#pragma once
// Cuts a lattice where its labels meet: nodes near an interface are moved onto it, the edges that still join two labels
// are bisected there, and each piece belongs to one label. Neighbours cut a shared face alike, so interfaces conform.
#include <heml/mesh/labels/lattice.hpp>

namespace heml {

/// regions: labels (the field's numbers), none outside. Elements are positive. source is left empty.
TetMesh cut_lattice(Lattice lattice, const RegionField& field);

}  // namespace heml
