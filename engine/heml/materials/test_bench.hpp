#pragma once
// A law on the test bench: homogeneous deformations of a cube whose free faces bear no stress, as in the tests that
// soft tissue is measured with. Axes are x (load), y and z; F is diagonal but for shear. A fibre that lies askew would
// shear a free cube too: the bench holds it upright, as grips do.
//
//    uniaxial       λ along x; y and z free          planar   λ along x, 1 along y; z free ("pure shear")
//    equibiaxial    λ along x and y; z free          shear    x moves by γ a unit of y; nothing is free
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
  double cauchy = 0;   ///< Pa, force per present area: σ_xx, or σ_xy
  Mat3 F = Mat3::Identity();
};

struct BenchCurve {
  std::vector<BenchPoint> points;  ///< ascending in amount: all that could be reached
  std::vector<double> missed;      ///< ascending: amounts past the law's range, or where no free face finds a balance
};

/// Runs a test at given amounts (any order; stretches above 0). Free stretches are found to round-off, by following
/// them from the rest shape. Any number of threads.
BenchCurve run_bench(const MaterialPoint& law, BenchTest test, std::span<const double> amounts);

/// `count` evenly spaced amounts from `low` to `high`, both included.
std::vector<double> evenly_spaced(double low, double high, int count);

/// G(t)/G∞ = 1 + Σ γ exp(−t/τ): by what the stress of the law is multiplied a time t (s) after a sudden step that is
/// then held. Exact for the isochoric stress; free stretches change by the order of μ/κ meanwhile, which is left out.
double relaxation_factor(std::span<const PronyTerm> terms, double time);

}  // namespace heml
