#include <algorithm>
#include <cmath>
#include <heml/elastic/return_mapping.hpp>
#include <limits>

namespace heml {
namespace {

constexpr double equivalent = 0.816496580927726;  // k = √(2/3)
// Orthonormal vectors of sum 0: deviatoric strains in two numbers.
constexpr double deviatoric_basis[2][3] = {{0.7071067811865476, -0.7071067811865476, 0},
                                           {0.408248290463863, 0.408248290463863, -0.816496580927726}};

template <class Real>
Real dot3(const Real a[3], const Real b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class Real>
Real flow_stress(const FlowStress<Real>& yield, Real length) {
  return Real(equivalent) * (yield.at_start + yield.hardening * Real(equivalent) * length);
}

/// The second derivative of Φ, 2×2 in the basis.
template <class Real>
struct Curvature {
  Real a, b, c;  ///< 11, 12, 22

  Curvature(const PlasticReturn<Real>& at, const FlowStress<Real>& yield) {
    const Real aside = flow_stress(yield, at.length) / at.length;
    const Real along = Real(equivalent * equivalent) * yield.hardening - aside;
    Real entry[2][2];
    for (int r = 0; r < 2; ++r)
      for (int q = 0; q < 2; ++q) {
        entry[r][q] = r == q ? aside : 0;
        Real m[2] = {0, 0};
        for (int i = 0; i < 3; ++i) {
          m[0] += Real(deviatoric_basis[r][i]) * at.flow[i] / at.length;
          m[1] += Real(deviatoric_basis[q][i]) * at.flow[i] / at.length;
          for (int j = 0; j < 3; ++j)
            entry[r][q] += Real(deviatoric_basis[r][i] * deviatoric_basis[q][j]) * at.stress.slope[i][j];
        }
        entry[r][q] += along * m[0] * m[1];
      }
    a = entry[0][0], b = (entry[0][1] + entry[1][0]) / 2, c = entry[1][1];
  }
  bool is_positive() const { return a > 0 && a * c > b * b; }
  /// Solves for a deviatoric right-hand side r.
  void solve(const Real r[3], Real out[3]) const {
    Real in[2] = {0, 0};
    for (int k = 0; k < 2; ++k)
      for (int i = 0; i < 3; ++i) in[k] += Real(deviatoric_basis[k][i]) * r[i];
    const Real determinant = a * c - b * b;
    const Real x = (c * in[0] - b * in[1]) / determinant, y = (a * in[1] - b * in[0]) / determinant;
    for (int i = 0; i < 3; ++i) out[i] = Real(deviatoric_basis[0][i]) * x + Real(deviatoric_basis[1][i]) * y;
  }
};

/// One slot's law as a function of what flows.
template <class Real>
struct ReturnProblem {
  const GroupTerm<Real>& law;
  const ElementGroup<Real>& group;
  std::size_t slot;
  const Real* c;
  Real J;
  FlowStress<Real> yield;

  PlasticReturn<Real> at(const Real d[3]) const {
    PlasticReturn<Real> result;
    Real left[3];
    for (int i = 0; i < 3; ++i) {
      result.flow[i] = d[i];
      left[i] = c[i] * natural_exp(-2 * d[i]);
    }
    result.length = std::sqrt(dot3(d, d));
    result.stress = law.deviatoric_stress(group, slot, left, J);
    return result;
  }
  /// −∂Φ/∂d. Returns its norm.
  Real residual(const PlasticReturn<Real>& at, Real r[3]) const {
    const Real along = flow_stress(yield, at.length) / at.length;
    for (int i = 0; i < 3; ++i) r[i] = at.stress.tau[i] - along * at.flow[i];
    return std::sqrt(dot3(r, r));
  }
};

/// Newton's method from where the stress at the start points. Nothing where Φ is not convex on the way.
template <class Real>
PlasticReturn<Real> find_minimum(const ReturnProblem<Real>& problem, const DeviatoricStress<Real>& start) {
  constexpr int max_steps = 60, max_halvings = 10;
  constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
  const Real size = start.norm(), over = size - flow_stress(problem.yield, Real(0));
  Real d[3], r[3], step[3], next_r[3], slope = Real(equivalent * equivalent) * problem.yield.hardening;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) slope += start.tau[i] * start.slope[i][j] * start.tau[j] / (size * size);
  if (!(slope > 0 && over > 0)) return {};
  for (int i = 0; i < 3; ++i) d[i] = over / slope * start.tau[i] / size;
  PlasticReturn<Real> at = problem.at(d);
  if (!(at.length > 0)) return {};
  const Real round_off = 4 * epsilon * (size + slope),
             near = 64 * round_off;  // the strains' own is multiplied by slope
  Real left = problem.residual(at, r);
  for (int k = 0; k < max_steps && left > round_off; ++k) {
    const Curvature<Real> curvature(at, problem.yield);
    if (!curvature.is_positive()) return {};
    curvature.solve(r, step);
    PlasticReturn<Real> next;
    Real next_left = left;
    const int last = left > near ? max_halvings : 0;
    for (int halvings = 0; halvings <= last && !(next_left < left); ++halvings) {
      for (int i = 0; i < 3; ++i) d[i] = at.flow[i] + std::ldexp(step[i], -halvings);
      next = problem.at(d);
      next_left = problem.residual(next, next_r);
    }
    if (!(next_left < left)) break;
    at = next, left = next_left;
    std::copy_n(next_r, 3, r);
  }
  at.is_minimum = left <= near && Curvature<Real>(at, problem.yield).is_positive();
  return at.is_minimum ? at : PlasticReturn<Real>{};
}

/// Flow along the deviatoric strain, by halves between none and all of it.
template <class Real>
PlasticReturn<Real> find_along_strain(const ReturnProblem<Real>& problem) {
  Real n[3], d[3], mean = 0;
  for (int i = 0; i < 3; ++i) {
    n[i] = natural_log(problem.c[i]) / 2;
    mean += n[i] / 3;
  }
  for (Real& value : n) value -= mean;
  Real low = 0, high = 1;
  const auto part = [&](Real size) {
    for (int i = 0; i < 3; ++i) d[i] = size * n[i];
    return problem.at(d);
  };
  for (int i = 0; i < 60 && high - low > std::numeric_limits<Real>::epsilon(); ++i) {
    const Real middle = (low + high) / 2;
    const PlasticReturn<Real> at = part(middle);
    (at.stress.norm() > flow_stress(problem.yield, at.length) ? low : high) = middle;
  }
  return part(high);
}

}  // namespace

template <class Real>
Real PlasticReturn<Real>::equivalent_strain() const {
  return Real(equivalent) * length;
}

template <class Real>
double PlasticReturn<Real>::work() const {
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += static_cast<double>(stress.tau[i] * flow[i]);
  return sum;
}

template <class Real>
PlasticReturn<Real> return_mapping(const GroupTerm<Real>& law, const ElementGroup<Real>& group, std::size_t s,
                                   const Real c[3], Real J, const FlowStress<Real>& yield) {
  PlasticReturn<Real> none;
  none.stress = law.deviatoric_stress(group, s, c, J);
  if (!(none.stress.norm() > flow_stress(yield, Real(0)))) return none;
  const ReturnProblem<Real> problem{law, group, s, c, J, yield};
  const PlasticReturn<Real> minimum = find_minimum(problem, none.stress);
  return minimum.is_minimum ? minimum : find_along_strain(problem);
}

template <class Real>
void flow_tangent(const PlasticReturn<Real>& at, const FlowStress<Real>& yield, Real change[3][3]) {
  const Curvature<Real> curvature(at, yield);
  Real answer[3][3], column[3];
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) column[i] = at.stress.slope[i][j];
    curvature.solve(column, answer[j]);
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      change[i][j] = 0;
      for (int k = 0; k < 3; ++k) change[i][j] -= at.stress.slope[k][i] * answer[j][k];
    }
}

template struct PlasticReturn<float>;
template struct PlasticReturn<double>;
template PlasticReturn<float> return_mapping(const GroupTerm<float>&, const ElementGroup<float>&, std::size_t,
                                             const float*, float, const FlowStress<float>&);
template PlasticReturn<double> return_mapping(const GroupTerm<double>&, const ElementGroup<double>&, std::size_t,
                                              const double*, double, const FlowStress<double>&);
template void flow_tangent(const PlasticReturn<float>&, const FlowStress<float>&, float[3][3]);
template void flow_tangent(const PlasticReturn<double>&, const FlowStress<double>&, double[3][3]);

}  // namespace heml
