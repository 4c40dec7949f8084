#pragma once
// K d = r by conjugate gradients (BiCGSTAB if K is not symmetric) on products with the stiffness, with one of four
// preconditioners. With the Cholesky factor of the assembled stiffness they take one iteration, or a few if the
// assembled matrix is an approximation.
#include <heml/dynamics/linear_solver_stats.hpp>
#include <heml/dynamics/objective.hpp>
#include <heml/dynamics/preconditioner_build.hpp>
#include <heml/dynamics/single_precision_cg.hpp>
#include <heml/dynamics/supernodal_ldlt.hpp>
#include <memory>

namespace heml {

/// Number of free nodes up to which a sparse factor per Newton iteration costs less than some tens of products.
constexpr std::size_t max_direct_unknowns_each_time(bool static_solve) { return static_solve ? 40000 : 400; }
/// Number of free nodes up to which a factor of the scalar matrix costs less than multigrid, which needs one or two
/// iterations more: a cycle takes as long as back-solves at 1,200 nodes, a quarter at 6,500, an eighth at 21,000.
inline constexpr std::size_t max_direct_unknowns_once = 1000;
/// Number of free nodes up to which implicit steps factor the stiffness wherever contact has more terms than the other
/// preconditioners can know: of a block on a table a step takes a third of the time at 3,000, half as long again at
/// 9,000.
inline constexpr std::size_t max_direct_unknowns_in_contact = 5000;

/// Chooses by size with a fixed cost model, never by measured time, so that the choice is reproducible.
Preconditioner choose_preconditioner(std::size_t free_nodes, bool static_solve);

/// What the stiffness of quadratic elements couples.
struct QuadraticPattern {
  std::vector<Tet> coupled;                   ///< quadruples of nodes (mesh/quadratic.hpp, coupled_nodes())
  std::vector<std::array<int, 10>> elements;  ///< their nodes
};

class LinearSolver {
 public:
  /// free, mesh (rest shape), mass (3 #V, kg), pattern and team must outlive this. modulus: #T, Pa, for the scalar
  /// matrix. pattern: of the stiffness, where its elements are not those of the mesh. instruction_set: of the factor's
  /// kernels; the processor must support it.
  LinearSolver(const FreeNodes& free, const TetMesh& mesh, const std::vector<double>& modulus, const Vector& mass,
               Preconditioner preconditioner, Projection projection, ThreadTeam& team,
               const QuadraticPattern* pattern = nullptr, InstructionSet instruction_set = InstructionSet::best);

  /// To be called when the body has lost elements and the masses are updated. mesh: as it is now, which
  /// may be elsewhere. elements: those left, by their old numbers (ascending). Nodes that lost all elements have mass 0
  /// and stay in `free`. The preconditioner is kept, at the cost of few more iterations, until a third of its elements
  /// is gone; then it is rebuilt. Returns false if there is no scalar preconditioner to keep: the caller then makes
  /// another solver.
  bool keep_elements(const TetMesh& mesh, const std::vector<int>& elements);
  /// Whether the preconditioner was built for a body with more elements.
  bool is_outdated() const { return outdated_; }
  /// If the preconditioner is outdated, returns a job that rebuilds it for the present body on any thread; pass the
  /// result to adopt(). Null if it is up to date.
  std::shared_ptr<PreconditionerBuild> preconditioner_build() const;
  /// State that later solves depend on besides the body: the a for which the scalar matrix is factored, and what may
  /// have been built for a body with more elements. What each solve makes anew is left out.
  struct Snapshot {
    double a = 0, factored_a = -1;                                    ///< 1/s²; negative: not factored
    std::shared_ptr<const SmoothedAggregation::Hierarchy> hierarchy;  ///< null: not built yet
    std::vector<std::size_t> excluded_rows;
    std::shared_ptr<const BsrMatrix> matrix;  ///< in float, where its pattern is of a body with more elements
    std::size_t built_for_elements = 0;
    bool outdated = false;
    LinearSolverStats counts;
  };
  Snapshot snapshot() const;
  /// Makes a newly constructed solver continue as the one that snapshot() came from.
  void restore(const Snapshot& snapshot);
  /// Replaces the preconditioner by the result of a build, which must be done and of the present body.
  void adopt(PreconditionerBuild& work);

  /// Sets a (1/s²) of Φ = a/2 ‖x − y‖²_M + U. The scalar matrix is refactored once a has changed by more than a factor
  /// of 3.
  void set_inertia(double a);

  /// From now on a solve ends after so many iterations at most, and d is then inexact, but a descent direction. 0: the
  /// usual limit, which solves rarely reach.
  void limit_iterations(int iterations);

  /// Solves K d = r to a residual of tolerance ‖r‖, K from the last linearise() of the objective. Returns whether all
  /// curvature met was positive. If not, d is a descent direction all the same: the iterate before, or, with a factor L
  /// D Lᵀ of mixed signs, L⁻ᵀ |D|⁻¹ L⁻¹ r, which near a buckling load serves far better than projected elements. d = 0
  /// if no factor exists.
  bool solve(Objective& objective, const Vector& r, double tolerance, Vector& d);

  /// z = P⁻¹ r, P the preconditioner `scalar` or `multilevel`; the others depend on the state (asserted). Returns false
  /// if P cannot be factored.
  bool precondition(const Vector& r, Vector& z);

  /// solve() with the stiffness projected at x and, if that is not enough, a growing diagonal shift. d is always a
  /// descent direction.
  void solve_projected(Objective& objective, const Vector& x, const Vector& r, Vector& d);

  Preconditioner preconditioner() const { return preconditioner_; }
  Projection projection() const { return projection_; }
  const LinearSolverStats& counts() const { return counts_; }
  std::size_t levels() const { return scalar_ ? scalar_->levels() : 0; }  ///< of the scalar matrix; 0: not built yet
  /// Size of the matrices and factors built so far, in bytes.
  std::size_t bytes() const;

 private:
  enum class Definiteness { positive, indefinite, none };  ///< of a factor's pivots; none: no factor
  void assemble(Objective& objective);
  Definiteness factor();
  Definiteness assemble_and_factor(Objective& objective);
  Definiteness prepare(Objective& objective);
  bool factorise_scalar();
  std::size_t max_direct_unknowns() const;
  void apply(const Vector& r, Vector& z);
  void apply_factor(const Vector& r, Vector& z);
  void invert_blocks();
  bool supports_single_precision(Objective& objective, double tolerance);
  bool conjugate_gradients(Objective& objective, const Vector& r, double enough, Vector& d);
  bool biconjugate_gradients(Objective& objective, const Vector& r, double enough, Vector& d);

  const FreeNodes& free_;
  const TetMesh* mesh_;
  const QuadraticPattern* pattern_;  ///< null: the elements of the mesh
  const Vector& mass_;
  Preconditioner preconditioner_;
  bool is_factored_ = false;  ///< whether the factor of the stiffness serves the present solve
  Projection projection_;
  int max_iterations_;
  double shift_ = 0;  ///< N/m, added to every diagonal entry of K
  ThreadTeam& team_;
  InstructionSet instruction_set_;
  std::unique_ptr<BlockMatrix> matrix_;  ///< built on first use, like the members below
  std::vector<std::array<int, 2>> pairs_;  ///< that it couples besides the elements, ascending
  std::unique_ptr<SupernodalLdlt> factor_;
  Vector divisors_;  ///< |D|, in the factor's order
  std::unique_ptr<SmoothedAggregation> scalar_;
  LowRankUpdate update_;  ///< of scalar_, what is no elements'
  std::unique_ptr<SinglePrecisionCG> single_precision_cg_;
  std::vector<Mat3> inverse_blocks_;  ///< #free
  std::vector<double> modulus_;
  double a_ = 0, factored_a_ = -1;
  bool outdated_ = false;
  bool matrix_has_lost_elements_ = false;  ///< that of single_precision_cg_
  std::size_t built_for_elements_ = 0;     ///< number of elements that the preconditioner was built for
  LinearSolverStats counts_;
};

}  // namespace heml
