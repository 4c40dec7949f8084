#pragma once
// Measures and materials shared by the cases.
#include <studies/stability/case.hpp>

namespace heml::stability {

/// A material with given small-strain moduli, Pa. edge: m, mean edge of the mesh, for springs of similar stiffness.
Material material_of(std::string_view law, double shear, double bulk, double edge = 0.01);
/// Sets the moduli of all materials of a setup from Young's modulus (Pa) and Poisson's ratio.
void set_young_poisson(WorldSetup& setup, double young, double poisson);

double min_J(World& world);
int inverted(World& world);
double total(const Energies& energies);
/// Energies of a world that has ticked, with velocities of the same time as positions. Those of symplectic Euler lag by
/// half a step: its positions are leapfrog's, and its velocities leapfrog's at the middle of the step. What it takes
/// from leapfrog's energy by that is of first order in the step and comes back; it is no drift.
Energies synchronous_energies(World& world);
double rms_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b);  ///< of equal size, m
double max_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b);
double diagonal(const TetMesh& mesh);  ///< of the bounding box at rest, m
/// Rms distance from the rest shape after the best rigid fit, over the diagonal.
double away_from_rest(const World& world);

/// Ticks until a time, s, with at most max_steps integration steps. Returns whether the time was reached.
bool run_until(World& world, double time, long max_steps = 20'000'000);

/// A world of the setup under its whole load (static) or at the end of its duration.
std::unique_ptr<World> run_to_end(const Trial& trial, const WorldSetup& setup);
/// Sets the tolerance of implicit and static solves: `tolerance` in double, 1e-4 in float.
void set_tolerance(WorldSetup& setup, double tolerance);

/// The outcome of a run that reached its end, or of a halted one.
Outcome ended(World& world, double value, std::string note = {});
/// The outcome of a run that stopped too early to measure.
Outcome stopped(World& world);

/// Number `place` of a deterministic sequence, uniform in [−1, 1].
double noise(std::uint64_t seed, std::uint64_t place);

std::vector<double> flat(const std::vector<Vec3>& points);  ///< 3 #V

}  // namespace heml::stability
