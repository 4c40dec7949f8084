#pragma once
// Symbolic factorisation of a symmetric matrix with one block a pair of nodes: which nodes are eliminated together, and
// which later nodes they are coupled with. Consecutive nodes with the same later neighbours form a supernode, whose
// columns of the factor are one dense matrix. Small supernodes are merged with their parents at the cost of some zeros.
#include <heml/dynamics/node_graph.hpp>

namespace heml {

struct Supernodes {
  std::vector<int> order;         ///< the node eliminated k-th; children before parents, subtrees contiguous
  std::vector<int> first{0};      ///< #supernodes + 1: the first k of each
  std::vector<int> parent;        ///< #supernodes; −1: a root
  std::vector<int> row_start{0};  ///< #supernodes + 1
  std::vector<int> row;           ///< later nodes of each supernode, by their k, ascending

  /// order: the nodes in an order with little fill.
  Supernodes(const NodeGraph& graph, const std::vector<int>& order);

  std::size_t size() const { return parent.size(); }
  std::size_t columns(std::size_t s) const { return static_cast<std::size_t>(first[s + 1] - first[s]); }
  std::span<const int> rows(std::size_t s) const { return {row.data() + row_start[s], row.data() + row_start[s + 1]}; }
  /// Multiplications that eliminate a supernode of 3×3 blocks, and all of them.
  double work(std::size_t s) const;
  double work() const;

 private:
  void find_rows(const NodeGraph& graph);
};

}  // namespace heml
