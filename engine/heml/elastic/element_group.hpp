#pragma once
// The elements of one material in the layout of the force loops, and the map from their corners to the nodes.
//
//   slot s:      0 1 2 3 4 5 6 7 | 8 9 ...       elements of one material in locality order, padded to whole packets by
//   node[4]:     . . . . . . . . |               repeating the last one
//   A[6]:        . . . . . . . . |               A = Dm⁻¹Dm⁻ᵀ, A_ab = g_a·g_b, a, b = 1..3, as 11 22 33 12 13 23
//   volume:      . . . . . . . . |
//   fibre[3]:    . . . . . . . . |               m = Dm⁻¹a0 where the material gives a fibre, else empty
//   parameters:  . . . . . . . . |               material parameters that vary by element, else empty
//
//   corner forces: 12 numbers a slot, [slot][corner][xyz], written by the force loop,
//   summed at each node in ascending order of corner (CornerMap), so that sums do not depend on the threads.
#include <Eigen/Dense>
#include <heml/materials/material.hpp>
#include <heml/math/bytes.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <span>
#include <vector>

namespace heml {

template <class Real>
struct ElementGroup {
  static constexpr std::size_t lanes = 8;  ///< elements a packet

  std::vector<int> element;              ///< #S inner numbers of the elements, without padding
  std::array<std::vector<int>, 4> node;  ///< 4 × padded #S, inner numbers
  std::array<std::vector<Real>, 6> A;    ///< 6 × padded #S, 1/m²
  std::vector<Real> volume;              ///< padded #S, m³, of the rest shape
  std::array<std::vector<Real>, 3> fibre;     ///< 3 × padded #S, 1/m, or empty
  std::vector<std::vector<Real>> parameters;  ///< of each FieldParameter of the material, padded #S
  Real density = 1000;                        ///< kg/m³
  std::size_t first_corner = 0;  ///< of slot 0, in the body's list of corners: after those of the groups before

  std::size_t size() const { return element.size(); }
  std::size_t packets() const { return volume.size() / lanes; }
  std::size_t bytes() const { return bytes_of(element, node, A, volume, fibre, parameters); }
};

/// Builds the group of the given elements (inner numbers; at least one) of a mesh in inner order with positive volumes.
/// The mesh must have the fields that the material names (asserted). Rest shapes are those of its burns.
template <class Real>
ElementGroup<Real> make_group(const TetMesh& mesh, const std::vector<int>& elements, const Material& material);

/// Multiplies the lengths of a slot's rest shape.
template <class Real>
void scale_rest_shape(ElementGroup<Real>& group, std::size_t s, Real factor);

/// Reorders a list with `each` values per slot: slot s takes the values of the old slot from[s]. Internal state thus
/// stays with its element when others are removed.
template <class Value>
void gather_slots(std::vector<Value>& of_slots, std::span<const std::size_t> from, std::size_t each = 1) {
  std::vector<Value> taken;
  taken.reserve(each * from.size());
  for (const std::size_t s : from) {
    const auto first = of_slots.begin() + static_cast<std::ptrdiff_t>(each * s);
    taken.insert(taken.end(), first, first + static_cast<std::ptrdiff_t>(each));
  }
  of_slots = std::move(taken);
}

/// Keeps the given slots of a group, in that order; at least one. Returns `from` for gather_slots() on further padded
/// lists.
template <class Real>
std::vector<std::size_t> keep_slots(ElementGroup<Real>& group, const std::vector<std::size_t>& slots);

/// Which corners meet at each node: corners[start[n] .. start[n+1]), ascending.
struct CornerMap {
  std::vector<std::size_t> start;    ///< #V+1
  std::vector<std::size_t> corners;  ///< 4 #T
  bool operator==(const CornerMap&) const = default;
};

/// Lists the corners of each node, by the first_corner of the groups.
template <class Real>
CornerMap map_corners(const std::vector<const ElementGroup<Real>*>& groups, std::size_t nodes);

}  // namespace heml
