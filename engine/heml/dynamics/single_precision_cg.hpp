#pragma once
// K d = r by preconditioned conjugate gradients in float, on the assembled K: enough for Newton iterations, which need
// two to four digits of the linear solution. Positions, residuals and Φ stay in double.
#include <heml/dynamics/low_rank_update.hpp>

namespace heml {

/// The smallest tolerance that float reaches for bodies of any shape.
inline constexpr double min_float_tolerance = 1e-4;

class SinglePrecisionCG {
 public:
  /// matrix: of the free nodes. free and team must outlive this.
  SinglePrecisionCG(const FreeNodes& free, BsrMatrix matrix, ThreadTeam& team);

  /// To be called when the mesh has lost elements: those left, by their old numbers (ascending).
  void keep_elements(const std::vector<int>& elements) { K_.keep_elements(elements); }
  const BsrMatrix& matrix() const { return K_; }

  /// Assembles K from the last linearise() of the objective, plus shift (N/m) on its diagonal. Returns false if the
  /// objective does not provide K in float.
  bool assemble(Objective& objective, double shift);

  /// Solves K d = r (3 #V; d = 0 at nodes that are not free) to a residual of tolerance ‖r‖. Returns whether all
  /// curvature met was positive; if not, d is the iterate before, or the first direction. Adds the number of iterations
  /// to `iterations`.
  bool solve(SmoothedAggregation& preconditioner, LowRankUpdate& update, const Vector& r, double tolerance,
             int max_iterations, Vector& d, long& iterations);

  std::size_t bytes() const { return K_.bytes() + finest_.bytes() + bytes_of(d_, left_, p_, q_, z_) + bytes_of(sums_); }

 private:
  template <class Part>
  double sum(const Part& part);
  double dot(const MultiVector& a, const MultiVector& b);

  const FreeNodes& free_;
  ThreadTeam& team_;
  BsrMatrix K_;
  BlockJacobi finest_;
  MultiVector d_, left_, p_, q_, z_;
  std::vector<double> sums_;
  std::vector<int> held_rows_;  ///< 3 row + axis of held coordinates
};

}  // namespace heml
