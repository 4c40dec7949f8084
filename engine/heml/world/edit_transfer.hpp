#pragma once
// Carries an edit of the mesh over to a running simulation.
#include <heml/mesh/edit.hpp>
#include <heml/world/simulation.hpp>
#include <vector>

namespace heml {

/// What an edit leaves of the elements that were there.
struct EditTransfer {
  std::vector<int> elements;  ///< that stay, inner numbers before the edit and, above them, of the pieces
  bool only_removes = false;  ///< straight elements, and none was added: layouts close up instead of being made anew
};

/// Updates setup, model, topology, motion, pins and the body's internal state. Positions and velocities carry over to
/// the nodes that a cut inserts, selections of nodes to those among theirs. What follows from the set of elements
/// (masses, contact, preconditioners) is left to the caller.
template <class Real>
EditTransfer transfer_edit(const MeshEdit& edit, Simulation<Real>& s);

}  // namespace heml
