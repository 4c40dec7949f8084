#pragma once
// Closed-form sag of a beam under its own weight, for comparison with static solves.
namespace heml {

/// Sag of the tip of a cantilever of rectangular section clamped at one end, m: bending and shear of Timoshenko's
/// theory, ρ g h b L⁴/(8 E I) + ρ g L²/(2 k G), with Cowper's shear coefficient k = 10(1+ν)/(12+11ν) (Journal of
/// Applied Mechanics 33, 1966). Valid for sags much smaller than the length.
struct Cantilever {
  double length, depth;  ///< m; depth is along gravity
  double young, poisson, density, gravity;
  double sag() const {
    const double weight = density * gravity, shear = young / (2 * (1 + poisson));
    const double k = 10 * (1 + poisson) / (12 + 11 * poisson);
    return 12 * weight * length * length * length * length / (8 * young * depth * depth) +
           weight * length * length / (2 * k * shear);
  }
};

}  // namespace heml
