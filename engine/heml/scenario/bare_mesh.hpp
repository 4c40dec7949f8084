#pragma once
// What a bare mesh or surface lacks to be a scene, chosen in this order; scene_around() (scene.hpp) puts it together.
// The first three can be given instead (bare_mesh_options.hpp).
//
//   unit      by its length                                    body_shape.hpp
//   up        y, or z where the body has a flat base there
//   supports  the underside, or the top where it would topple
//   element   quadratic (p2) where its implicit step fits 60 Hz, else linear (p1)
//   tissue    10 kPa, stiffer where it stretches by more than 1.5 under its weight: a trial run
//   method    explicit, or backward Euler within a budget: a model of cost, no clock (suitable_method.hpp)
//
// Nodes and elements stay as they are.
#include <heml/scenario/scene.hpp>
#include <heml/scenario/suitable_method.hpp>

namespace heml {

/// Young's moduli that are tried, Pa, softest first.
std::span<const double> tissue_moduli();

/// What a trial run found: backward Euler with very long steps, which come to the equilibrium under gravity
/// that leans a little.
struct TrialRun {
  double stretch = 0;  ///< largest principal stretch, means at nodes; infinite: the body did not hold
  ExplicitCost cost;   ///< by the cost model, at rest or under the weight, whichever allows the shorter step
};
TrialRun try_tissue(const WorldSetup& setup);

}  // namespace heml
