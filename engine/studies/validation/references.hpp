#pragma once
// Reference solutions: closed forms and ordinary integrals, computed without the engine's laws, elements and solvers.
#include <array>
#include <functional>
#include <utility>
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

/// A branch of relaxation: G(t)/G∞ = 1 + Σ strength exp(−t/time).
struct Branch {
  double strength, time;  ///< –, s
};
/// Shear stress of a linear solid with branches, while the strain changes linearly piece by piece: exact for each.
class LinearSolid {
 public:
  LinearSolid(double shear, std::vector<Branch> branches)
      : shear_(shear), branches_(std::move(branches)), stresses_(branches_.size(), 0.0) {}
  double stress_after(double strain_change, double seconds);  ///< Pa

 private:
  double shear_;  ///< Pa, at last
  std::vector<Branch> branches_;
  std::vector<double> stresses_;  ///< Pa, of the branches
  double strain_ = 0;
};
/// Strain along a constant stress applied at once, of a linear solid with one branch of relaxation in shear and an
/// elastic bulk: σ J(t)/3 + σ/9κ, with the compliance J(t) = (1 − γ/(1+γ) exp(−t/(τ (1+γ))))/G∞.
double creep_strain(double stress, const Rubber& at_last, const Branch& branch, double time);

/// Shear stress of a von Mises solid with linear isotropic hardening, small strains: exact for each change of strain.
class PlasticShear {
 public:
  PlasticShear(double shear, double yield, double hardening) : shear_(shear), yield_(yield), hardening_(hardening) {}
  double stress_after(double strain_change);     ///< Pa
  double plastic_work() const { return work_; }  ///< J/m³

 private:
  double shear_, yield_, hardening_;  ///< Pa; yield and hardening of the von Mises stress, √3 times that in shear
  double stress_ = 0, equivalent_ = 0, work_ = 0;
};

/// The root of a continuous function between two places where it has different signs.
double root(const std::function<double(double)>& f, double low, double high);

}  // namespace heml::validation
