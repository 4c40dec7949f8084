#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/materials/fit.hpp>
#include <heml/materials/parameter_slots.hpp>
#include <heml/math/least_squares.hpp>
#include <limits>
#include <numeric>

namespace heml {
namespace {

using Vector = Eigen::VectorXd;

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
class CurveMisfit {
 public:
  CurveMisfit(const Material& material, const MeasuredTest& test, const MeasuredCurve& data, const FitOptions& options)
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

 private:
  const Material& material_;
  const MeasuredTest& test_;
  const MeasuredCurve& data_;
  std::vector<Variable> variables_;
  std::vector<double> scale_;
};

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
  const CurveMisfit problem(material, test, data, options);
  LeastSquaresOptions search;
  search.progress = progress;
  const LeastSquaresFit end =
      minimise_squares({[&](const Vector& u) { return problem.residuals(u); }}, problem.start(), search);
  const Certainty certain = certainty(end);
  FitResult fit;
  fit.material = problem.material(end.u);
  fit.iterations = end.iterations;
  fit.converged = end.converged;
  for (std::size_t i = 0; i < problem.size(); ++i) {
    const Variable& v = problem.variables()[i];
    FittedParameter p{v.name, v.unit, problem.value(i, end.u), 0, !certain.undetermined[i]};
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
