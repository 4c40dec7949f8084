#pragma once
// Static worlds: equilibrium at every fraction of the load (dynamics/static_solve.hpp).
#include <heml/world/simulation.hpp>

namespace heml {

template <class Real>
class StaticStepper {
 public:
  explicit StaticStepper(Simulation<Real>& s) : s_(s) {}

  /// Loads on to a fraction of all motions, loads and gravity, 0 to 1, in increments of its own choice. Returns why
  /// there is no equilibrium beyond the load reached.
  std::optional<StopReason> load_to(double fraction);

 private:
  Vector rest_positions() const;
  StopReason why_not_beyond(const StaticSolve& equilibrium) const;
  int first_flat(const std::vector<Real>& x) const;

  Simulation<Real>& s_;
};

}  // namespace heml
