#pragma once
// K d = r by preconditioned conjugate gradients in float, on the assembled rows of K: what a Newton iteration needs
// where it asks for two to four digits of its linear solution. Positions, residuals and Φ stay in double.
#include <heml/dynamics/smoothed_aggregation.hpp>

namespace heml {

/// The smallest tolerance that float reaches with bodies of any shape.
inline constexpr double min_float_tolerance = 1e-4;

class SinglePrecisionCG {
 public:
  /// mesh: its elements couple nodes. free and team must outlive this.
  SinglePrecisionCG(const FreeNodes& free, const TetMesh& mesh, ThreadTeam& team);

  /// The mesh has lost elements: these are left, by the numbers they had.
  void keep_elements(const std::vector<int>& elements) { K_.keep_elements(elements); }

  /// Takes K where the objective was linearised last, plus shift, N/m, on its diagonal. Returns whether the objective
  /// has it in float.
  bool assemble(Objective& objective, double shift);

  /// d = K⁻¹ r (3 #V; 0 at nodes that are not free) to a residual of tolerance ‖r‖. Returns whether the curvature met
  /// was positive all along; if not, d is what was found before, or the first direction. iterations: added to.
  bool solve(SmoothedAggregation& preconditioner, const Vector& r, double tolerance, int max_iterations, Vector& d,
             long& iterations);

  std::size_t bytes() const { return K_.bytes() + bytes_of(d_, left_, p_, q_, z_) + bytes_of(sums_); }

 private:
  template <class Part>
  double sum(const Part& part);
  double dot(const MultiVector& a, const MultiVector& b);

  const FreeNodes& free_;
  ThreadTeam& team_;
  BsrMatrix K_;
  MultiVector d_, left_, p_, q_, z_;
  std::vector<double> sums_;
};

}  // namespace heml
