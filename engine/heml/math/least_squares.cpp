#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <heml/math/least_squares.hpp>

namespace heml {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr double round_off_column = 1e-9;  // norm, relative to the largest
constexpr double min_scale = 1e-6;         // of a variable, relative to the largest
constexpr double min_damping = 1e-12;

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

/// Where r(u + s) is taken to be r + J s: ‖D s‖ ≤ radius and |s_i| ≤ reach. D has the largest norm so far of each
/// column of J, so that a variable does not run away where it has lost its influence.
struct TrustRegion {
  Vector scale;  ///< D
  double radius = 0;
  double reach = 2;  ///< of a logarithm: a factor of 7
  bool is_cut = false;  ///< smaller than the data ask for, since r is not defined all round

  void adopt(const Matrix& J) {
    const Vector norms = J.colwise().norm().transpose();
    const bool is_first = scale.size() == 0;
    scale = is_first ? norms : Vector(scale.cwiseMax(norms));
    if (is_first) radius = scale.norm();
  }

  struct Step {
    Vector s;
    bool is_limited;  ///< by the region
  };
  /// To the least ‖r + J s‖² there.
  Step step(const Matrix& J, const Vector& r) const {
    const Matrix A = J.transpose() * J;
    const Vector g = J.transpose() * r, diagonal = scale.cwiseMax(min_scale * scale.maxCoeff()).cwiseAbs2();
    for (double damping = min_damping;; damping *= 2) {
      Matrix damped = A;
      damped.diagonal() += damping * diagonal;
      const Vector s = damped.ldlt().solve(-g);
      if (!(length(s) > radius) && !(s.cwiseAbs().maxCoeff() > reach)) return {s, damping > min_damping};
    }
  }
  double length(const Vector& s) const { return scale.cwiseProduct(s).norm(); }

  /// gain: what |r|² has fallen by, over what the derivative told.
  void adapt(double gain, const Vector& s) {
    if (gain < 0.25) radius = length(s) / 4;
    if (gain <= 0.75) return;
    radius = std::max(radius, 2 * length(s));
    reach = std::max(reach, 2 * s.cwiseAbs().maxCoeff());
  }
};

/// Takes one step downhill. False where none is left: as at a least value, where r is defined round it.
bool step_downhill(const LeastSquaresProblem& problem, const LeastSquaresOptions& options, TrustRegion& region,
                   LeastSquaresFit& at) {
  region.adopt(at.J);
  while (true) {
    const auto [step, is_limited] = region.step(at.J, at.r);
    const Vector next = at.u + step;
    const bool is_short = !(step.norm() > options.step * (1 + at.u.norm()));
    const auto r = problem.residuals(next);
    const bool is_defined = r && r->allFinite();
    const double before = at.r.squaredNorm(), fall = is_defined ? before - r->squaredNorm() : -1;
    const double told = before - (at.r + at.J * step).squaredNorm();
    region.adapt(fall > 0 ? fall / told : 0, step);  // else it shrinks, whatever told is, until the step is short
    if (!is_defined) region.is_cut = true;
    if (fall > 0) {
      if (!is_limited) region.is_cut = false;
      at.converged = is_short && !is_limited && fall <= options.change * before;
      at.u = next;
      at.r = *r;
      return true;
    }
    if (is_short) {
      at.converged = !region.is_cut;
      return false;
    }
  }
}

}  // namespace

LeastSquaresFit minimise_squares(const LeastSquaresProblem& problem, const Vector& start,
                                 const LeastSquaresOptions& options) {
  LeastSquaresFit at{start, *problem.residuals(start), {}};
  TrustRegion region;
  for (; at.iterations < options.max_iterations && !at.converged; ++at.iterations) {
    if (options.progress) options.progress(static_cast<double>(at.iterations) / options.max_iterations);
    const auto J = jacobian(problem, at.u, at.r);
    if (!J) break;
    at.J = *J;
    if (!step_downhill(problem, options, region, at)) break;
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
