#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <heml/dynamics/linear_solver.hpp>
#include <heml/mesh/edit.hpp>
#include <utility>

namespace heml {
namespace {
constexpr int max_cg_iterations = 500;
constexpr double first_shift = 1e-4;          // relative to the stiffness along the residual
constexpr int max_stagnation = 50;            // iterations of BiCGSTAB without a smaller residual
constexpr double projected_tolerance = 1e-2;  // an approximation need not be solved exactly
// An outdated factor serves while the body has this part of its elements.
constexpr double min_element_fraction = 2.0 / 3;
constexpr double max_inertia_ratio = 3;    // a factor of aM + L serves up to this ratio between a and its own
constexpr double min_pivot_ratio = 1e-12;  // smallest divisor relative to the largest pivot
}  // namespace

Preconditioner choose_preconditioner(std::size_t free_nodes, bool static_solve) {
  if (free_nodes <= max_direct_unknowns_each_time(static_solve)) return Preconditioner::cholesky;
  return free_nodes <= max_direct_unknowns_once ? Preconditioner::scalar : Preconditioner::multilevel;
}

LinearSolver::LinearSolver(const FreeNodes& free, const TetMesh& mesh, const std::vector<double>& modulus,
                           const Vector& mass, Preconditioner preconditioner, Projection projection, ThreadTeam& team,
                           const QuadraticPattern* pattern, InstructionSet instruction_set)
    : free_(free),
      mesh_(&mesh),
      pattern_(pattern),
      mass_(mass),
      preconditioner_(preconditioner),
      projection_(projection),
      max_iterations_(max_cg_iterations),
      team_(team),
      instruction_set_(instruction_set),
      update_(free, team),
      modulus_(modulus) {}

void LinearSolver::limit_iterations(int iterations) {
  max_iterations_ = iterations > 0 ? iterations : max_cg_iterations;
}

void LinearSolver::set_inertia(double a) { a_ = a; }

void LinearSolver::assemble(Objective& objective) {
  std::vector<std::array<int, 2>> pairs;
  if (is_factored_) objective.add_coupled_pairs(pairs);
  for (auto& [a, b] : pairs)
    if (a > b) std::swap(a, b);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  if (!matrix_ || pairs != pairs_) {  // of these pairs alone, whatever were before: the bits are a restored world's
    matrix_ = std::make_unique<BlockMatrix>(free_, pattern_ ? pattern_->coupled : mesh_->tets, pairs);
    factor_.reset();
    pairs_ = std::move(pairs);
  }
  matrix_->set_zero();
  objective.add_stiffness(*matrix_);
  if (shift_ > 0)
    for (const int n : free_.node) matrix_->add_diagonal(n, shift_);
  matrix_->isolate_held();
}

LinearSolver::Definiteness LinearSolver::factor() {
  if (free_.node.empty()) return Definiteness::positive;
  if (!factor_) {
    std::vector<Vec3> position;
    for (const int n : free_.node) position.push_back(mesh_->nodes[static_cast<std::size_t>(n)]);
    factor_ = std::make_unique<SupernodalLdlt>(*matrix_, position, instruction_set_, team_);
  }
  ++counts_.factorisations;
  if (!factor_->factor(*matrix_)) return Definiteness::none;
  const Vector& D = factor_->pivots();
  divisors_ = D.cwiseAbs().cwiseMax(min_pivot_ratio * D.cwiseAbs().maxCoeff());
  return D.minCoeff() > 0 ? Definiteness::positive : Definiteness::indefinite;
}

void LinearSolver::invert_blocks() {
  inverse_blocks_.resize(free_.node.size());
  for (std::size_t k = 0; k < inverse_blocks_.size(); ++k) {
    Mat3 block;
    for (int j = 0; j < 3; ++j)
      for (int i = j; i < 3; ++i) {
        const int row = 3 * static_cast<int>(k) + i, column = 3 * static_cast<int>(k) + j;
        block(i, j) = block(j, i) = matrix_->lower().coeff(row, column);
      }
    // The preconditioner must be positive definite, or CG does not see negative curvature.
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(block);
    const Vec3 sizes = eigen.eigenvalues().cwiseAbs();
    const Vec3 inverse = sizes.cwiseMax(1e-6 * sizes.maxCoeff()).cwiseInverse();
    inverse_blocks_[k] = eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
  }
}

LinearSolver::Definiteness LinearSolver::assemble_and_factor(Objective& objective) {
  is_factored_ = true;
  assemble(objective);
  return factor();
}

LinearSolver::Definiteness LinearSolver::prepare(Objective& objective) {
  is_factored_ = false;
  switch (preconditioner_) {
    case Preconditioner::cholesky:
      return assemble_and_factor(objective);
    case Preconditioner::block_jacobi:
      assemble(objective);
      invert_blocks();
      return Definiteness::positive;
    case Preconditioner::scalar:
    case Preconditioner::multilevel: {
      std::vector<RankOneTerm> terms;
      objective.add_rank_one_terms(terms);
      if (terms.size() > LowRankUpdate::max_terms && free_.node.size() <= max_direct_unknowns_in_contact)
        return assemble_and_factor(objective);
      if (!factorise_scalar()) return Definiteness::none;
      update_.set(*scalar_, terms);
      return Definiteness::positive;
    }
  }
  return Definiteness::none;
}

std::size_t LinearSolver::bytes() const {
  std::size_t sum = bytes_of(divisors_) + bytes_of(inverse_blocks_, modulus_);
  if (matrix_) sum += matrix_->bytes();
  if (factor_) sum += factor_->bytes();
  if (scalar_) sum += scalar_->bytes() + update_.bytes();
  if (single_precision_cg_) sum += single_precision_cg_->bytes();
  return sum;
}

std::size_t LinearSolver::max_direct_unknowns() const {
  return preconditioner_ == Preconditioner::multilevel ? max_direct_unknowns_once : free_.node.size();
}

bool LinearSolver::keep_elements(const TetMesh& mesh, const std::vector<int>& elements) {
  mesh_ = &mesh;
  matrix_.reset(), factor_.reset();
  if (!scalar_) return false;
  modulus_ = with_elements(modulus_, elements);
  if (single_precision_cg_) {
    single_precision_cg_->keep_elements(elements);
    matrix_has_lost_elements_ = true;
  }
  std::vector<std::size_t> bare;
  for (std::size_t row = 0; row < free_.node.size(); ++row)
    if (!(mass_of_node(mass_, free_.node[row]) > 0)) bare.push_back(row);
  scalar_->exclude_rows(std::move(bare));
  update_.reset();
  outdated_ = true;
  return true;
}

std::shared_ptr<PreconditionerBuild> LinearSolver::preconditioner_build() const {
  if (!outdated_) return nullptr;
  return std::make_shared<PreconditionerBuild>(free_, *mesh_, modulus_, mass_, max_direct_unknowns(), a_, team_);
}

void LinearSolver::adopt(PreconditionerBuild& work) {
  scalar_ = work.release();
  update_.reset();
  built_for_elements_ = modulus_.size();
  outdated_ = false;
  ++counts_.factorisations;
  factored_a_ = work.is_definite() && work.a() == a_ ? a_ : -1;
  factorise_scalar();  // the factor does not depend on when the build began
}

LinearSolver::Snapshot LinearSolver::snapshot() const {
  Snapshot snapshot{a_, factored_a_, {}, {}, {}, built_for_elements_, outdated_, counts_};
  if (scalar_) {
    snapshot.hierarchy = scalar_->hierarchy();
    snapshot.excluded_rows = scalar_->excluded_rows();
  }
  if (single_precision_cg_ && matrix_has_lost_elements_)
    snapshot.matrix = std::make_shared<const BsrMatrix>(single_precision_cg_->matrix());
  return snapshot;
}

void LinearSolver::restore(const Snapshot& snapshot) {
  a_ = snapshot.a;
  factored_a_ = snapshot.factored_a;
  built_for_elements_ = snapshot.built_for_elements;
  outdated_ = snapshot.outdated;
  counts_ = snapshot.counts;
  update_.reset();
  if (snapshot.hierarchy) {
    scalar_ = std::make_unique<SmoothedAggregation>(snapshot.hierarchy, team_);
    scalar_->exclude_rows(snapshot.excluded_rows);
    if (factored_a_ >= 0) scalar_->set_inertia(factored_a_);
  }
  if (snapshot.matrix) {
    single_precision_cg_ = std::make_unique<SinglePrecisionCG>(free_, *snapshot.matrix, team_);
    matrix_has_lost_elements_ = true;
  }
}

/// Factors aM + L if a has changed a lot. First rebuilds the preconditioner if it is outdated and the body has lost too
/// many elements since.
bool LinearSolver::factorise_scalar() {
  if (!scalar_ || (outdated_ && static_cast<double>(modulus_.size()) <
                                    min_element_fraction * static_cast<double>(built_for_elements_))) {
    scalar_ = std::make_unique<SmoothedAggregation>(free_, *mesh_, modulus_, mass_, max_direct_unknowns(), team_);
    built_for_elements_ = modulus_.size();
    outdated_ = false;
    factored_a_ = -1;
  }
  if (factored_a_ >= 0 && a_ <= max_inertia_ratio * factored_a_ && factored_a_ <= max_inertia_ratio * a_) return true;
  ++counts_.factorisations;
  update_.reset();
  const bool done = scalar_->set_inertia(a_);
  factored_a_ = done ? a_ : -1;
  return done;
}

bool LinearSolver::precondition(const Vector& r, Vector& z) {
  z.setZero(r.size());
  if (r.isZero(0)) return true;
  assert(preconditioner_ == Preconditioner::scalar || preconditioner_ == Preconditioner::multilevel);
  if (!factorise_scalar()) return false;
  scalar_->apply(r, z);
  free_.clear_held(z);
  return true;
}

void LinearSolver::apply_factor(const Vector& r, Vector& z) {
  if (free_.node.empty()) {
    z.setZero(r.size());
    return;
  }
  Vector packed(3 * static_cast<Eigen::Index>(free_.node.size()));
  for (std::size_t k = 0; k < free_.node.size(); ++k)
    packed.segment<3>(3 * static_cast<int>(k)) = r.segment<3>(3 * free_.node[k]);
  factor_->solve(packed, divisors_);
  z.setZero(r.size());
  for (std::size_t k = 0; k < free_.node.size(); ++k)
    z.segment<3>(3 * free_.node[k]) = packed.segment<3>(3 * static_cast<int>(k));
}

void LinearSolver::apply(const Vector& r, Vector& z) {
  if (is_factored_) return apply_factor(r, z);
  if (scalar_) {
    scalar_->apply(r, z);
    update_.correct(z);
    return free_.clear_held(z);
  }
  z.setZero(r.size());
  for (std::size_t k = 0; k < free_.node.size(); ++k)
    z.segment<3>(3 * free_.node[k]) = inverse_blocks_[k] * r.segment<3>(3 * free_.node[k]);
}

bool LinearSolver::solve(Objective& objective, const Vector& r, double tolerance, Vector& d) {
  d.setZero(r.size());
  if (r.isZero(0)) return true;  // also without free nodes, where CG would divide 0 by 0
  const Definiteness sign = prepare(objective);
  if (sign == Definiteness::none) return false;
  ++counts_.solves;
  const double enough = tolerance * r.norm();
  if (!objective.is_symmetric()) return biconjugate_gradients(objective, r, enough, d);
  if (supports_single_precision(objective, tolerance))
    return single_precision_cg_->solve(*scalar_, update_, r, tolerance, max_iterations_, d, counts_.iterations);
  if (sign == Definiteness::positive) return conjugate_gradients(objective, r, enough, d);
  apply_factor(r, d);
  return false;
}

/// Whether the solve can run in float; if so, assembles the stiffness in float.
bool LinearSolver::supports_single_precision(Objective& objective, double tolerance) {
  if (is_factored_ || !scalar_ || tolerance < min_float_tolerance) return false;
  if (!single_precision_cg_) {
    BsrMatrix K = pattern_ ? BsrMatrix(free_.number, pattern_->elements) : BsrMatrix(free_.number, mesh_->tets);
    single_precision_cg_ = std::make_unique<SinglePrecisionCG>(free_, std::move(K), team_);
  }
  return single_precision_cg_->assemble(objective, shift_);
}

bool LinearSolver::conjugate_gradients(Objective& objective, const Vector& r, double enough, Vector& d) {
  Vector left = r, z, q;
  apply(left, z);
  Vector p = z;
  double progress = left.dot(z);
  for (int k = 0; k < max_iterations_; ++k) {
    objective.product(p, q);
    if (shift_ > 0) q += shift_ * p;
    ++counts_.iterations;
    const double curvature = p.dot(q);
    if (!(curvature > 0) || !(progress > 0)) {
      if (k == 0) d = p;
      return false;
    }
    const double step = progress / curvature;
    d += step * p;
    left -= step * q;
    if (left.norm() <= enough) break;
    apply(left, z);
    const double next = left.dot(z);
    p = z + next / progress * p;
    progress = next;
  }
  return true;
}

/// BiCGSTAB (van der Vorst 1992), right preconditioned. On breakdown, and where it makes no progress, d is the best
/// iterate so far.
bool LinearSolver::biconjugate_gradients(Objective& objective, const Vector& r, double enough, Vector& d) {
  Vector left = r, p = Vector::Zero(r.size()), q = p, z, t;
  double rho = 1, alpha = 1, omega = 1, least = r.norm();
  Vector best;
  apply(r, best);  // fallback: a direction of the symmetric part
  for (int k = 0, best_at = 0; k < max_iterations_ && left.norm() > enough && k - best_at < max_stagnation; ++k) {
    const double rho_now = r.dot(left), beta = rho_now / rho * alpha / omega;
    rho = rho_now;
    p = left + beta * (p - omega * q);
    apply(p, z);
    objective.product(z, q);
    alpha = rho / r.dot(q);
    d += alpha * z;
    left -= alpha * q;
    apply(left, z);
    objective.product(z, t);
    omega = t.dot(left) / t.squaredNorm();
    d += omega * z;
    left -= omega * t;
    counts_.iterations += 2;
    if (!std::isfinite(left.norm())) break;
    if (left.norm() < least) {
      least = left.norm();
      best = d;
      best_at = k;
    }
  }
  d = best;
  return true;
}

void LinearSolver::solve_projected(Objective& objective, const Vector& x, const Vector& r, Vector& d) {
  d.setZero(r.size());
  if (r.isZero(0)) return;
  objective.linearise(x, projection_);
  Vector Kr;
  objective.product(r, Kr);
  const double scale = Kr.norm() / r.norm();
  shift_ = projection_ == Projection::shift ? first_shift * scale : 0;
  while (!solve(objective, r, projected_tolerance, d)) {
    shift_ = std::max(10 * shift_, first_shift * scale);
    if (shift_ < 1e6 * scale) continue;
    d = r;  // NaN somewhere
    break;
  }
  shift_ = 0;
}

}  // namespace heml
