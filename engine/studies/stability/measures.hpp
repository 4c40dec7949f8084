#pragma once
// What cases measure of worlds and bodies, and the materials they are made of.
#include <studies/stability/case.hpp>

namespace heml::stability {

/// A law with these moduli at rest, Pa. edge: m, of the mesh, for springs to be about as stiff.
Material material_of(std::string_view law, double shear, double bulk, double edge = 0.01);
/// The same from engineering constants, on all elements of a setup whose materials are of one law each.
void set_young_poisson(WorldSetup& setup, double young, double poisson);

double min_J(World& world);
int inverted(World& world);
double total(const Energies& energies);
double rms_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b);  ///< of equal length, m
double max_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b);
double diagonal(const TetMesh& mesh);  ///< m, of the bounding box at rest
/// Rms distance from the rest shape, turned and moved as fits best, over the diagonal.
double away_from_rest(const World& world);

/// Ticks until a time, s; at most so many integration steps. Returns whether it came there.
bool run_until(World& world, double time, long max_steps = 20'000'000);

/// The outcome of a run that has come to its end, or stopped on the way.
Outcome ended(World& world, double value, std::string note = {});
/// Of a run that stopped too early to measure anything.
Outcome stopped(World& world);

/// Uniform in [−1, 1], of a place in a sequence.
double noise(std::uint64_t seed, std::uint64_t place);

std::vector<double> flat(const std::vector<Vec3>& points);  ///< 3 #V

}  // namespace heml::stability
