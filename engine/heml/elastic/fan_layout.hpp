#pragma once
// Elements cut into blocks of fans (elastic/fan_block.hpp), and the nodes that blocks share. The layout depends on the
// mesh, its edits and the number of lanes alone, so sums are the same whichever thread runs a block.
//
// After an edit of the mesh the blocks that it touched are cut again, from their remaining elements and pieces. Other
// blocks are kept; only the numbers of their elements change:
//
//     before   | block 0 | block 1 | block 2 |           a cut through block 1 and its neighbour 2
//     after    | block 0 | 1a | 1b | block 2'|           a block that has grown too large becomes several
//
// A shared node of a kept block stays shared, even if no other block uses it any more.
#include <functional>
#include <heml/base/thread_team.hpp>
#include <heml/elastic/fan_block.hpp>
#include <heml/elastic/node_blocks.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <new>
#include <vector>

namespace heml {

/// Allocator that aligns arrays to cache lines (64 bytes).
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

/// Which constants a law needs per tetrahedron (elastic/fan_block.hpp).
enum class FanShape { plain, fibre, principal };

/// The elements of one law.
struct FanElements {
  std::vector<int> elements;  ///< inner numbers, in locality order
  FanShape shape = FanShape::plain;
  std::function<Vec3(int element)> fibre = {};  ///< a0, of FanShape::fibre and for active stress
  bool has_fibre_beside = false;                ///< whether its constants come last, since the law has none
  /// Parameters that differ between elements, each of every element of the mesh.
  std::vector<const std::vector<double>*> parameters = {};

  /// Numbers a tetrahedron.
  std::size_t constants() const {
    return fan_constants(shape == FanShape::fibre) + parameters.size() + (has_fibre_beside ? 3 : 0);
  }
};

template <class Real>
struct FanLayout {
  /// Where a block's data begin in the lists below.
  struct Block {
    std::size_t part;  ///< index into the list of FanElements
    std::size_t group, index, shape, element;
    std::size_t groups, elements;
  };
  std::vector<Block> blocks;  ///< of all parts, in the order of their elements
  std::vector<FanSize> size;
  std::vector<std::uint16_t> index;
  std::vector<Real, CacheAligned<Real>> shape;
  NodeBlocks nodes;          ///< of the same blocks
  std::vector<int> element;  ///< inner numbers of each block's elements, for edits

  FanLayout() = default;
  /// mesh: in inner order, positive volumes. lanes: of the kernel that will run. The result does not depend on the
  /// team.
  FanLayout(const TetMesh& mesh, const std::vector<FanElements>& parts, std::size_t lanes, ThreadTeam& team);

  /// The layout after an edit of the mesh: element t is the old element origins[t], which may have been burnt, or a
  /// piece of it whose nodes are those of the old element or new. The number of parts must not change. Other arguments
  /// as in the constructor.
  FanLayout after_edit(const TetMesh& before, const TetMesh& mesh, const std::vector<FanElements>& parts,
                       const std::vector<int>& origins, std::size_t lanes, ThreadTeam& team) const;

  std::size_t elements() const { return element.size(); }
  /// Bytes per tetrahedron that one force evaluation reads and writes, each array counted once, positions and forces
  /// included.
  double bytes_per_tet() const;
};

}  // namespace heml
