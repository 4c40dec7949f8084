#pragma once
// Fits the parameters of a law to measured curves (math/least_squares.hpp).
#include <functional>
#include <heml/materials/test_bench.hpp>
#include <string>
#include <variant>
#include <vector>

namespace heml {

/// Nominal stress (Pa) against stretch, γ, or time (s); both of the same length.
struct MeasuredCurve {
  std::vector<double> amount, stress;
};

/// Stress relaxation test: stress against time after a step of stretch that is then kept constant.
struct Relaxation {
  double stretch = 1.1;  ///< uniaxial
};

/// The test in which a curve was measured.
using MeasuredTest = std::variant<BenchTest, Relaxation>;

struct FitOptions {
  bool fit_volume = false;  ///< also κ (or λ), which homogeneous tests hardly determine
};

struct FittedParameter {
  std::string name;  ///< "mu[0]", "relaxation[0].tau"; "factor of all moduli" in a relaxation test
  std::string unit;  ///< "" for a ratio
  double value = 0;
  double standard_error = 0;  ///< of the value; infinite if the data do not determine it
  bool determined = true;     ///< false: the data do not determine it, or only together with another
};

struct FitResult {
  Material material;  ///< as given, with the fitted values
  std::vector<FittedParameter> parameters;
  double rms = 0;        ///< Pa, root of the mean squared residual
  double r_squared = 0;  ///< coefficient of determination
  int iterations = 0;
  bool converged = false;
};

/// Why the material cannot be fitted to the data, with a remedy, in one sentence; empty if it can.
std::string fit_problem(const Material& material, const MeasuredTest& test, const MeasuredCurve& data,
                        const FitOptions& options);

/// Fits, starting from the material's own parameters. Parameters whose sign material_problem() fixes keep it (fitted as
/// logarithms). A relaxation test fits γ and τ of every term and one common factor of the law's moduli except the
/// volume modulus: a single stretch does not determine them separately. progress, if given, is called with the fraction
/// of the maximum number of iterations. Requires that fit_problem() is empty.
FitResult fit_material(const Material& material, const MeasuredTest& test, const MeasuredCurve& data,
                       const FitOptions& options, const std::function<void(double)>& progress = {});

/// Nominal stress (Pa) of a test at the given amounts, in their order; nothing if one of them cannot be reached.
std::optional<std::vector<double>> nominal_stresses(const Material& material, const MeasuredTest& test,
                                                    std::span<const double> amounts);

}  // namespace heml
