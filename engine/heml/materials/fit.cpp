#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <heml/materials/fit.hpp>
#include <heml/materials/parameter_slots.hpp>
#include <limits>
#include <numeric>

namespace heml {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr int max_iterations = 150;
constexpr double difference_step = 1e-5;     // of central differences, relative
constexpr double min_singular_value = 1e-7;  // relative; below it the data do not determine a direction

/// One fitted variable, and how it is written into a material.
struct Variable {
  std::string name, unit;
  double start;
  bool has_fixed_sign;                       ///< fitted as a logarithm
  std::vector<std::size_t> moduli;           ///< indices into Material::parameters that it scales; or
  double* (*place)(Material&, std::size_t);  ///< the location of the value itself
  std::size_t index;
};

double* parameter_place(Material& material, std::size_t index) { return &material.parameters[index]; }
double* gamma_place(Material& material, std::size_t index) { return &material.relaxation[index].gamma; }
double* tau_place(Material& material, std::size_t index) { return &material.relaxation[index].tau; }

std::vector<Variable> variables_of(const Material& material, const MeasuredTest& test, const FitOptions& options) {
  const LawInfo& law = *find_law(material.law);
  const std::vector<ParameterSlot> slots = parameter_slots(material, law);
  const std::optional<std::size_t> volume = volume_parameter(material, law);
  std::vector<Variable> variables;
  if (std::holds_alternative<Relaxation>(test)) {
    Variable factor{"factor of all moduli", "", 1, true, {}, nullptr, 0};
    for (std::size_t i = 0; i < slots.size(); ++i)
      if (slots[i].info->unit == "Pa" && i != volume) factor.moduli.push_back(i);
    variables.push_back(factor);
    for (std::size_t k = 0; k < material.relaxation.size(); ++k) {
      const PronyTerm& term = material.relaxation[k];
      variables.push_back({fmt::format("relaxation[{}].gamma", k), "", term.gamma, true, {}, gamma_place, k});
      variables.push_back({fmt::format("relaxation[{}].tau", k), "s", term.tau, true, {}, tau_place, k});
    }
    return variables;
  }
  for (std::size_t i = 0; i < slots.size(); ++i)
    if (i != volume || options.fit_volume)
      variables.push_back({slots[i].key(),
                           std::string(slots[i].info->unit),
                           material.parameters[i],
                           has_fixed_sign(material, i),
                           {},
                           parameter_place,
                           i});
  return variables;
}

/// The least-squares problem in the variables u = ln |value| where the sign is fixed, else value / scale.
class LeastSquares {
 public:
  LeastSquares(const Material& material, const MeasuredTest& test, const MeasuredCurve& data, const FitOptions& options)
      : material_(material), test_(test), data_(data), variables_(variables_of(material, test, options)) {
    const double modulus = small_strain_moduli(material).shear;
    for (const Variable& v : variables_)
      scale_.push_back(v.start != 0 ? std::abs(v.start) : v.unit == "Pa" ? modulus : 1.0);
  }

  std::size_t size() const { return variables_.size(); }
  const std::vector<Variable>& variables() const { return variables_; }

  Vector start() const {
    return Vector::NullaryExpr(std::ssize(variables_), [this](auto i) {
      return variables_[i].has_fixed_sign ? std::log(std::abs(variables_[i].start)) : variables_[i].start / scale_[i];
    });
  }

  double value(std::size_t i, const Vector& u) const {
    const double at = u[static_cast<Eigen::Index>(i)];
    return variables_[i].has_fixed_sign ? std::copysign(std::exp(at), variables_[i].start) : at * scale_[i];
  }
  double value_per_u(std::size_t i, const Vector& u) const {
    return variables_[i].has_fixed_sign ? std::abs(value(i, u)) : scale_[i];
  }

  Material material(const Vector& u) const {
    Material result = material_;
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      const Variable& v = variables_[i];
      for (const std::size_t k : v.moduli) result.parameters[k] = material_.parameters[k] * value(i, u);
      if (v.place) *v.place(result, v.index) = value(i, u);
    }
    return result;
  }

  /// Model − measured, Pa; nothing where the law is undefined.
  std::optional<Vector> residuals(const Vector& u) const {
    const Material trial = material(u);
    if (!u.allFinite() || material_problem(trial)) return std::nullopt;
    const auto stresses = nominal_stresses(trial, test_, data_.amount);
    if (!stresses) return std::nullopt;
    const Vector r = Eigen::Map<const Vector>(stresses->data(), std::ssize(*stresses)) -
                     Eigen::Map<const Vector>(data_.stress.data(), std::ssize(data_.stress));
    return r.allFinite() ? std::optional(r) : std::nullopt;
  }

  /// ∂r/∂u by central differences, one-sided where the law is undefined on the other side.
  std::optional<Matrix> jacobian(const Vector& u, const Vector& r) const {
    Matrix J(r.size(), u.size());
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      const double h = difference_step * std::max(1.0, std::abs(u[i]));
      Vector above = u, below = u;
      above[i] += h, below[i] -= h;
      const auto high = residuals(above), low = residuals(below);
      if (!high && !low) return std::nullopt;
      J.col(i) = ((high ? *high : r) - (low ? *low : r)) / (high && low ? 2 * h : h);
    }
    return J;
  }

 private:
  const Material& material_;
  const MeasuredTest& test_;
  const MeasuredCurve& data_;
  std::vector<Variable> variables_;
  std::vector<double> scale_;
};

/// Final state of the iteration.
struct FitIterate {
  Vector u, r;
  Matrix J;
  int iterations = 0;
  bool converged = false;
};

FitIterate levenberg_marquardt(const LeastSquares& problem, const std::function<void(double)>& progress) {
  FitIterate at{problem.start(), {}, {}};
  at.r = *problem.residuals(at.u);
  double damping = 1e-3;
  for (; at.iterations < max_iterations && !at.converged; ++at.iterations) {
    if (progress) progress(static_cast<double>(at.iterations) / max_iterations);
    const auto J = problem.jacobian(at.u, at.r);
    if (!J) break;
    at.J = *J;
    const Matrix A = at.J.transpose() * at.J;
    const Vector g = at.J.transpose() * at.r, diagonal = A.diagonal().cwiseMax(1e-12 * A.diagonal().maxCoeff());
    bool better = false;
    while (!better && damping < 1e12) {
      Matrix damped = A;
      damped.diagonal() += damping * diagonal;
      const Vector step = damped.ldlt().solve(-g), next = at.u + step;
      const auto r = step.allFinite() && step.cwiseAbs().maxCoeff() < 5 ? problem.residuals(next) : std::nullopt;
      better = r && r->squaredNorm() < at.r.squaredNorm();
      if (!better) {
        damping *= 4;
        continue;
      }
      at.converged = at.r.squaredNorm() - r->squaredNorm() <= 1e-14 * at.r.squaredNorm() &&
                     step.norm() <= 1e-8 * (1 + at.u.norm());
      at.u = next;
      at.r = *r;
      damping = std::max(damping / 9, 1e-12);
    }
    if (!better) at.converged = true;  // no step downhill is left within round-off
  }
  return at;
}

/// Standard errors in u from the covariance s² (JᵀJ)⁻¹, and the undetermined (open) variables: those with a component
/// in a direction along which the residuals do not change.
struct Certainty {
  Vector error;
  std::vector<bool> open;
};

Certainty certainty(const FitIterate& end) {
  const Eigen::Index n = end.u.size(), surplus = end.r.size() - n;
  const double variance = surplus > 0 ? end.r.squaredNorm() / static_cast<double>(surplus) : 0;
  Vector norms = end.J.colwise().norm();
  const double largest = norms.maxCoeff();
  norms = norms.unaryExpr([&](double x) { return x > 1e-12 * largest ? x : 1.0; });
  const Eigen::JacobiSVD<Matrix> svd(end.J * norms.cwiseInverse().asDiagonal(), Eigen::ComputeThinV);
  Certainty result{Vector::Zero(n), std::vector<bool>(static_cast<std::size_t>(n), false)};
  for (Eigen::Index k = 0; k < n; ++k) {
    const double sigma = k < svd.singularValues().size() ? svd.singularValues()[k] : 0;
    const bool open = !(sigma > min_singular_value * svd.singularValues()[0]);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double share = svd.matrixV()(i, k);
      if (open && std::abs(share) > 0.05) result.open[static_cast<std::size_t>(i)] = true;
      if (!open) result.error[i] += variance * share * share / (sigma * sigma * norms[i] * norms[i]);
    }
  }
  result.error = result.error.cwiseSqrt();
  return result;
}

}  // namespace

std::optional<std::vector<double>> nominal_stresses(const Material& material, const MeasuredTest& test,
                                                    std::span<const double> amounts) {
  const auto law = make_material_point(material, false);
  if (const auto* step = std::get_if<Relaxation>(&test)) {
    const BenchCurve curve = run_bench(*law, BenchTest::uniaxial, std::span(&step->stretch, 1));
    if (!curve.unreached.empty()) return std::nullopt;
    std::vector<double> stresses;
    for (const double time : amounts)
      stresses.push_back(relaxation_factor(material.relaxation, time) * curve.points.front().nominal);
    return stresses;
  }
  const BenchCurve curve = run_bench(*law, std::get<BenchTest>(test), amounts);
  if (!curve.unreached.empty()) return std::nullopt;
  // The curve is sorted by amount, the data need not be.
  std::vector<std::size_t> order(amounts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return amounts[a] < amounts[b]; });
  std::vector<double> stresses(amounts.size());
  for (std::size_t k = 0; k < order.size(); ++k) stresses[order[k]] = curve.points[k].nominal;
  return stresses;
}

std::string fit_problem(const Material& material, const MeasuredTest& test, const MeasuredCurve& data,
                        const FitOptions& options) {
  if (std::holds_alternative<Relaxation>(test) && material.relaxation.empty())
    return "the material has no relaxation terms to start from: add \"relaxation\": [{\"gamma\": 1, \"tau\": 1}]";
  const std::size_t unknowns = variables_of(material, test, options).size();
  if (data.amount.size() < unknowns)
    return fmt::format("{} measured points cannot tell {} parameters: give more points, or a law with fewer parameters",
                       data.amount.size(), unknowns);
  if (!nominal_stresses(material, test, data.amount))
    return "the law leaves its range within the measured curve: start from softer or less curved parameters";
  return "";
}

FitResult fit_material(const Material& material, const MeasuredTest& test, const MeasuredCurve& data,
                       const FitOptions& options, const std::function<void(double)>& progress) {
  const LeastSquares problem(material, test, data, options);
  const FitIterate end = levenberg_marquardt(problem, progress);
  const Certainty certain = certainty(end);
  FitResult fit;
  fit.material = problem.material(end.u);
  fit.iterations = end.iterations;
  fit.converged = end.converged;
  for (std::size_t i = 0; i < problem.size(); ++i) {
    const Variable& v = problem.variables()[i];
    FittedParameter p{v.name, v.unit, problem.value(i, end.u), 0, !certain.open[i]};
    p.standard_error = p.determined ? certain.error[static_cast<Eigen::Index>(i)] * problem.value_per_u(i, end.u)
                                    : std::numeric_limits<double>::infinity();
    if (p.standard_error > std::abs(p.value)) p.determined = false;
    fit.parameters.push_back(std::move(p));
  }
  const double count = static_cast<double>(data.stress.size());
  const Eigen::Map<const Vector> stress(data.stress.data(), std::ssize(data.stress));
  const double spread = (stress.array() - stress.mean()).square().sum();
  fit.rms = std::sqrt(end.r.squaredNorm() / count);
  fit.r_squared = spread > 0 ? 1 - end.r.squaredNorm() / spread : 0;
  return fit;
}

}  // namespace heml
