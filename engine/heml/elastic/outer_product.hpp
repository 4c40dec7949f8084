#pragma once
// A part of the stiffness of a quadratic element that couples all of its nodes.

namespace heml {

/// k g gᵀ; g: of the ten nodes, which sums to zero over them.
template <class Real>
struct OuterProduct {
  Real k;
  Real g[30];
};

}  // namespace heml
