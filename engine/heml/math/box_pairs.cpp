#include <algorithm>
#include <deque>
#include <heml/math/box_pairs.hpp>
#include <unsupported/Eigen/BVH>

namespace heml {
namespace {

using Box = Eigen::AlignedBox3d;

/// A tree of boxes, and the walk over pairs of its nodes. A node is a volume of the tree or one box.
struct BoxTree {
  using Tree = Eigen::KdBVH<double, 3, int>;
  struct Node {
    int index;
    bool is_box;
  };
  struct Children {
    Node node[2];
    int count = 0;
  };

  BoxTree(const std::vector<int>& indices, const std::vector<Box>& boxes) : all(boxes) {
    std::vector<Box> own;
    for (const int i : indices) own.push_back(boxes[static_cast<std::size_t>(i)]);
    tree.init(indices.begin(), indices.end(), own.begin(), own.end());
    root = indices.size() == 1 ? Node{indices[0], true} : Node{tree.getRootIndex(), false};
  }
  const Box& box(Node node) const {
    return node.is_box ? all[static_cast<std::size_t>(node.index)] : tree.getVolume(node.index);
  }
  Children children(Node node) const {
    Tree::VolumeIterator volume{}, volumes_end{};
    Tree::ObjectIterator object{}, objects_end{};
    tree.getChildren(node.index, volume, volumes_end, object, objects_end);
    Children result;
    for (; volume != volumes_end; ++volume) result.node[result.count++] = {*volume, false};
    for (; object != objects_end; ++object) result.node[result.count++] = {*object, true};
    return result;
  }

  const std::vector<Box>& all;
  Tree tree;
  Node root{};
};

struct PairSearch {
  /// Pairs of boxes below one node.
  void among(const BoxTree& tree, BoxTree::Node node) {
    if (node.is_box) return;
    const BoxTree::Children children = tree.children(node);
    for (int k = 0; k < children.count; ++k) among(tree, children.node[k]);
    if (children.count == 2) between(tree, children.node[0], tree, children.node[1], 0);
  }
  /// Pairs of a box below one and a box below the other.
  void between(const BoxTree& one, BoxTree::Node a, const BoxTree& other, BoxTree::Node b, double margin) {
    const Box &left = one.box(a), &right = other.box(b);
    if (!are_near(left, right, margin)) return;
    if (a.is_box && b.is_box) {
      found.emplace_back(std::min(a.index, b.index), std::max(a.index, b.index));
    } else if (b.is_box || (!a.is_box && left.diagonal().squaredNorm() > right.diagonal().squaredNorm())) {
      const BoxTree::Children children = one.children(a);
      for (int k = 0; k < children.count; ++k) between(one, children.node[k], other, b, margin);
    } else {
      const BoxTree::Children children = other.children(b);
      for (int k = 0; k < children.count; ++k) between(one, a, other, children.node[k], margin);
    }
  }
  std::vector<std::pair<int, int>> found = {};
};

}  // namespace

std::vector<std::pair<int, int>> intersecting_pairs(const std::vector<Box>& boxes, const std::vector<int>& group,
                                                    double between, bool within) {
  std::vector<std::vector<int>> groups(1);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const std::size_t g = group.empty() ? 0 : static_cast<std::size_t>(group[i]);
    if (groups.size() <= g) groups.resize(g + 1);
    groups[g].push_back(static_cast<int>(i));
  }
  std::deque<BoxTree> trees;
  std::vector<Box> round_trees;  // widened: many groups are searched for near ones as boxes are
  for (const std::vector<int>& indices : groups) {
    if (indices.empty()) continue;
    const BoxTree& tree = trees.emplace_back(indices, boxes);
    const Eigen::Vector3d more = Eigen::Vector3d::Constant(between);
    round_trees.emplace_back(tree.box(tree.root).min() - more, tree.box(tree.root).max() + more);
  }
  PairSearch search;
  if (within)
    for (const BoxTree& tree : trees) search.among(tree, tree.root);
  if (trees.size() > 1)
    for (const auto& [a, b] : intersecting_pairs(round_trees)) {
      const BoxTree &one = trees[static_cast<std::size_t>(a)], &other = trees[static_cast<std::size_t>(b)];
      search.between(one, one.root, other, other.root, between);
    }
  return search.found;
}

}  // namespace heml
