#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <heml/math/least_squares.hpp>

namespace heml {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr double round_off_column = 1e-9;  // norm, relative to the largest

std::optional<Matrix> jacobian(const LeastSquaresProblem& problem, const Vector& u, const Vector& r) {
  Matrix J(r.size(), u.size());
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const double h = problem.difference_step * std::max(1.0, std::abs(u[i]));
    Vector above = u, below = u;
    above[i] += h, below[i] -= h;
    const auto high = problem.residuals(above), low = problem.residuals(below);
    if (!high && !low) return std::nullopt;
    J.col(i) = ((high ? *high : r) - (low ? *low : r)) / (high && low ? 2 * h : h);
  }
  // A variable without influence has a column of round-off, along which steps would lead anywhere.
  const double largest = J.colwise().norm().maxCoeff();
  for (Eigen::Index i = 0; i < u.size(); ++i)
    if (J.col(i).norm() <= round_off_column * largest) J.col(i).setZero();
  return J;
}

/// Takes one step downhill. False where none is left within round-off.
bool step_downhill(const LeastSquaresProblem& problem, const LeastSquaresOptions& options, double& damping,
                   LeastSquaresFit& at) {
  const Matrix A = at.J.transpose() * at.J;
  const Vector g = at.J.transpose() * at.r, diagonal = A.diagonal().cwiseMax(1e-12 * A.diagonal().maxCoeff());
  while (damping < 1e12) {
    Matrix damped = A;
    damped.diagonal() += damping * diagonal;
    const Vector step = damped.ldlt().solve(-g), next = at.u + step;
    const auto r = step.allFinite() && step.cwiseAbs().maxCoeff() < 5 ? problem.residuals(next) : std::nullopt;
    if (!r || !(r->squaredNorm() < at.r.squaredNorm())) {
      damping *= 4;
      continue;
    }
    at.converged = at.r.squaredNorm() - r->squaredNorm() <= options.change * at.r.squaredNorm() &&
                   step.norm() <= options.step * (1 + at.u.norm());
    at.u = next;
    at.r = *r;
    damping = std::max(damping / 9, 1e-12);
    return true;
  }
  return false;
}

}  // namespace

LeastSquaresFit minimise_squares(const LeastSquaresProblem& problem, const Vector& start,
                                 const LeastSquaresOptions& options) {
  LeastSquaresFit at{start, *problem.residuals(start), {}};
  double damping = 1e-3;
  for (; at.iterations < options.max_iterations && !at.converged; ++at.iterations) {
    if (options.progress) options.progress(static_cast<double>(at.iterations) / options.max_iterations);
    const auto J = jacobian(problem, at.u, at.r);
    if (!J) break;
    at.J = *J;
    if (!step_downhill(problem, options, damping, at)) at.converged = true;
  }
  return at;
}

Certainty certainty(const LeastSquaresFit& fit, std::optional<double> variance, double smallest) {
  const Eigen::Index n = fit.u.size(), surplus = fit.r.size() - n;
  const double s2 = variance ? *variance : surplus > 0 ? fit.r.squaredNorm() / static_cast<double>(surplus) : 0;
  Vector norms = fit.J.colwise().norm();
  const double largest = norms.maxCoeff();
  norms = norms.unaryExpr([&](double x) { return x > 1e-12 * largest ? x : 1.0; });
  const Eigen::JacobiSVD<Matrix> svd(fit.J * norms.cwiseInverse().asDiagonal(), Eigen::ComputeThinV);
  Certainty result{Vector::Zero(n), std::vector<bool>(static_cast<std::size_t>(n), false)};
  for (Eigen::Index k = 0; k < n; ++k) {
    const double sigma = k < svd.singularValues().size() ? svd.singularValues()[k] : 0;
    const bool open = !(sigma > smallest * svd.singularValues()[0]);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double share = svd.matrixV()(i, k);
      if (open && std::abs(share) > 0.05) result.undetermined[static_cast<std::size_t>(i)] = true;
      if (!open) result.error[i] += s2 * share * share / (sigma * sigma * norms[i] * norms[i]);
    }
  }
  result.error = result.error.cwiseSqrt();
  return result;
}

double student_quantile(long degrees_of_freedom) {
  if (degrees_of_freedom <= 1) return 12.706204736;
  if (degrees_of_freedom == 2) return 4.302652730;
  const double n = static_cast<double>(degrees_of_freedom);
  constexpr double x = 1.959963985, x2 = x * x;
  constexpr double g1 = x * (x2 + 1) / 4, g2 = x * ((5 * x2 + 16) * x2 + 3) / 96,
                   g3 = x * (((3 * x2 + 19) * x2 + 17) * x2 - 15) / 384,
                   g4 = x * ((((79 * x2 + 776) * x2 + 1482) * x2 - 1920) * x2 - 945) / 92160;
  return x + (g1 + (g2 + (g3 + g4 / n) / n) / n) / n;
}

}  // namespace heml
