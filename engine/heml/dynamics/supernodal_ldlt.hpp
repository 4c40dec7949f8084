#pragma once
// L D Lᵀ of a symmetric matrix of 3×3 blocks, without pivoting, by the multifrontal method (Duff & Reid 1983):
//
//   order ──► supernodes ──► for each, children first:  front = its entries + the children's update matrices
//                                                       eliminate ──► columns of L, D, an update matrix
//
// Order, supernodes and all places in memory depend on the pattern alone and are found once. Sums have a fixed order,
// so bits do not depend on the number of threads: subtrees go to threads as wholes, fronts above them by strips.
#include <heml/base/thread_team.hpp>
#include <heml/dynamics/block_matrix.hpp>
#include <heml/dynamics/front_kernels.hpp>
#include <heml/dynamics/supernodes.hpp>
#include <heml/elastic/fan_layout.hpp>

namespace heml {

class SupernodalLdlt {
 public:
  /// position: of the unknowns' nodes, #free; any positions will do, but with those of a mesh the factor has least
  /// fill. team must outlive this.
  SupernodalLdlt(const BlockMatrix& pattern, const std::vector<Vec3>& position, InstructionSet isa, ThreadTeam& team);

  /// Factors a matrix of the pattern. Returns false if a pivot is 0 or not finite; pivots() and solve() are then not
  /// defined.
  bool factor(const BlockMatrix& matrix);

  /// D, in the order of elimination.
  const Eigen::VectorXd& pivots() const { return pivots_; }

  /// b = L⁻ᵀ diag(divisors)⁻¹ L⁻¹ b, b: 3 #free; with the pivots as divisors the solution. Uses scratch memory: one
  /// call at a time.
  void solve(Eigen::VectorXd& b, const Eigen::VectorXd& divisors) const;

  double multiplications() const { return multiplications_; }  ///< of a factorisation
  std::size_t bytes() const;

 private:
  /// A block of the matrix and its place in the front that assembles it, in nodes.
  struct Entry {
    int row, column;
    int matrix_column, place;  ///< place: among the later neighbours of that column; −1: the diagonal block
    bool transposed;
  };
  /// Supernodes that one thread processes: subtrees, or the list of those above all subtrees.
  struct Task {
    std::vector<std::size_t> supernodes;
    std::size_t scaled = 0;  ///< offset of its scratch memory
    std::vector<std::size_t> row_offset = {};
  };
  using Values = std::vector<double, CacheAligned<double>>;

  void find_entries(const BlockMatrix& pattern);
  void find_relative_rows();
  void find_tasks();
  void find_places();
  Front front(std::size_t s, const Task& task);
  bool process(std::size_t s, Task& task, const BlockMatrix& matrix, bool alone);
  void assemble(std::size_t s, const Front& f, const BlockMatrix& matrix) const;
  void add_update(std::size_t child, std::size_t s, const Front& to, Task& task) const;
  void eliminate(const Front& f, bool alone) const;

  Supernodes supernodes_;
  const FrontKernels& kernels_;
  ThreadTeam& team_;
  double multiplications_;
  std::vector<std::vector<std::size_t>> children_;
  std::vector<std::size_t> entry_start_{0};
  std::vector<Entry> entries_;
  std::vector<int> relative_;  ///< of each supernode's rows: their place in the front of its parent, in nodes
  std::vector<std::size_t> panel_start_{0}, update_start_;
  std::vector<Task> subtrees_;
  Task top_;
  Values panels_, updates_, scaled_;
  Eigen::VectorXd pivots_;
  mutable Values front_vector_;
  mutable Eigen::VectorXd ordered_;
};

}  // namespace heml
