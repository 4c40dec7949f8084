#pragma once
// Rest shapes of elements that flow (plastic_flow.hpp), in the order of the kernels of fans, and which of these
// elements an evaluation of forces found beyond yield:
//
//   shape:    [group][tetrahedron][A* (6), limit][lane]
//   beyond:   [group][tetrahedron][lane]                 1 or 0
//
// A* = 6V A as in fan_block.hpp, but with all entries, aa 00 11 a0 a1 01, since flow couples axis and ring. limit: 1/54
// of the square of the least von Mises stress at which the element may flow, Pa². The group of the elements has the
// same A by slot; who changes it there calls put().
#include <heml/elastic/fan_places.hpp>
#include <heml/elastic/fan_state.hpp>

namespace heml {

template <class Real>
class FanFlow {
 public:
  bool is_known() const { return is_known_; }
  void forget() { *this = {}; }

  /// Copies the rest shapes of all elements of the parts that flow. Arguments as of FanState::read().
  void read(const FanLayout<Real>& layout, std::size_t lanes, const std::vector<FanTerms<Real>>& terms,
            const std::vector<FanSlots<Real>>& slots);
  /// Copies those of some slots of a part.
  void put(const FanLayout<Real>& layout, std::size_t lanes, std::size_t part, const FanSlots<Real>& of_part,
           std::span<const std::size_t> slots);
  /// The slots of a part that the last evaluation found beyond yield, ascending.
  std::vector<std::size_t> beyond(const FanLayout<Real>& layout, std::size_t part) const;

  // Of a block of elements that flow, as its kernel reads and writes them.
  const Real* shape(std::size_t block) const { return shape_.data() + fan_flow_numbers * start_[block]; }
  Real* beyond_of(std::size_t block) { return beyond_.data() + start_[block]; }

  std::size_t bytes() const;

 private:
  void put(const FanLayout<Real>& layout, std::size_t lanes, const FanSlots<Real>& of_part, std::size_t place,
           std::size_t number);

  bool is_known_ = false;
  std::vector<Real, CacheAligned<Real>> shape_, beyond_;
  FanPlaces places_;
  std::vector<std::size_t> start_;  ///< of each block in beyond_
  struct SlotPlace {
    std::size_t place, number;  ///< in places_.list and in beyond_
  };
  std::vector<std::vector<SlotPlace>> place_of_slot_;  ///< of each part
};

}  // namespace heml
