#pragma once
// Products with the stiffness of many elements (edge_stiffness.hpp). No law is in them: one loop serves all.
#include <heml/elastic/edge_stiffness.hpp>
#include <heml/elastic/element_group.hpp>

namespace heml {

/// Corner forces −K dx of packets [begin, end) of a group with a change dx of the positions (3 #V), into corner (3 a
/// corner), overwritten. K: [packet][45][lanes].
template <class Real>
void multiply_stiffness(const Real* K, const ElementGroup<Real>& group, const Real* dx, std::size_t begin,
                        std::size_t end, Real* corner);

}  // namespace heml
