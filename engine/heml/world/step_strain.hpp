#pragma once
// How much an explicit step deforms elements that may be deformed much in one: those next to contacts, which stop their
// nodes at once, and those far smaller than others, as cuts leave them, on which nodes of little mass swing. The stable
// step is that of the shape before the step; it says nothing of a shape that the step itself crushes.
//
//   e = ‖sym(dF F⁻¹)‖, dF: the change of F in the step     a turn by θ: 1.4 (1 − cos θ); turned inside out: 2 or more
//
// Where e is above max_step_strain, the step is taken again, half as long; later ones grow slowly.
#include <heml/mesh/tear.hpp>
#include <heml/world/model.hpp>

namespace heml {

/// Of the first 60 boxes of tests/bench/dropped_slivers.py 20 do not end without a limit, 4 with 0.3, none with 0.2.
inline constexpr double max_step_strain = 0.2;

/// Steps after one with this strain, until small elements may have one that is too large.
int steps_until_strain(double strain);

template <class Real>
class StepStrain {
 public:
  /// Takes over a body's elements, if the topology is another; of quadratic ones the eighths (mesh/quadratic.hpp).
  /// is_continued: whether laws go on through J = 0.
  void adopt(const Model<Real>& model, const Topology& topology, bool is_continued);
  /// The largest e between two positions (#V×3, m) among the elements at `nodes` and, with_small, the small ones.
  double largest(const std::vector<int>& nodes, bool with_small, const Real* before, const Real* after);

 private:
  long version_ = -1;  ///< of the topology
  std::vector<Tet> tets_;
  std::vector<int> small_;  ///< elements
  struct Least {
    double volume;       ///< six-fold, m³, that flatter elements count with
    double square_move;  ///< m², of a corner against another, below which e is small
  };
  std::vector<Least> least_;
  NodeToElements around_;
  std::vector<long> seen_;  ///< of each element, the last search that came upon it
  long searches_ = 0;
};

}  // namespace heml
