#pragma once
// z ≈ (aM + L)⁻¹ r for the scalar matrix of a mesh, by one V-cycle of algebraic multigrid with smoothed aggregation
// (Vaněk, Mandel, Brezina 1996). Work and memory grow linearly with the mesh, those of a factor faster.
//
//   level 0   aM + L of the mesh         smooth ─► residual          smooth ◄─ add
//                                                     │ Pᵀ               ▲ P
//   level 1   aM₁ + L₁, L₁ = PᵀLP        smooth ─► residual          smooth
//     ...                                             └──────► ... ──────┘
//   bottom    factored                                       solve
//
// P depends on L alone, so a change of a, the inertia, takes a new sum on every level and a new factor of the bottom.
// The smoother is a polynomial in D⁻¹A, the same before and after, D the row sums of |A|, which bound all eigenvalues
// by 1 whatever the shape of the elements (Baker, Falgout, Kolev, Yang 2011). So the cycle is symmetric and positive
// definite. If the bottom is the only level, it is the exact factor.
//
// Threads share rows. Each row is summed in the order of its columns, so the bits do not depend on the number of
// threads.
#include <heml/base/thread_team.hpp>
#include <heml/dynamics/block_jacobi.hpp>
#include <heml/dynamics/scalar_cholesky.hpp>
#include <heml/dynamics/sliced_ell_matrix.hpp>
#include <memory>

namespace heml {

class SmoothedAggregation {
 public:
  /// What is built of a mesh once, for any inertia. Immutable: snapshots and other solvers share it.
  struct Hierarchy {
    struct Level {
      ScalarMatrix L, M;
      SlicedEllMatrix P, R;  ///< prolongation and restriction, R = Pᵀ; empty at the bottom
    };
    std::vector<int> node;               ///< node of each row
    std::vector<std::size_t> bare_rows;  ///< of nodes without mass and elements
    std::vector<Level> levels;
  };

  /// mesh: rest shape. modulus: #T, Pa. mass: 3 #V, kg. max_direct_unknowns: number of unknowns up to which a level is
  /// factored, not coarsened. Nodes without mass and elements count as fixed. team must outlive this.
  SmoothedAggregation(const FreeNodes& free, const TetMesh& mesh, const std::vector<double>& modulus,
                      const Vector& mass, std::size_t max_direct_unknowns, ThreadTeam& team);
  SmoothedAggregation(std::shared_ptr<const Hierarchy> hierarchy, ThreadTeam& team);
  const std::shared_ptr<const Hierarchy>& hierarchy() const { return hierarchy_; }

  /// Sets a (1/s²) on all levels; required before apply(). Returns whether aM + L is positive definite.
  bool set_inertia(double a);

  /// Treats these rows, indices of free nodes, as fixed: z is 0 there. The cycle stays symmetric and positive definite,
  /// and close to that of a rebuilt preconditioner while they are few.
  void exclude_rows(std::vector<std::size_t> rows) { excluded_rows_ = std::move(rows); }
  const std::vector<std::size_t>& excluded_rows() const { return excluded_rows_; }

  /// z ≈ (aM + L)⁻¹ r for each axis (3 #V); 0 at nodes that are not free. Uses scratch memory: one call at a time.
  void apply(const Vector& r, Vector& z);
  /// The same for free nodes only (#free), with values in the range of float.
  void apply(const MultiVector& r, MultiVector& z);

  /// z ≈ K⁻¹ r for a matrix K that A stands in for, of free nodes (#free): the finest level is K's own
  /// (block_jacobi.hpp) and is added to the others, so no product with A is needed. Takes more iterations than apply(),
  /// at half the price each. levels() > 1.
  void apply(const BlockJacobi& finest, const MultiVector& r, MultiVector& z);

  std::size_t levels() const { return levels_.size(); }
  /// Of the finest A.
  const std::vector<float>& diagonal() const { return diagonal_; }
  std::size_t bytes() const;

 private:
  struct Level {
    SlicedEllMatrix A;             ///< aM + L; empty at the bottom
    std::vector<float> inverse_D;  ///< 1/Σ|A| along each row
    MultiVector b, x, scratch;
  };

  void cycle(std::size_t l, const MultiVector& b, MultiVector& x);
  void smooth(Level& level, float weight, const MultiVector& b, MultiVector& x) const;

  std::shared_ptr<const Hierarchy> hierarchy_;
  std::vector<std::size_t> excluded_rows_;
  ThreadTeam& team_;
  std::vector<Level> levels_;
  std::vector<float> diagonal_;
  ScalarCholesky bottom_;
};

}  // namespace heml
