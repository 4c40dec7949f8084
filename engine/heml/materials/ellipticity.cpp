#include <Eigen/Eigenvalues>
#include <cmath>
#include <heml/materials/ellipticity.hpp>
#include <limits>

namespace heml {
namespace {

constexpr int sampled_directions = 200;              // of a half sphere, about 10° apart
constexpr double first_turn = 0.1, min_turn = 1e-3;  // rad, of the search from the best of them

double lowest_eigenvalue(const Tangent& tangent, const Vec3& N) {
  Mat3 Q;
  for (int i = 0; i < 3; ++i) Q.col(i) = tangent(Vec3::Unit(i) * N.transpose()) * N;
  return Eigen::SelfAdjointEigenSolver<Mat3>((Q + Q.transpose()) / 2, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

/// Direction k of a spiral over the half sphere z > 0.
Vec3 direction(int k) {
  const double z = (k + 0.5) / sampled_directions, angle = 2.399963229728653 * k, r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace

double min_acoustic_eigenvalue(const Tangent& tangent) {
  double lowest = std::numeric_limits<double>::infinity();
  Vec3 best = Vec3::UnitZ();
  const auto look_at = [&](const Vec3& N) {
    const double value = lowest_eigenvalue(tangent, N);
    if (!(value < lowest)) return false;
    lowest = value;
    best = N;
    return true;
  };
  for (int k = 0; k < sampled_directions; ++k) look_at(direction(k));
  for (double turn = first_turn; turn > min_turn; turn /= 2) {
    const Vec3 a = best.unitOrthogonal(), b = best.cross(a), from = best;
    for (const Vec3& aside : {a, Vec3(-a), b, Vec3(-b)}) look_at((from + turn * aside).normalized());
  }
  return lowest;
}

Mat3 spring_tangent(double k, const Vec3& edge, double volume, const Mat3& F, const Mat3& dF) {
  const Vec3 now = F * edge, n = now.normalized(), change = dF * edge;
  const double slack = 1 - edge.norm() / now.norm();
  const Vec3 along = n.dot(change) * n;
  return k / volume * (along + slack * (change - along)) * edge.transpose();
}

}  // namespace heml
