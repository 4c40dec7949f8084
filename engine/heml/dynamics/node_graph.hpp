#pragma once
// Undirected graph of nodes: both directions of every edge, no loops.
#include <span>
#include <vector>

namespace heml {

struct NodeGraph {
  std::vector<int> start{0};  ///< #nodes + 1
  std::vector<int> neighbour;

  std::size_t size() const { return start.size() - 1; }
  std::span<const int> neighbours(int node) const {
    const auto n = static_cast<std::size_t>(node);
    return {neighbour.data() + start[n], neighbour.data() + start[n + 1]};
  }
};

}  // namespace heml
