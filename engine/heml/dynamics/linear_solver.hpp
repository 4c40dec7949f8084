#pragma once
// K d = r by conjugate gradients (by BiCGSTAB where K is not symmetric) on products of the stiffness, with one of four
// preconditioners. With the Cholesky factor of the assembled stiffness they end after one iteration, or after a few
// where the assembled matrix is an approximation.
#include <Eigen/SparseCholesky>
#include <heml/dynamics/linear_counts.hpp>
#include <heml/dynamics/objective.hpp>
#include <heml/dynamics/preconditioner_build.hpp>
#include <heml/dynamics/single_precision_cg.hpp>
#include <memory>

namespace heml {

/// Free nodes up to which a sparse factor a Newton iteration costs less than some tens of products;
constexpr std::size_t max_direct_unknowns_each_time(bool static_solve) { return static_solve ? 40000 : 400; }
/// and up to which a factor of the scalar matrix costs less than levels of it, which need one or two iterations more: a
/// cycle takes as long as back-solves at 1,200 nodes, a quarter at 6,500, an eighth at 21,000.
inline constexpr std::size_t max_direct_unknowns_once = 1000;

/// The choice for a body of that size, by a fixed model of cost, never by a clock.
Preconditioner choose_preconditioner(std::size_t free_nodes, bool static_solve);

class LinearSolver {
 public:
  /// free, mass (3 #V, kg), team must outlive this. mesh: rest shape. modulus: #T, Pa, for the scalar matrix.
  LinearSolver(const FreeNodes& free, const TetMesh& mesh, const std::vector<double>& modulus, const Vector& mass,
               Preconditioner preconditioner, Projection projection, ThreadTeam& team);

  /// The mesh has lost elements: these are left, by the numbers they had (ascending); mass has followed, and the nodes
  /// that lost all elements have none, though free still names them. What preconditions goes on as it is, with few
  /// more iterations while most of the body is there, and is made anew once a third of it is gone. Returns false where
  /// it cannot: make another solver.
  bool keep_elements(const std::vector<int>& elements);
  /// Whether what preconditions is of a body with more elements.
  bool is_outdated() const { return outdated_; }
  /// Makes another of the body as it is now. Null where there is nothing to make.
  std::shared_ptr<PreconditionerBuild> preconditioner_build() const;
  /// What solves to come depend on beside the body: which a the scalar matrix is factored for, and the matrix where it
  /// cannot be made again, being of a body with more elements.
  struct Memory {
    double factored_a = -1;  ///< 1/s²; negative: it is not
    std::shared_ptr<SmoothedAggregation> outdated;
    std::vector<std::size_t> omitted_features;
    std::size_t made_of = 0;
  };
  Memory memory() const;
  /// Of a solver made anew: goes on as that one would have.
  void restore(const Memory& memory);
  /// Preconditions with what such work has made (done, and of the body as it is now) from now on.
  void adopt(PreconditionerBuild& work);

  /// Tells the a of Φ = a/2 ‖x − y‖²_M + U. The scalar matrix is factored again where it has changed a lot.
  void set_inertia(double a);

  /// d = K⁻¹ r, to a residual of tolerance ‖r‖, K where the objective was linearised last. Returns whether the
  /// curvature met was positive all along; if not, d still leads downhill: what was found before, or with a factor L D
  /// Lᵀ of mixed signs L⁻ᵀ |D|⁻¹ L⁻¹ r, which near a buckling load serves far better than positive elements do. 0 where
  /// nothing exists.
  bool solve(Objective& objective, const Vector& r, double tolerance, Vector& d);

  /// z = what stands for K⁻¹, times r. Returns false where there is none. Not for `block_jacobi` and `cholesky`, which
  /// are of a state.
  bool precondition(const Vector& r, Vector& z);

  /// The same with the stiffness projected and, where that is not enough, a shifted diagonal: d always leads downhill.
  void solve_projected(Objective& objective, const Vector& x, const Vector& r, Vector& d);

  Preconditioner preconditioner() const { return preconditioner_; }
  Projection projection() const { return projection_; }
  const LinearSolverStats& counts() const { return counts_; }
  std::size_t levels() const { return scalar_ ? scalar_->levels() : 0; }  ///< of the scalar matrix; 0: not made yet
  /// Of the matrix and what preconditions, as far as they were made.
  std::size_t bytes() const;

 private:
  enum class Definiteness { positive, indefinite, none };  ///< of a factor's pivots; none: no factor
  void assemble(Objective& objective);
  Definiteness factor();
  Definiteness prepare(Objective& objective);
  bool factorise_scalar();
  std::size_t max_direct_unknowns() const;
  void apply(const Vector& r, Vector& z);
  void apply_factor(const Vector& r, Vector& z);
  void invert_blocks();
  bool supports_single_precision(Objective& objective, double tolerance);
  bool conjugate_gradients(Objective& objective, const Vector& r, double enough, Vector& d);
  bool biconjugate_gradients(Objective& objective, const Vector& r, double enough, Vector& d);

  using Cholesky = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower>;

  const FreeNodes& free_;
  const TetMesh& mesh_;
  const Vector& mass_;
  Preconditioner preconditioner_;
  Projection projection_;
  double shift_ = 0;  ///< N/m, added to every diagonal entry of K
  ThreadTeam& team_;
  std::unique_ptr<BlockMatrix> matrix_;  ///< made when first needed, like the rest
  std::unique_ptr<Cholesky> cholesky_;
  Vector pivots_;                                ///< |D|, in the factor's order
  std::shared_ptr<SmoothedAggregation> scalar_;  ///< also of those that remember it
  std::unique_ptr<SinglePrecisionCG> single_precision_cg_;
  std::vector<Mat3> inverse_blocks_;  ///< #free
  std::vector<double> modulus_;
  double a_ = 0, factored_a_ = -1;
  bool outdated_ = false;
  std::size_t made_of_ = 0;  ///< elements, what preconditions
  LinearSolverStats counts_;
};

}  // namespace heml
