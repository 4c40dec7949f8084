#include <algorithm>
#include <heml/dynamics/supernodes.hpp>

namespace heml {
namespace {

std::size_t index_of(int n) { return static_cast<std::size_t>(n); }

std::vector<int> inverse_of(const std::vector<int>& order) {
  std::vector<int> inverse(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) inverse[index_of(order[k])] = static_cast<int>(k);
  return inverse;
}

/// Parents in the elimination tree by place in the order (Liu 1986); −1: a root.
std::vector<int> elimination_tree(const NodeGraph& graph, const std::vector<int>& order) {
  const std::vector<int> place = inverse_of(order);
  std::vector<int> parent(order.size(), -1), ancestor(order.size(), -1);
  for (std::size_t k = 0; k < order.size(); ++k)
    for (const int neighbour : graph.neighbours(order[k])) {
      int p = place[index_of(neighbour)];
      if (p >= static_cast<int>(k)) continue;
      while (ancestor[index_of(p)] >= 0 && ancestor[index_of(p)] != static_cast<int>(k)) {
        const int next = ancestor[index_of(p)];
        ancestor[index_of(p)] = static_cast<int>(k);
        p = next;
      }
      if (ancestor[index_of(p)] < 0) parent[index_of(p)] = ancestor[index_of(p)] = static_cast<int>(k);
    }
  return parent;
}

/// The vertices of a forest, each after its children and next to its subtree. Vertices marked absent are left out.
std::vector<int> postorder(const std::vector<int>& parent, const std::vector<bool>& absent = {}) {
  const std::size_t count = parent.size();
  std::vector<int> child(count, -1), sibling(count, -1), order, path;
  std::vector<int> roots;
  for (std::size_t v = count; v-- > 0;) {
    if (!absent.empty() && absent[v]) continue;
    if (parent[v] < 0) {
      roots.push_back(static_cast<int>(v));
    } else {
      sibling[v] = child[index_of(parent[v])];
      child[index_of(parent[v])] = static_cast<int>(v);
    }
  }
  order.reserve(count);
  for (; !roots.empty(); roots.pop_back()) {
    path.assign(1, roots.back());
    while (!path.empty()) {
      const int v = path.back();
      const int next = child[index_of(v)];
      if (next >= 0) {
        child[index_of(v)] = sibling[index_of(next)];
        path.push_back(next);
      } else {
        order.push_back(v);
        path.pop_back();
      }
    }
  }
  return order;
}

/// Later neighbours in the factor of the node at each place: walks up the tree from each neighbour in a row.
std::vector<int> column_counts(const NodeGraph& graph, const std::vector<int>& order, const std::vector<int>& parent) {
  const std::vector<int> place = inverse_of(order);
  std::vector<int> counts(order.size(), 0), seen(order.size(), -1);
  for (std::size_t k = 0; k < order.size(); ++k) {
    seen[k] = static_cast<int>(k);
    for (const int neighbour : graph.neighbours(order[k]))
      for (int p = place[index_of(neighbour)]; p < static_cast<int>(k) && seen[index_of(p)] != static_cast<int>(k);
           p = parent[index_of(p)]) {
        ++counts[index_of(p)];
        seen[index_of(p)] = static_cast<int>(k);
      }
  }
  return counts;
}

/// Supernodes while they are merged.
struct MergedNode {
  std::vector<int> nodes;
  double rows = 0;   ///< later nodes
  double zeros = 0;  ///< blocks stored that are 0
  std::vector<int> children = {};

  double stored() const { return stored(static_cast<double>(nodes.size())); }
  double stored(double columns) const { return columns * (columns + 1) / 2 + columns * rows; }
};

/// Whether the zeros of a merged supernode cost less than its smaller part does.
bool is_worth_merging(double columns, double zeros, double stored) {
  return columns <= 4 || (columns <= 8 && zeros < 0.3 * stored) || (columns <= 16 && zeros < 0.1 * stored) ||
         zeros < 0.02 * stored;
}

/// Merges children into `into` as long as that is worth it.
void merge_children(std::vector<MergedNode>& list, std::size_t into, std::vector<int>& parent,
                    std::vector<bool>& gone) {
  std::vector<int> waiting = std::move(list[into].children);
  std::stable_sort(waiting.begin(), waiting.end(),
                   [&](int a, int b) { return list[index_of(a)].rows > list[index_of(b)].rows; });
  for (const int c : waiting) {
    MergedNode &child = list[index_of(c)], &node = list[into];
    const auto columns = static_cast<double>(child.nodes.size() + node.nodes.size());
    const double stored = node.stored(columns);
    const double zeros = stored - (child.stored() - child.zeros) - (node.stored() - node.zeros);
    if (!is_worth_merging(columns, zeros, stored)) continue;
    child.nodes.insert(child.nodes.end(), node.nodes.begin(), node.nodes.end());
    node.nodes = std::move(child.nodes);
    node.zeros = zeros;
    gone[index_of(c)] = true;
    for (const int grandchild : child.children) parent[index_of(grandchild)] = static_cast<int>(into);
    node.children.insert(node.children.end(), child.children.begin(), child.children.end());
  }
  for (const int c : waiting)
    if (!gone[index_of(c)]) list[into].children.push_back(c);
}

}  // namespace

Supernodes::Supernodes(const NodeGraph& graph, const std::vector<int>& little_fill) {
  std::vector<int> tree = elimination_tree(graph, little_fill);
  for (const int k : postorder(tree)) order.push_back(little_fill[index_of(k)]);
  tree = elimination_tree(graph, order);
  const std::vector<int> counts = column_counts(graph, order, tree);

  std::vector<MergedNode> list;
  std::vector<int> supernode_of(order.size()), above;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool goes_on = k > 0 && tree[k - 1] == static_cast<int>(k) && counts[k - 1] == counts[k] + 1;
    if (!goes_on) list.emplace_back();
    list.back().nodes.push_back(order[k]);
    list.back().rows = counts[k];
    supernode_of[k] = static_cast<int>(list.size()) - 1;
  }
  above.assign(list.size(), -1);
  for (std::size_t k = 0; k < order.size(); ++k)
    if (tree[k] >= 0 && supernode_of[index_of(tree[k])] != supernode_of[k]) {
      above[index_of(supernode_of[k])] = supernode_of[index_of(tree[k])];
      list[index_of(supernode_of[index_of(tree[k])])].children.push_back(supernode_of[k]);
    }
  std::vector<bool> gone(list.size(), false);
  for (std::size_t s = 0; s < list.size(); ++s) merge_children(list, s, above, gone);

  const std::vector<int> final_order = postorder(above, gone);
  std::vector<int> number(list.size(), -1);
  for (std::size_t s = 0; s < final_order.size(); ++s) number[index_of(final_order[s])] = static_cast<int>(s);
  order.clear();
  for (const int s : final_order) {
    order.insert(order.end(), list[index_of(s)].nodes.begin(), list[index_of(s)].nodes.end());
    first.push_back(static_cast<int>(order.size()));
    parent.push_back(above[index_of(s)] < 0 ? -1 : number[index_of(above[index_of(s)])]);
  }
  find_rows(graph);
}

double Supernodes::work(std::size_t s) const {
  const double k = 3 * static_cast<double>(columns(s)), u = 3 * static_cast<double>(rows(s).size());
  return k * (k * k / 6 + k * u / 2 + u * u / 2);
}

double Supernodes::work() const {
  double sum = 0;
  for (std::size_t s = 0; s < size(); ++s) sum += work(s);
  return sum;
}

void Supernodes::find_rows(const NodeGraph& graph) {
  const std::vector<int> place = inverse_of(order);
  std::vector<int> seen(order.size(), -1);
  std::vector<std::vector<std::size_t>> children(size());
  for (std::size_t s = 0; s < size(); ++s) {
    const int end = first[s + 1];
    const auto add = [&](int k) {
      if (k < end || seen[index_of(k)] == static_cast<int>(s)) return;
      seen[index_of(k)] = static_cast<int>(s);
      row.push_back(k);
    };
    for (int k = first[s]; k < end; ++k)
      for (const int neighbour : graph.neighbours(order[index_of(k)])) add(place[index_of(neighbour)]);
    for (const std::size_t child : children[s])
      for (int r = row_start[child]; r < row_start[child + 1]; ++r) add(row[index_of(r)]);
    std::sort(row.begin() + row_start[s], row.end());
    row_start.push_back(static_cast<int>(row.size()));
    if (parent[s] >= 0) children[index_of(parent[s])].push_back(s);
  }
}

}  // namespace heml
