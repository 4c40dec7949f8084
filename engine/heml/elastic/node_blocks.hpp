#pragma once
// Nodes of blocks of elements, each of which adds up what its elements pull at its nodes. A node of one block alone is
// its own, and the block writes the sum. A node of several blocks is shared: each writes its part into a slot, and the
// parts are added in the order of the blocks. So sums are the same whichever thread runs a block.
//
//   blocks ──► own nodes ──► f
//         └──► slots of shared nodes ──► summed in the order of blocks ──► f
#include <cstdint>
#include <heml/base/thread_team.hpp>
#include <heml/math/bytes.hpp>
#include <vector>

namespace heml {

/// Number of blocks of each part, whose elements are given: of at most `most` elements, all of about equal size, and in
/// all a power of two or a multiple of 16, or nearly so, for threads to get equal shares. 0 for a part without
/// elements.
std::vector<std::size_t> block_counts(const std::vector<std::size_t>& elements, std::size_t most);

struct NodeBlocks {
  struct Block {
    std::size_t place;        ///< of its first node in the list below
    std::size_t own, nodes;   ///< number of nodes that are its own, and of all; its own come first
    std::size_t shared_slot;  ///< of its first shared node; the others follow
    bool operator==(const Block&) const = default;
  };
  std::vector<Block> blocks;
  std::vector<std::uint32_t> place;  ///< 3 n of each block's nodes n

  // Nodes that are no block's own: those of several blocks, and those of none.
  std::vector<int> shared_node;           ///< inner numbers, ascending
  std::vector<std::size_t> shared_start;  ///< #shared_node + 1
  std::vector<std::size_t> shared_slot;   ///< of node k: shared_start[k] .. shared_start[k+1], ascending by block
  std::size_t shared_slots = 0;

  NodeBlocks() = default;
  /// nodes: of each block, distinct; put into the order of `place`: own ones first, each kind in the order given.
  /// is_shared: #V, nodes that are shared even if they are of one block.
  NodeBlocks(std::vector<std::vector<int>*> nodes, std::vector<char> is_shared);

  /// Writes into of_node (`numbers` a node) the sums of what the blocks have written into of_slot (`numbers` a slot).
  template <std::size_t numbers, class Real>
  void sum_shared(const Real* of_slot, Real* of_node, ThreadTeam& team) const {
    team.parallel_for(shared_node.size(), shared_grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        Real sum[numbers] = {};
        for (std::size_t s = shared_start[k]; s < shared_start[k + 1]; ++s)
          for (std::size_t i = 0; i < numbers; ++i) sum[i] += of_slot[numbers * shared_slot[s] + i];
        Real* to = of_node + numbers * static_cast<std::size_t>(shared_node[k]);
        for (std::size_t i = 0; i < numbers; ++i) to[i] = sum[i];
      }
    });
  }

  std::size_t bytes() const { return bytes_of(blocks, place, shared_node, shared_start, shared_slot); }
  bool operator==(const NodeBlocks&) const = default;

 private:
  static constexpr std::size_t shared_grain = 128;  ///< min. nodes per thread; fewer cost less than a fork
};

}  // namespace heml
