#pragma once
// The method with which a body is in real time with the least error, by a fixed model of cost that reads no clock:
// explicit steps, at a rate that fits their stable length, where they are fast enough; else backward Euler at the
// highest rate, up to 60 Hz, at which one iteration fits, and as many iterations as fit. Many short steps err less than
// few exact ones.
//
//   explicit load = rate × steps a tick × seconds a step                     of one core; at most 0.35
//   implicit load = rate × iterations × tetrahedra × seconds a tetrahedron   of one core; at most 0.7
//
// The iterations of each linear solve are bounded too (Budget::linear), so slivers do not decide the cost.
#include <heml/world/setup.hpp>
#include <span>

namespace heml {

struct SuitableMethod {
  Integrator integrator = Integrator::verlet;
  double rate = 1000;            ///< Hz
  std::optional<Budget> budget;  ///< of implicit steps
  double load = 0;               ///< computing time on one core over simulated time
};

/// What explicit steps of a body cost.
struct ExplicitCost {
  double seconds = 0;  ///< of a step on one core
  double stable = 0;   ///< s, the longest step
};

/// quadratic: of quadratic elements.
SuitableMethod suitable_method(std::size_t tets, const ExplicitCost& cost, bool quadratic = false);

/// Of a Newton iteration of backward Euler within suitable_method()'s budget, s on one core.
double seconds_per_iteration(std::size_t tets, bool quadratic = false);

/// Whether an iteration of so many quadratic elements fits a step at the highest rate. They then err several times
/// less than linear ones on the same mesh, by more than longer or less exact steps cost.
bool affords_quadratic(std::size_t tets);

/// The implicit method for a body whose iterations take this long. seconds: of an iteration on what computes it.
SuitableMethod suitable_implicit_method(double seconds_per_iteration);

/// Backward Euler's rates, Hz, highest first.
std::span<const double> implicit_rates();

/// The rate that suits an integrator where none is known to be better, Hz.
double usual_rate(Integrator integrator);

/// Share of its amplitude that an oscillation loses in a period by backward Euler alone. frequency, rate: Hz.
double lost_in_a_period(double frequency, double rate);

void adopt(const SuitableMethod& method, SolverSettings& solver);

}  // namespace heml
