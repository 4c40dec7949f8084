#pragma once
// Quadratic elements cut into blocks for their point kernels (point_kernels.hpp). The layout depends on the mesh and
// its materials alone, so sums are the same whichever thread runs a block.
#include <heml/elastic/element_group.hpp>
#include <heml/elastic/node_blocks.hpp>
#include <heml/elastic/virtual_corners.hpp>

namespace heml {

/// Maximum number of elements of a block, so that their nodes fit the first-level cache.
inline constexpr std::size_t max_point_block_elements = 288;

struct PointLayout {
  /// Elements first .. first + elements of a part: those of its slots 4 first ...
  struct Block {
    std::size_t part, first, elements;
    std::size_t index;  ///< where its own begins in the list below
    bool operator==(const Block&) const = default;
  };
  std::vector<Block> blocks;  ///< of all parts, in the order of their elements
  NodeBlocks nodes;           ///< of the same blocks
  /// 10 an element: where the record of each of its nodes begins, in Reals (PointBlock).
  std::vector<std::uint16_t> index;

  PointLayout() = default;
  /// groups: of each part; null where no point kernel takes it.
  template <class Real>
  PointLayout(const std::vector<const ElementGroup<Real>*>& groups, const VirtualCorners<Real>& corners);

  bool operator==(const PointLayout&) const = default;
  std::size_t bytes() const { return bytes_of(blocks, index) + nodes.bytes(); }
};

}  // namespace heml
