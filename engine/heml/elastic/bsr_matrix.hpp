#pragma once
// Block sparse row (BSR) matrix of 3×3 blocks in float: the stiffness of a body between its free nodes, for linear
// solves to two or three digits. A product reads a third of what a product with the element stiffnesses
// (edge_stiffness.hpp) reads.
//
//   row n:   [n, n1] [n, n2] ...    n1 < n2 < ...: nodes that share an element with n, and n itself
//   block:   x x x y y y z z z        its columns
//
// Elements are added up first, each pair of corners (a, b), a < b, in one of the two blocks of their rows. Then each
// row takes its own sums and those of the other side, transposed. The diagonal is minus the sum of the row, since no
// translation strains an element; pairs with a corner that has no row are therefore added to the diagonal of the other:
//
//   sums      S_ab += K_ab          S_aa += K_ah, h without a row
//   blocks    K_ij = S_ij + S_jiᵀ     K_ii = −sym(S_ii + Σ_j K_ij)
//
// Six blocks an element are read and written, not sixteen, and K is symmetric to the last bit.
//
// One thread adds up a row's sums, elements in ascending order, so the bits do not depend on the number of threads. For
// this the rows are divided into sections, and each element names the sections of its corners: a thread passes over the
// elements outside its sections, and those at the border of two are computed by both.
#include <Eigen/Core>
#include <cstdint>
#include <heml/base/thread_team.hpp>
#include <heml/elastic/element_group.hpp>
#include <heml/elastic/outer_product.hpp>
#include <heml/math/bytes.hpp>
#include <heml/math/types.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

using MultiVector = std::vector<Eigen::Array4f>;  ///< xyz and 0: one vector register

class BsrMatrix {
 public:
  /// number: #V, row of each node, −1 for nodes without a row. elements: #T, give the sparsity pattern: nodes of linear
  /// tetrahedra (4) or quadratic ones (10).
  template <std::size_t nodes>
  BsrMatrix(const std::vector<int>& number, const std::vector<std::array<int, nodes>>& elements);

  /// Removes all but the given elements (ascending) and renumbers those in that order. Rows and blocks stay.
  void keep_elements(const std::vector<int>& elements);

  void set_zero();
  /// K = Σ of element stiffnesses, N/m (edge_stiffness.hpp), of groups whose element numbers are indices into the
  /// elements, or, of quadratic ones, four times these and the point; over what was there: a call to begin, one for
  /// each group, and one to end. outer: added to the elements of the group, which are quadratic; null: none.
  void begin_elements(ThreadTeam& team);
  template <class Real>
  void add_elements(const Real* K, const ElementGroup<Real>& group, ThreadTeam& team,
                    const OuterProduct<Real>* outer = nullptr);
  void end_elements(ThreadTeam& team);
  /// Adds [B −B; −B B], B symmetric (N/m), between two nodes. Rows that do not exist are ignored, here and below.
  void add_edge(int a, int b, const Mat3& B);
  /// Adds B to the block of rows a and columns b, and its transpose to the other.
  void add_pair(int a, int b, const Mat3& B);
  /// Adds a symmetric B, or k times the identity, to the diagonal block of a node.
  void add_node(int node, const Mat3& B);
  void add_diagonal(int node, double k);

  /// Leaves of these rows and columns (3 row + axis) nothing but the diagonal, which becomes positive.
  void isolate(const std::vector<int>& rows);

  /// y = K x, #rows.
  void multiply(const MultiVector& x, MultiVector& y, ThreadTeam& team) const;

  /// Of a row.
  Eigen::Matrix3f diagonal_block(std::size_t row) const {
    return Eigen::Map<const Eigen::Matrix3f>(entries(diagonal_[row]));
  }

  std::size_t rows() const { return start_.size() - 1; }
  std::size_t bytes() const {
    return bytes_of(number_, start_, column_, diagonal_, mirror_, sum_, entry_, block_indices_, sections_);
  }

 private:
  typedef float Column __attribute__((vector_size(16)));
  struct Sum {
    Column column[3];  ///< xyz and 0
  };
  /// Bit k: a corner has its row in section k; bit `sections`: a corner has no row.
  using SectionMask = std::uint32_t;
  static constexpr std::size_t sections = 16;
  static constexpr SectionMask no_row = SectionMask{1} << sections;

  std::size_t first_row(std::size_t section) const { return rows() * section / sections; }
  template <std::size_t nodes>
  void find_sections(const std::vector<std::array<int, nodes>>& elements);
  int find(int row, int column) const;
  int place_of_pair(int row_a, int row_b) const;
  float* entries(int block) { return &entry_[9 * static_cast<std::size_t>(block)]; }
  const float* entries(int block) const { return &entry_[9 * static_cast<std::size_t>(block)]; }
  void add(int row, int column, const Mat3& B);
  template <class Real>
  void add_to(std::size_t begin, std::size_t end, const Real* K, const ElementGroup<Real>& group,
              const OuterProduct<Real>* outer);
  template <class Real>
  void add_linear(std::size_t begin, std::size_t end, const Real* K, const ElementGroup<Real>& group);
  template <class Real>
  void add_quadratic(std::size_t begin, std::size_t end, const Real* K, const ElementGroup<Real>& group,
                     const OuterProduct<Real>* outer);
  template <class Real>
  void add_wide(std::size_t begin, std::size_t end, const Real* K, const ElementGroup<Real>& group,
                const OuterProduct<Real>* outer);
  void end_rows(std::size_t begin, std::size_t end);
  void end_wide(std::size_t begin, std::size_t end);
  void multiply_rows(const MultiVector& x, MultiVector& y, std::size_t begin, std::size_t end) const;
  void multiply_wide(const MultiVector& x, MultiVector& y, std::size_t begin, std::size_t end) const;

  std::vector<int> number_;
  std::vector<int> start_, column_;
  std::vector<int> diagonal_;  ///< block of each row
  std::vector<int> mirror_;    ///< of each block: that of its row and column exchanged
  std::vector<Sum> sum_;
  std::vector<float> entry_;  ///< nine a block, and padding, since columns are read as four numbers
  std::size_t pairs_;         ///< of an element's nodes: 6 or 45
  /// Where K_ab of each pair of an element's nodes is added, b from 1 up, a < b; −1: nowhere. pairs_ #T.
  std::vector<int> block_indices_;
  std::vector<SectionMask> sections_;  ///< #T
};

}  // namespace heml
