#pragma once
// Bounds of the eigenvalues of M⁻¹K from those of elements, a node each, evaluated step after step.
//
// With K_e ≤ b_e M_e of every element e (step_bound.hpp), K ≤ Σ b_e M_e, which is diagonal: at node a
//
//     B_a = Σ_e b_e m_ea / Σ_e m_ea  over the elements e at a,  m_ea the mass of e that is lumped there,
//
// the mean of what is round it, weighted by mass. So λ_max(M⁻¹K) ≤ max_a B_a ≤ max_e b_e: a small element among large
// ones counts as much as its mass does.
//
//   bound:   | 0.3 | 1.0 | 0.9 | 0.4 | ... B_a of each node
//   age:     |  14 |   2 |   6 |  30 | ... steps since it was evaluated
//
// A node whose bound was far below the maximum cannot have reached it since: only those that may have are evaluated
// again, with all elements round them. A node is due
// - where 2 · age · growth ≥ largest − bound, growth the fastest that any bound was seen to grow, a step: so always the
//   largest;
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
  static constexpr int max_age = 32;  ///< steps

  /// All nodes are due the next two times: a growth is known from two evaluations.
  void forget();
  /// Nodes that are due each time from now on (ascending).
  void watch(std::vector<int> nodes) { watched_ = std::move(nodes); }

  /// Begins an evaluation `steps` after the last one. nodes: how many there are; another number than before: forget().
  void begin(std::size_t nodes, int steps);
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
  std::vector<std::uint8_t> age_;
  std::vector<int> watched_, due_;
  Real largest_ = 0, growth_ = 0;                                                   ///< growth: a step
  enum class Known { nothing, bounds, bounds_and_growth } known_ = Known::nothing;  ///< bounds alone: all are due
};

}  // namespace heml
