#pragma once
// Elements cut into blocks of fans (elastic/fan_block.hpp), and which nodes blocks share. Depends on the mesh, its
// edits and the number of lanes alone, so that threads may take any blocks and sums come out the same.
//
// After an edit of the mesh the blocks it touched are cut anew, of what is left of them and of the pieces of what was
// theirs; of the others only numbers of elements change:
//
//     before   | block 0 | block 1 | block 2 |           a cut through block 1 and its neighbour 2
//     after    | block 0 | 1a | 1b | block 2'|           a block that has grown too large becomes several
//
// A node that a kept block shares stays shared in it, also where it is the last to have it.
#include <functional>
#include <heml/base/thread_team.hpp>
#include <heml/elastic/fan_block.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <new>
#include <vector>

namespace heml {

/// Puts data where a cache line begins.
template <class T>
struct CacheAligned {
  using value_type = T;
  CacheAligned() = default;
  template <class U>
  CacheAligned(const CacheAligned<U>&) {}  // NOLINT: as allocators do
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{64})); }
  void deallocate(T* p, std::size_t) { ::operator delete (p, std::align_val_t{64}); }
  bool operator==(const CacheAligned&) const { return true; }
};

/// What the constants of a law's elements are.
enum class FanShape { plain, fibre, principal };

/// The elements of one law.
struct FanElements {
  std::vector<int> elements;  ///< inner numbers, in locality order
  FanShape shape = FanShape::plain;
  std::function<Vec3(int element)> fibre = {};  ///< a0, FanShape::fibre only
};

template <class Real>
struct FanLayout {
  /// Where a block's data begin in the lists below.
  struct Block {
    std::size_t part;  ///< index into the list of FanElements
    std::size_t group, index, shape, place, element, shared_slot;
    std::size_t groups, own, nodes, elements;
  };
  std::vector<Block> blocks;  ///< part after part
  std::vector<FanSize> size;
  std::vector<std::uint16_t> index;
  std::vector<Real, CacheAligned<Real>> shape;
  std::vector<std::uint32_t> place;
  std::vector<int> element;  ///< inner numbers of each block's elements, for edits

  // Nodes that are no block's own: those of several blocks, and those of none.
  std::vector<int> shared_node;           ///< inner numbers, ascending
  std::vector<std::size_t> shared_start;  ///< one more than those
  std::vector<std::size_t> shared_slot;   ///< of the k-th: shared_start[k] .. shared_start[k+1], ascending by block
  std::size_t shared_slots = 0;

  FanLayout() = default;
  /// mesh: in inner order, positive volumes. lanes: of the kernel that will run. The same for any number of threads.
  FanLayout(const TetMesh& mesh, const std::vector<FanElements>& parts, std::size_t lanes, ThreadTeam& team);

  /// The layout after an edit of the mesh: element t is what origins[t] was in the mesh before, or a piece of it, whose
  /// nodes are among that one's or new. Parts as many as they were. Rest as in the constructor.
  FanLayout after_edit(const TetMesh& before, const TetMesh& mesh, const std::vector<FanElements>& parts,
                       const std::vector<int>& origins, std::size_t lanes, ThreadTeam& team) const;

  std::size_t elements() const { return element.size(); }
  /// What one evaluation of the forces reads and writes, each array once, positions and forces included.
  double bytes_per_tet() const;
};

}  // namespace heml
