#pragma once
// Where the elements of a body are in its fans, for what is kept of each element in the order of their kernels: state
// (fan_state.hpp), and rest shapes that flow (fan_flow.hpp).
//
// With e1, e2, e3 the edges of an element and M the edges a, b0, b1 of its fan in them, G in a fan is MᵀGM; tensions
// and A, which are dual to it, are M⁻¹TM⁻ᵀ.
#include <heml/elastic/element_group.hpp>
#include <heml/elastic/fan_layout.hpp>
#include <heml/elastic/fan_terms.hpp>

namespace heml {

/// An element in a fan.
struct FanPlace {
  int slot = -1;                            ///< of its part; −1 in a lane without a fan
  std::array<std::uint8_t, 4> corner = {};  ///< which of its corners are p, q, r_i, r_i+1
  std::uint32_t first_foot = 0, foot = 0;   ///< where φ_i and φ_i+1 are in FanLayout::shape
};

struct FanPlaces {
  std::vector<FanPlace> list;      ///< [block][group][tetrahedron][lane]
  std::vector<std::size_t> start;  ///< of each block in list, and the end

  std::size_t first(std::size_t block) const { return start[block]; }
  std::size_t count(std::size_t block) const { return start[block + 1] - start[block]; }
};

/// lanes: of the kernels; terms, groups: of each part of the layout.
template <class Real>
FanPlaces find_places(const FanLayout<Real>& layout, std::size_t lanes, const std::vector<FanTerms<Real>>& terms,
                      const std::vector<const ElementGroup<Real>*>& groups);

/// The edges of a fan's tetrahedron in those of the element, as columns of M, and the inverse; det = ±1.
struct FanEdges {
  double M[3][3], inverse[3][3];
  FanEdges(const std::array<std::uint8_t, 4>& corner, double first_foot, double foot);
};

template <class Real>
FanEdges edges_at(const FanLayout<Real>& layout, const FanPlace& place) {
  return {place.corner, static_cast<double>(layout.shape[place.first_foot]),
          static_cast<double>(layout.shape[place.foot])};
}

/// Writes scale · N S Nᵀ, or with N transposed scale · Nᵀ S N; `from` and `to` have steps between their numbers.
template <class Real>
void map_symmetric(const double (&N)[3][3], bool transposed, double scale, const Real* from, std::size_t from_step,
                   Real* to, std::size_t to_step);

}  // namespace heml
