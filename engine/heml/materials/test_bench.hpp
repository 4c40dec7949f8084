#pragma once
// Homogeneous deformations of a cube whose free faces bear no stress, as in mechanical tests of soft tissue. Axes are x
// (load), y and z; F is diagonal except in shear. An oblique fibre would also shear a free cube; the bench prevents
// that, as grips do.
//
//    uniaxial       λ along x; y and z free          planar   λ along x, 1 along y; z free ("pure shear")
//    equibiaxial    λ along x and y; z free          shear    F_xy = γ; no face is free
#include <heml/materials/point.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace heml {

enum class BenchTest { uniaxial, equibiaxial, planar, shear };
std::span<const std::string_view> bench_test_names();  ///< in the order of the enum

/// One state of a test.
struct BenchPoint {
  double amount = 1;   ///< λ along x, or γ
  double nominal = 0;  ///< Pa, force per rest area: P_xx, or P_xy
  double cauchy = 0;   ///< Pa, force per deformed area: σ_xx, or σ_xy
  Mat3 F = Mat3::Identity();
};

struct BenchCurve {
  std::vector<BenchPoint> points;  ///< ascending in amount: the states that could be reached
  std::vector<double> unreached;   ///< ascending: amounts outside the law's range or without equilibrium of free faces
};

/// Runs a test at the given amounts (any order; stretches above 0). Free stretches are followed from the rest shape and
/// solved to round-off. Thread-safe.
BenchCurve run_bench(const MaterialPoint& law, BenchTest test, std::span<const double> amounts);

/// `count` evenly spaced values from `low` to `high`, both included.
std::vector<double> evenly_spaced(double low, double high, int count);

/// G(t)/G∞ = 1 + Σ γ exp(−t/τ): factor on the law's stress at time t (s) after a step of strain that is then kept
/// constant. Exact for the isochoric stress; neglects the change of free stretches, which is of order μ/κ.
double relaxation_factor(std::span<const PronyTerm> terms, double time);

}  // namespace heml
