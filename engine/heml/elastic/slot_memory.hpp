#pragma once
// What elements remember of how they were deformed: lists with so many numbers a slot of their group. Whatever
// remembers names all of its lists in one function (GroupTerm::memory(), PlasticFlow::memory()). Edits of the group,
// undo and copies of a state carry those lists, and know nothing else of who keeps them.
#include <heml/math/bytes.hpp>
#include <vector>

namespace heml {

template <class Real>
struct SlotMemory {
  std::vector<Real>* values;  ///< each × padded #S
  std::size_t each;           ///< numbers a slot
};

template <class Real>
using SlotMemories = std::vector<SlotMemory<Real>>;

}  // namespace heml
