#include <algorithm>
#include <cmath>
#include <heml/dynamics/block_matrix.hpp>

namespace heml {

FreeNodes::FreeNodes(const std::vector<bool>& is_free, std::vector<int> held_coordinates)
    : number(is_free.size(), -1), held(std::move(held_coordinates)) {
  for (std::size_t n = 0; n < is_free.size(); ++n)
    if (is_free[n]) {
      number[n] = static_cast<int>(node.size());
      node.push_back(static_cast<int>(n));
    }
}

BlockMatrix::BlockMatrix(const FreeNodes& free, const std::vector<Tet>& tets, std::span<const std::array<int, 2>> pairs)
    : free_(free) {
  const std::size_t count = free.node.size();
  std::vector<std::vector<int>> above(count);
  const auto couple = [&](const auto& nodes) {
    for (const int a : nodes)
      for (const int b : nodes) {
        const int row = free.number[static_cast<std::size_t>(a)], column = free.number[static_cast<std::size_t>(b)];
        if (column >= 0 && row > column) above[static_cast<std::size_t>(column)].push_back(row);
      }
  };
  for (const Tet& tet : tets) couple(tet);
  for (const auto& pair : pairs) couple(pair);
  start_.assign(1, 0);
  for (auto& list : above) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    neighbour_.insert(neighbour_.end(), list.begin(), list.end());
    start_.push_back(neighbour_.size());
  }
  const auto size = static_cast<Eigen::Index>(3 * count);
  matrix_.resize(size, size);
  matrix_.resizeNonZeros(static_cast<Eigen::Index>(6 * count + 9 * neighbour_.size()));
  int next = 0;
  for (std::size_t c = 0; c < count; ++c)
    for (int j = 0; j < 3; ++j) {
      matrix_.outerIndexPtr()[3 * c + static_cast<std::size_t>(j)] = next;
      for (int i = j; i < 3; ++i) matrix_.innerIndexPtr()[next++] = 3 * static_cast<int>(c) + i;
      for (std::size_t k = start_[c]; k < start_[c + 1]; ++k)
        for (int i = 0; i < 3; ++i) matrix_.innerIndexPtr()[next++] = 3 * neighbour_[k] + i;
    }
  matrix_.outerIndexPtr()[3 * count] = next;
  set_zero();
}

void BlockMatrix::set_zero() { std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0); }

void BlockMatrix::isolate_held() {
  if (free_.held.empty()) return;
  std::vector<bool> is_held(static_cast<std::size_t>(matrix_.rows()), false);
  for (const int i : free_.held) is_held[static_cast<std::size_t>(free_.row_of(i))] = true;
  for (int column = 0; column < matrix_.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix_, column); entry; ++entry) {
      const auto row = static_cast<std::size_t>(entry.row());
      if (!is_held[row] && !is_held[static_cast<std::size_t>(column)]) continue;
      entry.valueRef() = entry.row() != column ? 0 : entry.value() != 0 ? std::abs(entry.value()) : 1;
    }
}

/// The number of a row among the later neighbours of a column; −1 if they are the same node.
int BlockMatrix::place(int row, int column) const {
  if (row == column) return -1;
  const auto neighbours = later_neighbours(static_cast<std::size_t>(column));
  return static_cast<int>(std::lower_bound(neighbours.begin(), neighbours.end(), row) - neighbours.begin());
}

void BlockMatrix::add_pair(int a, int b, const Mat3& B) {
  const int row = free_.number[static_cast<std::size_t>(a)], column = free_.number[static_cast<std::size_t>(b)];
  if (row < 0 || column < 0) return;
  const int first = std::min(row, column), last = std::max(row, column), n = place(last, first);
  const auto neighbours = later_neighbours(static_cast<std::size_t>(first));
  if (n == static_cast<int>(neighbours.size()) || neighbours[static_cast<std::size_t>(n)] != last) return;
  for (int j = 0; j < 3; ++j) {
    double* entry = block_column(static_cast<std::size_t>(first), n, static_cast<std::size_t>(j));
    for (int i = 0; i < 3; ++i) entry[i] += row > column ? B(i, j) : B(j, i);
  }
}

void BlockMatrix::add_node(int node, const Mat3& B) {
  const int n = free_.number[static_cast<std::size_t>(node)];
  if (n < 0) return;
  for (int j = 0; j < 3; ++j)
    for (int i = j; i < 3; ++i)
      block_column(static_cast<std::size_t>(n), -1, static_cast<std::size_t>(j))[i] += B(i, j);
}

void BlockMatrix::add_diagonal(int node, double k) {
  const int n = free_.number[static_cast<std::size_t>(node)];
  if (n < 0) return;
  for (int j = 0; j < 3; ++j) block_column(static_cast<std::size_t>(n), -1, static_cast<std::size_t>(j))[j] += k;
}

}  // namespace heml
