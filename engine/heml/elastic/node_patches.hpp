#pragma once
// Patches of elements round nodes, from whose values fields are fitted (error_estimate.hpp).
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

/// mesh must outlive this.
class NodePatches {
 public:
  /// elements: those of one material. least: elements that a fit needs.
  NodePatches(const TetMesh& mesh, const std::vector<std::size_t>& elements, std::size_t least)
      : mesh_(mesh), least_(least), start_(mesh.nodes.size() + 1, 0), taken_by_(mesh.tets.size(), -1) {
    for (const std::size_t t : elements)
      for (const int n : mesh.tets[t]) ++start_[static_cast<std::size_t>(n) + 1];
    for (std::size_t n = 1; n < start_.size(); ++n) start_[n] += start_[n - 1];
    around_.resize(start_.back());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (const std::size_t t : elements)
      for (const int n : mesh.tets[t]) around_[next[static_cast<std::size_t>(n)]++] = t;
  }

  /// The elements at a node, and as many rings of their neighbours as a fit needs; empty: none of this material.
  const std::vector<std::size_t>& of(int node) {
    patch_.clear();
    add_around(node, node);
    for (std::size_t ring_begin = 0; patch_.size() < least_ && ring_begin < patch_.size();) {
      const std::size_t ring_end = patch_.size();
      for (; ring_begin < ring_end; ++ring_begin)
        for (const int n : mesh_.tets[patch_[ring_begin]]) add_around(n, node);
    }
    return patch_;
  }

 private:
  void add_around(int n, int node) {
    for (std::size_t k = start_[static_cast<std::size_t>(n)]; k < start_[static_cast<std::size_t>(n) + 1]; ++k) {
      if (taken_by_[around_[k]] == node) continue;
      taken_by_[around_[k]] = node;
      patch_.push_back(around_[k]);
    }
  }

  const TetMesh& mesh_;
  std::size_t least_;
  std::vector<std::size_t> start_, around_;  ///< elements at node n: around_[start_[n], start_[n + 1])
  std::vector<int> taken_by_;                ///< #T, node whose patch last took the element
  std::vector<std::size_t> patch_;
};

}  // namespace heml
