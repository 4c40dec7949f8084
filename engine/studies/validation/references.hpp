#pragma once
// Reference solutions: closed forms and ordinary integrals, computed without the engine's laws, elements and solvers.
#include <array>
#include <functional>
#include <vector>

namespace heml::validation {

/// W = μ/2 (Ī1 − 3) + κ/2 (J − 1)², Pa.
struct Rubber {
  double shear, bulk;
};

/// A thick wall between radii `inner` and `outer`, free outside, under pressure inside: a sphere, or a cylinder in
/// plane strain. The equation of balance dP_r/dR + k (P_r − P_θ)/R = 0, k = 2 or 1, is integrated from the outer wall
/// inwards (Runge-Kutta, fourth order).
struct ThickWall {
  Rubber material;
  double inner, outer;  ///< m, at rest
  int directions;       ///< k: that are stretched by r/R: 2 of a sphere, 1 of a cylinder
};
struct RadialState {
  double pressure;                               ///< Pa, on the deformed inner wall
  double inner, outer;                           ///< m, deformed radii
  std::vector<std::array<double, 2>> profile{};  ///< (R, r − R), m, from outside inwards
};
/// The state whose deformed outer radius is given.
RadialState radial_state(const ThickWall& wall, double deformed_outer, int steps = 1000);
/// The state under a pressure, by bisection to round-off. Throws std::domain_error if there is none up to twice the
/// outer radius: beyond a highest pressure a wall goes on to inflate.
RadialState radial_state_under(const ThickWall& wall, double pressure);
/// The closed form of an incompressible sphere of W = μ/2 (I1 − 3), given its deformed inner radius.
double incompressible_sphere_pressure(double shear, double inner, double outer, double deformed_inner);

/// An inextensible cantilever without shear under a dead load F across its end: EI θ'' = −F cos θ. Place of the end
/// over the length, along and across the beam at rest.
struct Elastica {
  double along, across;
  std::vector<std::array<double, 2>> shape{};  ///< places along the beam, over the length
};
Elastica elastica_of(double load);  ///< load: F L² / (E I)

/// The root of a continuous function between two places where it has different signs.
double root(const std::function<double(double)>& f, double low, double high);

}  // namespace heml::validation
