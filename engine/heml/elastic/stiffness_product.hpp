#pragma once
// Products with the stiffness of many elements (edge_stiffness.hpp); one loop serves all laws.
#include <heml/elastic/edge_stiffness.hpp>
#include <heml/elastic/element_group.hpp>

namespace heml {

/// Writes the corner forces −K dx (N) of packets [begin, end) into corner (3 a corner, overwritten). dx: change of the
/// positions, 3 #V, m. K: [packet][45][lanes].
template <class Real>
void multiply_stiffness(const Real* K, const ElementGroup<Real>& group, const Real* dx, std::size_t begin,
                        std::size_t end, Real* corner);

}  // namespace heml
