#include <algorithm>
#include <array>
#include <cmath>
#include <heml/materials/test_bench.hpp>
#include <optional>

namespace heml {
namespace {

constexpr int max_newton_steps = 60;
constexpr int max_halvings = 12;  // of a step of the amount, and of a Newton step

/// Axes whose faces are free in a test; the stretches of the others are prescribed.
std::span<const int> free_axes(BenchTest test) {
  static constexpr std::array<int, 2> across{1, 2};
  switch (test) {
    case BenchTest::uniaxial:
      return across;
    case BenchTest::equibiaxial:
    case BenchTest::planar:
      return std::span(across).subspan(1);
    case BenchTest::shear:
      break;
  }
  return {};
}

/// F of a test, with the free stretches of the previous state F.
Mat3 prescribed(BenchTest test, double amount, Mat3 F) {
  if (test == BenchTest::shear) {
    F(0, 1) = amount;
    return F;
  }
  F(0, 0) = amount;
  if (test == BenchTest::equibiaxial) F(1, 1) = amount;
  return F;
}

/// Solves P_ii = 0 on the free axes by Newton's method in logarithms of the stretches, with each step halved until the
/// residual decreases. Returns nothing where the law is undefined or the method fails.
class FreeStretchSolver {
 public:
  FreeStretchSolver(const MaterialPoint& law, BenchTest test) : law_(law), free_(free_axes(test)) {}

  std::optional<Mat3> operator()(Mat3 F) const {
    if (!law_.valid(F)) return std::nullopt;
    if (free_.empty()) return F;
    for (int i = 0; i < max_newton_steps; ++i) {
      const Mat3 P = law_.first_piola(F);
      const Vec3 r = residual(F, P);
      const Mat3 S = slope(F, P);
      const Vec3 step = -(S.inverse() * r);
      if (!step.allFinite()) return std::nullopt;
      if (step.cwiseAbs().maxCoeff() < round_off) return stretched(F, step);
      const auto better = improved(F, r.norm(), step);
      // Round-off may keep the residual from decreasing before the step is that small.
      if (!better) return r.norm() < stress_tolerance * S.norm() ? std::optional(F) : std::nullopt;
      F = *better;
    }
    return std::nullopt;
  }

 private:
  static constexpr double round_off = 1e-14;        // of the logarithm of a stretch
  static constexpr double stress_tolerance = 1e-9;  // stress on a free face, relative to the stiffness there

  /// λ_i P_ii = ∂W/∂(ln λ_i) on the free axes, 0 on the others. Pa.
  Vec3 residual(const Mat3& F, const Mat3& P) const {
    Vec3 r = Vec3::Zero();
    for (const int i : free_) r[i] = F(i, i) * P(i, i);
    return r;
  }

  /// ∂r_i/∂(ln λ_j) between free axes, Pa; identity on the others, whose residual is 0.
  Mat3 slope(const Mat3& F, const Mat3& P) const {
    Mat3 S = Mat3::Identity();
    for (const int j : free_) {
      Mat3 dF = Mat3::Zero();
      dF(j, j) = F(j, j);
      const Mat3 dP = law_.first_piola_differential(F, dF);
      for (const int i : free_) S(i, j) = F(i, i) * dP(i, i) + (i == j ? F(j, j) * P(j, j) : 0);
    }
    return S;
  }

  Mat3 stretched(Mat3 F, const Vec3& logarithms) const {
    for (const int i : free_) F(i, i) *= std::exp(logarithms[i]);
    return F;
  }

  std::optional<Mat3> improved(const Mat3& F, double norm, Vec3 step) const {
    step *= std::min(1.0, 0.5 / step.cwiseAbs().maxCoeff());
    for (int k = 0; k <= max_halvings; ++k, step /= 2) {
      const Mat3 next = stretched(F, step);
      if (law_.valid(next) && residual(next, law_.first_piola(next)).norm() < norm) return next;
    }
    return std::nullopt;
  }

  const MaterialPoint& law_;
  std::span<const int> free_;
};

/// Follows the free stretches from one amount to another, with as many steps as Newton's method needs.
class PathFollower {
 public:
  PathFollower(const MaterialPoint& law, BenchTest test) : solver_(law, test), test_(test) {}

  std::optional<Mat3> at(double amount, Mat3 F) const { return solver_(prescribed(test_, amount, F)); }

  /// From F at amount `begin` to amount `end`; nothing if that cannot be reached.
  std::optional<Mat3> follow(Mat3 F, double begin, double end) const {
    double step = end - begin;
    const double min_step = std::abs(step) * std::ldexp(1.0, -max_halvings);
    while (begin != end) {
      const bool last = std::abs(end - begin) <= std::abs(step);
      const double next = last ? end : begin + step;
      if (const auto found = at(next, F)) {
        F = *found;
        begin = next;
      } else {
        step /= 2;
        if (std::abs(step) < min_step) return std::nullopt;
      }
    }
    return F;
  }

 private:
  FreeStretchSolver solver_;
  BenchTest test_;
};

BenchPoint point_at(const MaterialPoint& law, BenchTest test, double amount, const Mat3& F) {
  const Mat3 P = law.first_piola(F);
  const Mat3 sigma = P * F.transpose() / F.determinant();
  const int column = test == BenchTest::shear ? 1 : 0;
  return {amount, P(0, column), sigma(0, column), F};
}

}  // namespace

std::span<const std::string_view> bench_test_names() {
  static constexpr std::string_view names[] = {"uniaxial", "equibiaxial", "planar", "shear"};
  return names;
}

BenchCurve run_bench(const MaterialPoint& law, BenchTest test, std::span<const double> amounts) {
  const double rest = test == BenchTest::shear ? 0 : 1;
  std::vector<double> sorted(amounts.begin(), amounts.end());
  std::sort(sorted.begin(), sorted.end());
  const auto middle = std::lower_bound(sorted.begin(), sorted.end(), rest);
  const PathFollower follower(law, test);
  BenchCurve curve;
  const std::optional<Mat3> start = follower.at(rest, Mat3::Identity());
  // From the rest shape in both directions; the first amount that cannot be reached ends that direction.
  const auto march = [&](auto from, auto to) {
    std::optional<Mat3> F = start;
    double before = rest;
    for (; from != to; ++from) {
      if (F) F = follower.follow(*F, before, *from);
      before = *from;
      if (F)
        curve.points.push_back(point_at(law, test, *from, *F));
      else
        curve.unreached.push_back(*from);
    }
  };
  march(std::make_reverse_iterator(middle), sorted.rend());
  std::reverse(curve.points.begin(), curve.points.end());
  std::reverse(curve.unreached.begin(), curve.unreached.end());
  march(middle, sorted.end());
  return curve;
}

std::vector<double> evenly_spaced(double low, double high, int count) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) values.push_back(count > 1 ? low + (high - low) * k / (count - 1) : low);
  return values;
}

double relaxation_factor(std::span<const PronyTerm> terms, double time) {
  double factor = 1;
  for (const PronyTerm& term : terms) factor += term.gamma * std::exp(-time / term.tau);
  return factor;
}

}  // namespace heml
