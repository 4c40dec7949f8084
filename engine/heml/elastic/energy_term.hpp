#pragma once
// Laws by expression (materials/energy_law.hpp) as a term of a group's energy. Loops run each operation on a pack of
// elements.
#include <heml/elastic/group_term.hpp>

namespace heml {

/// Requires that the material's law is an EnergyLaw whose parameters material_problem() accepts.
template <class Real>
std::unique_ptr<GroupTerm<Real>> make_energy_term(const Material& material);

/// Whether kernels of fans and points run the law: all do but expressions of stretches.
bool has_kernel(const Material& material);

}  // namespace heml
