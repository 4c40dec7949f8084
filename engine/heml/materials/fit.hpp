#pragma once
// Parameters of a law from measured curves: nonlinear least squares by the Levenberg-Marquardt method.
// D. W. Marquardt: An Algorithm for Least-Squares Estimation of Nonlinear Parameters. J. SIAM 11 (2), 1963.
#include <functional>
#include <heml/materials/test_bench.hpp>
#include <string>
#include <variant>
#include <vector>

namespace heml {

/// What was measured: nominal stress (Pa) against stretch, γ, or time (s). Both columns of the same length.
struct MeasuredCurve {
  std::vector<double> amount, stress;
};

/// A sudden step that is then held: stress against time.
struct Relaxation {
  double stretch = 1.1;  ///< uniaxial
};

/// What a curve was measured in.
using MeasuredTest = std::variant<BenchTest, Relaxation>;

struct FitOptions {
  bool fit_volume = false;  ///< also κ (or λ), which homogeneous tests hardly see
};

struct FittedParameter {
  std::string name;  ///< "mu[0]", "relaxation[0].tau"; "factor of all moduli" in a relaxation test
  std::string unit;  ///< "" for a ratio
  double value = 0;
  double standard_error = 0;  ///< of the value; infinite where the data say nothing of it
  bool determined = true;     ///< false: the data leave it open alone or together with another
};

struct FitResult {
  Material material;  ///< as given, with the fitted values
  std::vector<FittedParameter> parameters;
  double rms = 0;        ///< Pa, root of the mean squared residual
  double r_squared = 0;  ///< share of the data's variance that the curve explains
  int iterations = 0;
  bool converged = false;
};

/// What stands in the way of fitting: empty, or one sentence with what to do.
std::string fit_problem(const Material& material, const MeasuredTest& test, const MeasuredCurve& data,
                        const FitOptions& options);

/// Starts from the material's own parameters. Those whose sign material_problem() fixes keep it (fitted as logarithms).
/// A relaxation test fits γ and τ of every term and one factor of all the law's moduli but the volume's: a single
/// stretch does not tell them apart. progress, if given, is called with the share of the most iterations that is done.
/// The material must be one that fit_problem() has nothing against.
FitResult fit_material(const Material& material, const MeasuredTest& test, const MeasuredCurve& data,
                       const FitOptions& options, const std::function<void(double)>& progress = {});

/// Nominal stress (Pa) of a test at given amounts; nothing when one of them cannot be reached.
std::optional<std::vector<double>> nominal_stresses(const Material& material, const MeasuredTest& test,
                                                    std::span<const double> amounts);

}  // namespace heml
