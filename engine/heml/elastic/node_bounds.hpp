#pragma once
// Bounds B_a of the eigenvalues of M⁻¹K or M⁻¹D, one a node (step_weights.hpp), evaluated step after step; the largest
// holds for the body.
//
//   bound:   | 0.3 | 1.0 | 0.9 | 0.4 | ... B_a of each node
//   age:     |  14 |   2 |   6 |  30 | ... steps since it was evaluated
//   growth:  |        0.02     |       ... a step, one a neighbourhood
//
// A node whose bound was far below the maximum, or below what the present step bears, cannot have reached it since:
// only those that may have are evaluated again, with all elements round them. A node is due
// - where it has the largest bound;
// - where 2 · age · growth ≥ max(largest, bearable) − bound; growth:
//   the fastest that a bound was seen to grow, a step, among the neighbours in inner order, or a quarter of the fastest
//   elsewhere, from where waves take some steps;
// - at max_age;
// - where it is watched: something acts on its elements, whose bounds may grow without notice.
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace heml {

template <class Real>
class NodeBounds {
 public:
  static constexpr int max_age = 32;                ///< steps
  static constexpr std::size_t neighbourhood = 32;  ///< nodes
  static constexpr double elsewhere = 0.25;

  /// All nodes are due the next two times: a growth is known from two evaluations.
  void forget();
  /// Nodes that are due each time from now on (ascending).
  void watch(std::vector<int> nodes) { watched_ = std::move(nodes); }

  /// Begins an evaluation `steps` after the last one. nodes: how many there are; another number than before: forget().
  /// bearable: the bound up to which no node matters; 0: all below the largest do.
  void begin(std::size_t nodes, int steps, Real bearable = 0);
  /// Those to evaluate, ascending.
  const std::vector<int>& due() const { return due_; }
  /// The bound of a due node, once each. Threads: any, each its own nodes.
  void set(std::size_t node, Real bound) { seen_[node] = bound; }
  /// The maximum of all nodes' last bounds; NaN if one of them is.
  Real end();
  /// The node that has it, the first one of several; and the last bounds of all.
  std::size_t largest_node() const;
  const std::vector<Real>& bounds() const { return bound_; }

  std::size_t bytes() const;

 private:
  std::vector<Real> bound_, seen_;  ///< of the evaluation before, and of this one
  std::vector<Real> growth_;        ///< a step, of each neighbourhood
  std::vector<std::uint8_t> age_;
  std::vector<int> watched_, due_;
  Real largest_ = 0;
  enum class Known { nothing, bounds, bounds_and_growth } known_ = Known::nothing;  ///< bounds alone: all are due
};

}  // namespace heml
