#include <Eigen/Eigenvalues>
#include <Eigen/OrderingMethods>
#include <algorithm>
#include <heml/dynamics/nested_dissection.hpp>
#include <limits>
#include <numeric>

namespace heml {
namespace {

constexpr std::size_t max_part = 1000;  // nodes of a part that is not divided further
constexpr double max_half = 0.6;        // part of the nodes that one half may have
constexpr int max_passes = 6;           // of refinement
constexpr std::size_t max_futile = 60;  // moves of a pass without a smaller separator

/// Divides the nodes of one part after another.
class Bisection {
  enum Side : char { left, right, separator, outside };

 public:
  Bisection(const NodeGraph& graph, const std::vector<Vec3>& position)
      : graph_(graph),
        position_(position),
        side_(graph.size(), outside),
        key_(graph.size()),
        count_(graph.size()),
        moved_in_(graph.size(), 0) {}

  /// Reorders the nodes into left half, right half, separator, and returns where the latter two begin.
  std::array<std::size_t, 2> divide(std::span<int> nodes) {
    choose_plane(nodes);
    split(nodes);
    take_separator(nodes);
    for (int pass = 0; pass < max_passes && refine(); ++pass) {
    }
    std::array<std::size_t, 2> begin{};
    const auto sides = [this](int n) { return side_[at(n)]; };
    const auto middle = std::stable_partition(nodes.begin(), nodes.end(), [&](int n) { return sides(n) == left; });
    const auto end = std::stable_partition(middle, nodes.end(), [&](int n) { return sides(n) == right; });
    begin[0] = static_cast<std::size_t>(middle - nodes.begin());
    begin[1] = static_cast<std::size_t>(end - nodes.begin());
    for (const int n : nodes) side_[at(n)] = outside;
    return begin;
  }

 private:
  struct Move {
    int node;
    Side to;
    std::size_t pulled;  ///< size of pulled_ after the move
  };
  static std::size_t at(int n) { return static_cast<std::size_t>(n); }

  /// Of the axes and the direction of greatest extent, the normal of the plane that cuts fewest edges.
  void choose_plane(std::span<int> nodes) {
    Vec3 mean = Vec3::Zero();
    for (const int n : nodes) mean += position_[at(n)];
    mean /= static_cast<double>(nodes.size());
    Mat3 covariance = Mat3::Zero();
    for (const int n : nodes) covariance += (position_[at(n)] - mean) * (position_[at(n)] - mean).transpose();
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(covariance);
    const std::array<Vec3, 4> normals = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(), axes.eigenvectors().col(2)};
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    Vec3 best = normals[0];
    for (const Vec3& normal : normals) {
      set_keys(nodes, normal);
      split(nodes);
      const std::size_t cut = boundary(nodes, left);
      if (cut < fewest) best = normal;
      fewest = std::min(cut, fewest);
    }
    set_keys(nodes, best);
  }

  void set_keys(std::span<int> nodes, const Vec3& normal) {
    for (const int n : nodes) key_[at(n)] = normal.dot(position_[at(n)]);
  }

  void split(std::span<int> nodes) {
    const auto middle = nodes.begin() + static_cast<std::ptrdiff_t>(nodes.size() / 2);
    std::nth_element(nodes.begin(), middle, nodes.end(),
                     [this](int a, int b) { return key_[at(a)] != key_[at(b)] ? key_[at(a)] < key_[at(b)] : a < b; });
    for (auto n = nodes.begin(); n != nodes.end(); ++n) side_[at(*n)] = n < middle ? left : right;
  }

  /// Number of nodes of a half with a neighbour in the other.
  std::size_t boundary(std::span<const int> nodes, Side of) const {
    return static_cast<std::size_t>(std::count_if(nodes.begin(), nodes.end(), [&](int n) {
      return side_[at(n)] == of && neighbours_in(n, of == left ? right : left) > 0;
    }));
  }

  int neighbours_in(int node, Side side) const {
    const auto list = graph_.neighbours(node);
    return static_cast<int>(std::count_if(list.begin(), list.end(), [&](int m) { return side_[at(m)] == side; }));
  }

  /// The smaller boundary becomes the separator.
  void take_separator(std::span<const int> nodes) {
    const Side of = boundary(nodes, left) <= boundary(nodes, right) ? left : right;
    const Side other = of == left ? right : left;
    separator_.clear();
    size_ = {0, 0};
    for (const int n : nodes)
      if (side_[at(n)] == of && neighbours_in(n, other) > 0) separator_.push_back(n);
    for (const int n : separator_) side_[at(n)] = separator;
    for (const int n : nodes)
      if (side_[at(n)] != separator) ++size_[side_[at(n)]];
    for (const int n : separator_) count(n);
    total_ = nodes.size();
  }

  void count(int n) { count_[at(n)] = {neighbours_in(n, left), neighbours_in(n, right)}; }

  /// One pass of moves out of the separator, kept up to its smallest size. Returns whether it became smaller or the
  /// halves more alike.
  bool refine() {
    const std::size_t size = separator_.size();
    const std::size_t difference = imbalance();
    std::size_t best_size = size, best_difference = difference, best_moves = 0;
    moves_.clear();
    pulled_.clear();
    ++pass_;
    while (moves_.size() - best_moves < max_futile && make_best_move()) {
      const std::size_t now = separator_.size(), uneven = imbalance();
      if (now > best_size || (now == best_size && uneven >= best_difference)) continue;
      best_size = now;
      best_difference = uneven;
      best_moves = moves_.size();
    }
    while (moves_.size() > best_moves) take_back();
    return best_size < size;
  }

  std::size_t imbalance() const { return std::max(size_[0], size_[1]) - std::min(size_[0], size_[1]); }

  /// Moves the node that makes the separator smallest, also if that is larger than before. A node moves once a pass.
  bool make_best_move() {
    int best_gain = std::numeric_limits<int>::min();
    std::size_t best = 0;
    Side to = left;
    for (std::size_t k = 0; k < separator_.size(); ++k) {
      if (moved_in_[at(separator_[k])] == pass_) continue;
      for (const Side side : {size_[0] <= size_[1] ? left : right, size_[0] <= size_[1] ? right : left}) {
        const int gain = 1 - count_[at(separator_[k])][side == left ? 1 : 0];
        if (gain <= best_gain || static_cast<double>(size_[side] + 1) > max_half * static_cast<double>(total_))
          continue;
        best_gain = gain;
        best = k;
        to = side;
      }
    }
    if (best_gain == std::numeric_limits<int>::min()) return false;
    const int node = separator_[best];
    separator_[best] = separator_.back();
    separator_.pop_back();
    put(node, to);
    moved_in_[at(node)] = pass_;
    const Side other = to == left ? right : left;
    for (const int m : graph_.neighbours(node)) {
      if (side_[at(m)] != other) continue;
      put(m, separator);
      count(m);
      separator_.push_back(m);
      pulled_.push_back(m);
    }
    moves_.push_back({node, to, pulled_.size()});
    return true;
  }

  /// Changes the side of a node and the counts of its neighbours in the separator.
  void put(int node, Side to) {
    const Side from = side_[at(node)];
    side_[at(node)] = to;
    if (from != separator) --size_[from];
    if (to != separator) ++size_[to];
    for (const int m : graph_.neighbours(node)) {
      if (side_[at(m)] != separator) continue;
      if (from != separator) --count_[at(m)][from];
      if (to != separator) ++count_[at(m)][to];
    }
  }

  void take_back() {
    const Move move = moves_.back();
    moves_.pop_back();
    const std::size_t before = moves_.empty() ? 0 : moves_.back().pulled;
    for (; pulled_.size() > before; pulled_.pop_back()) {
      const int m = pulled_.back();
      separator_.erase(std::find(separator_.begin(), separator_.end(), m));
      put(m, move.to == left ? right : left);
    }
    put(move.node, separator);
    count(move.node);
    separator_.push_back(move.node);
  }

  const NodeGraph& graph_;
  const std::vector<Vec3>& position_;
  std::vector<Side> side_;
  std::vector<double> key_;
  std::vector<std::array<int, 2>> count_;  ///< of nodes in the separator: neighbours in the halves
  std::vector<int> separator_, pulled_;
  std::vector<int> moved_in_;  ///< the pass in which a node last moved
  int pass_ = 0;
  std::vector<Move> moves_;
  std::array<std::size_t, 2> size_{};  ///< of the halves
  std::size_t total_ = 0;
};

/// Reorders the nodes of a part by approximate minimum degree. number: #nodes of the graph, −1, scratch memory.
void minimum_degree(const NodeGraph& graph, std::span<int> nodes, std::vector<int>& number) {
  if (nodes.empty()) return;
  for (std::size_t k = 0; k < nodes.size(); ++k) number[static_cast<std::size_t>(nodes[k])] = static_cast<int>(k);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    entries.emplace_back(static_cast<int>(k), static_cast<int>(k), 1.0);
    for (const int m : graph.neighbours(nodes[k]))
      if (number[static_cast<std::size_t>(m)] >= 0)
        entries.emplace_back(static_cast<int>(k), number[static_cast<std::size_t>(m)], 1.0);
  }
  const auto size = static_cast<Eigen::Index>(nodes.size());
  Eigen::SparseMatrix<double> pattern(size, size);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic> order;
  Eigen::AMDOrdering<int>()(pattern, order);
  const std::vector<int> before(nodes.begin(), nodes.end());
  for (std::size_t k = 0; k < nodes.size(); ++k)
    nodes[k] = before[static_cast<std::size_t>(order.indices()[static_cast<Eigen::Index>(k)])];
  for (const int n : nodes) number[static_cast<std::size_t>(n)] = -1;
}

}  // namespace

std::vector<int> minimum_degree(const NodeGraph& graph) {
  std::vector<int> order(graph.size()), number(graph.size(), -1);
  std::iota(order.begin(), order.end(), 0);
  minimum_degree(graph, order, number);
  return order;
}

std::vector<int> nested_dissection(const NodeGraph& graph, const std::vector<Vec3>& position) {
  std::vector<int> order(graph.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<int> number(graph.size(), -1);
  Bisection bisection(graph, position);
  std::vector<std::span<int>> parts{order};
  while (!parts.empty()) {
    const std::span<int> part = parts.back();
    parts.pop_back();
    if (part.size() <= max_part) {
      minimum_degree(graph, part, number);
      continue;
    }
    const auto [second, third] = bisection.divide(part);
    if (second == 0 || third == second) {  // no two halves: nearly all nodes are coupled
      minimum_degree(graph, part, number);
      continue;
    }
    parts.push_back(part.first(second));
    parts.push_back(part.subspan(second, third - second));
  }
  return order;
}

}  // namespace heml
