#pragma once
// Masses of a body's nodes, inner order.
#include <cstddef>
#include <heml/math/bytes.hpp>
#include <vector>

namespace heml {

template <class Real>
struct NodeMasses {
  std::vector<Real> lumped;           ///< #V, kg
  std::vector<Real> consistent;       ///< #V, kg, which gravity acts on; empty: lumped
  std::vector<Real> inverse;          ///< #V, 1/kg, of lumped; 0 for nodes held in all directions and of no element
  std::vector<Real> inverse_per_dof;  ///< 3 #V, 1/kg; 0 for each coordinate that is held
  std::vector<Real> heavy_per_dof;    ///< 3 #V, kg, heavy() for each coordinate

  std::size_t bytes() const { return bytes_of(lumped, consistent, inverse, inverse_per_dof, heavy_per_dof); }
  bool operator==(const NodeMasses&) const = default;
  /// What gravity acts on, #V, kg.
  const std::vector<Real>& heavy() const { return consistent.empty() ? lumped : consistent; }
};

}  // namespace heml
