#pragma once
// Nonlinear least squares by the Levenberg-Marquardt method in a trust region (J. J. Moré: The Levenberg-Marquardt
// Algorithm: Implementation and Theory. Numerical Analysis, Lecture Notes in Mathematics 630, Springer 1978), and how
// well the data determine the variables.
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

namespace heml {

struct LeastSquaresProblem {
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  /// r(u); nothing where it is undefined.
  std::function<std::optional<Vector>(const Vector& u)> residuals;
  /// Step of the differences for ∂r/∂u, relative to max(1, |u_i|): central, one-sided where r is undefined on the other
  /// side.
  double difference_step = 1e-5;
};

struct LeastSquaresOptions {
  int max_iterations = 150;
  /// The iteration ends at a step that changes |r|² and u by no more than these, relative to |r|² and to 1 + |u|.
  double change = 1e-14, step = 1e-8;
  std::function<void(double)> progress = {};  ///< called with the fraction of max_iterations
};

struct LeastSquaresFit {
  Eigen::VectorXd u, r;
  Eigen::MatrixXd J;  ///< ∂r/∂u where the last step began
  int iterations = 0;
  bool converged = false;
};

/// Requires that the residuals are defined at `start`.
LeastSquaresFit minimise_squares(const LeastSquaresProblem& problem, const Eigen::VectorXd& start,
                                 const LeastSquaresOptions& options = {});

/// Standard errors of u from the covariance s² (JᵀJ)⁻¹, and the undetermined variables: those with a component in a
/// direction along which the residuals do not change.
struct Certainty {
  Eigen::VectorXd error;
  std::vector<bool> undetermined;
};

/// variance: s², of a residual; none: estimated from the residuals. smallest: singular value of J with columns of
/// length 1, relative to the largest, below which a direction counts as undetermined; more than the error of J.
Certainty certainty(const LeastSquaresFit& fit, std::optional<double> variance = {}, double smallest = 1e-7);

/// 97.5 % quantile of Student's distribution, which a 95 % interval extends to on both sides (M. Abramowitz, I. A.
/// Stegun: Handbook of Mathematical Functions, 26.7.5; off by 0.1 % with 3 degrees of freedom, less with more).
double student_quantile(long degrees_of_freedom);

}  // namespace heml
