#pragma once
// Proofs that a problem of Saint Venant-Kirchhoff or of springs has no solution where a run of it ends. Both laws
// soften without end when pressed, so that a body of them has loads without equilibrium and shapes without stable
// motion.
#include <heml/world/world.hpp>
#include <string>

namespace heml::stability {

/// The proof for a world that stopped or ended with inverted elements: a limit point that its static solver has found,
/// or elements that are not inverted and have lost ellipticity (materials/ellipticity.hpp). Empty: none, or another
/// law.
std::string proof_of_no_solution(World& world);

}  // namespace heml::stability
