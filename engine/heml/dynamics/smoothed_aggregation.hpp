#pragma once
// z ≈ (aM + L)⁻¹ r for the scalar matrix of a mesh, by one cycle over coarser and coarser copies of it: smoothed
// aggregation (Vaněk, Mandel, Brezina 1996). Work and memory grow with the mesh and not faster, where a factor's do.
//
//   level 0   aM + L of the mesh         smooth ─► residual          smooth ◄─ add
//                                                     │ Pᵀ               ▲ P
//   level 1   aM₁ + L₁, L₁ = PᵀLP        smooth ─► residual          smooth
//     ...                                             └──────► ... ──────┘
//   bottom    factored                                       solve
//
// P is made from L alone, so that a change of a, the inertia, is a new sum on every level and a new factor of the
// bottom. Smoothing is a polynomial in D⁻¹A, the same before and after, D the sums of |A| along rows, which bound every
// eigenvalue by 1 whatever the shape of the elements (Baker, Falgout, Kolev, Yang 2011): the cycle is symmetric and
// positive definite. With no level but the bottom it is the exact factor.
//
// Threads share rows; each row is one sum in the order of its columns.
#include <heml/base/thread_team.hpp>
#include <heml/dynamics/scalar_cholesky.hpp>

namespace heml {

class SmoothedAggregation {
 public:
  /// mesh: rest shape. modulus: #T, Pa. mass: 3 #V, kg. max_direct_unknowns: unknowns up to which a level is factored
  /// rather than coarsened. Nodes without mass and elements count as fixed. team must outlive this.
  SmoothedAggregation(const FreeNodes& free, const TetMesh& mesh, const std::vector<double>& modulus,
                      const Vector& mass, std::size_t max_direct_unknowns, ThreadTeam& team);

  /// a: 1/s². Returns whether aM + L is positive definite.
  bool set_inertia(double a);

  /// Takes nodes for fixed from now on that were not: z is 0 there. What is left is symmetric and positive definite as
  /// before, and near to what it would be anew while they are few. rows: of free nodes.
  void exclude_rows(std::vector<std::size_t> rows) { excluded_rows_ = std::move(rows); }
  const std::vector<std::size_t>& omitted_features() const { return excluded_rows_; }

  /// z ≈ (aM + L)⁻¹ r for each axis (3 #V); 0 at nodes that are not free.
  void apply(const Vector& r, Vector& z);
  /// The same of free nodes alone, #free, of numbers that float can hold.
  void apply(const MultiVector& r, MultiVector& z);

  std::size_t levels() const { return levels_.size(); }
  std::size_t bytes() const;

 private:
  using Rows = Eigen::SparseMatrix<float, Eigen::RowMajor>;
  struct Level {
    ScalarMatrix L, M;
    Rows A;                        ///< aM + L
    std::vector<float> inverse_D;  ///< 1/Σ|A| along each row
    Rows P, R;                     ///< from and to the next level, R = Pᵀ; none at the bottom
    MultiVector b, x, scratch;
  };

  void add_levels(std::size_t max_direct_unknowns);
  void cycle(std::size_t l);
  void smooth(Level& level, float weight) const;
  template <class Write>
  void each_row(const Rows& A, const MultiVector& x, const Write& write) const;

  std::vector<int> node_;  ///< of each row
  std::vector<std::size_t> excluded_rows_;
  ThreadTeam& team_;
  std::vector<Level> levels_;
  ScalarCholesky bottom_;
};

}  // namespace heml
