#pragma once
// Nodes chosen in the image (window/selection_drag.hpp), to fix or load (selection_section.hpp).
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace heml::panel {

class NodeSelection {
 public:
  enum class How { replace, add, remove };

  const std::vector<int>& nodes() const { return nodes_; }  ///< mesh-file numbers, ascending
  bool is_empty() const { return nodes_.empty(); }
  void clear() { nodes_.clear(); }
  /// Drops those that a mesh of so many nodes does not have.
  void keep_below(std::size_t count) {
    std::erase_if(nodes_, [&](int node) { return static_cast<std::size_t>(node) >= count; });
  }

  /// nodes: mesh-file numbers, ascending, each once.
  void take(const std::vector<int>& nodes, How how) {
    std::vector<int> result;
    if (how == How::add)
      std::set_union(nodes_.begin(), nodes_.end(), nodes.begin(), nodes.end(), std::back_inserter(result));
    else if (how == How::remove)
      std::set_difference(nodes_.begin(), nodes_.end(), nodes.begin(), nodes.end(), std::back_inserter(result));
    else
      result = nodes;
    nodes_ = std::move(result);
  }

 private:
  std::vector<int> nodes_;
};

}  // namespace heml::panel
