#pragma once
// The stiffness of a mesh between its free nodes, for factorisation: a symmetric matrix of 3×3 blocks, one per node and
// one per edge, whose lower half is stored as a scalar sparse matrix in double.
//
//   block column c:  [c, c]  [n1, c]  [n2, c] ...        n1 < n2 < ... : free neighbours with numbers above c
//   scalar column 3c+j:  rows 3c+j .. 3c+2, then three rows a neighbour
#include <Eigen/SparseCore>
#include <heml/math/bytes.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <span>
#include <utility>
#include <vector>

namespace heml {

/// The free (unconstrained) nodes of a solve and their numbers among the unknowns.
struct FreeNodes {
  std::vector<int> number;  ///< #V: −1 where not free
  std::vector<int> node;    ///< of each unknown, ascending
  /// Coordinates (3 node + axis) of free nodes that are held all the same, ascending: residuals, products and solutions
  /// are 0 there, and matrices have nothing there but their diagonal.
  std::vector<int> held;

  /// is_free: #V.
  explicit FreeNodes(const std::vector<bool>& is_free, std::vector<int> held = {});
  /// Row of a held coordinate in a matrix between free nodes.
  int row_of(int coordinate) const { return 3 * number[static_cast<std::size_t>(coordinate / 3)] + coordinate % 3; }
  /// values: 3 #V.
  template <class Values>
  void clear_held(Values& values) const {
    for (const int i : held) values[i] = 0;
  }
};

class BlockMatrix {
 public:
  /// free must outlive the matrix. tets and pairs of nodes give the sparsity pattern; nodes that are not free are
  /// ignored throughout.
  BlockMatrix(const FreeNodes& free, const std::vector<Tet>& tets, std::span<const std::array<int, 2>> pairs = {});

  void set_zero();
  /// Adds the element stiffness K(row, column), indices [node][xyz].
  template <std::size_t count, class Entry>
  void add_element(const std::array<int, count>& nodes, const Entry& K);
  /// Adds B to the block (a, b) of two nodes of one element or pair, and so Bᵀ to (b, a). Others have no block: nothing
  /// is added.
  void add_pair(int a, int b, const Mat3& B);
  /// Adds a symmetric B to the block of a node.
  void add_node(int node, const Mat3& B);
  /// Adds k to the three diagonal entries of a node.
  void add_diagonal(int node, double k);

  /// Leaves of the rows and columns of held coordinates nothing but the diagonal, which becomes positive.
  void isolate_held();

  /// 3 #free square; the lower half only.
  const Eigen::SparseMatrix<double>& lower() const { return matrix_; }
  const FreeNodes& free() const { return free_; }
  /// Neighbours of an unknown node with higher numbers, ascending.
  std::span<const int> later_neighbours(std::size_t node) const {
    return {neighbour_.data() + start_[node], neighbour_.data() + start_[node + 1]};
  }
  /// Column j of the block of an unknown node and its n-th later neighbour (row). n = −1: of the diagonal block, rows j
  /// and below.
  const double* block_column(std::size_t node, int n, std::size_t j) const {
    const double* column = matrix_.valuePtr() + matrix_.outerIndexPtr()[3 * node + j];
    return n < 0 ? column - j : column + (3 - j) + 3 * n;
  }
  std::size_t bytes() const { return bytes_of(matrix_) + bytes_of(start_, neighbour_); }

 private:
  double* block_column(std::size_t node, int n, std::size_t j) {
    return const_cast<double*>(std::as_const(*this).block_column(node, n, j));
  }
  int place(int row, int column) const;

  const FreeNodes& free_;
  std::vector<std::size_t> start_;  ///< start of the neighbours of each block column
  std::vector<int> neighbour_;
  Eigen::SparseMatrix<double> matrix_;
};

template <std::size_t count, class Entry>
void BlockMatrix::add_element(const std::array<int, count>& nodes, const Entry& K) {
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b) {
      const int row = free_.number[static_cast<std::size_t>(nodes[a])];
      const int column = free_.number[static_cast<std::size_t>(nodes[b])];
      if (row < column || column < 0) continue;
      const int n = place(row, column);
      for (int j = 0; j < 3; ++j) {
        double* entry = block_column(static_cast<std::size_t>(column), n, static_cast<std::size_t>(j));
        for (int i = n < 0 ? j : 0; i < 3; ++i) entry[i] += K(3 * static_cast<int>(a) + i, 3 * static_cast<int>(b) + j);
      }
    }
}

}  // namespace heml
