#pragma once
// Internal state of elements (viscosity, relaxation, plasticity): lists with a fixed number of values per slot. The
// owner of such lists names all of them in one function (GroupTerm::slot_states(), PlasticFlow::slot_states()). Edits
// of the group, undo and snapshots copy the lists without knowing their meaning.
#include <heml/math/bytes.hpp>
#include <vector>

namespace heml {

template <class Real>
struct SlotState {
  std::vector<Real>* values;  ///< each × padded #S
  std::size_t each;           ///< values per slot
};

template <class Real>
using SlotStates = std::vector<SlotState<Real>>;

}  // namespace heml
