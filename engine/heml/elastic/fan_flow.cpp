#include <algorithm>
#include <cassert>
#include <heml/elastic/fan_flow.hpp>
#include <heml/elastic/plastic_flow.hpp>
#include <heml/math/bytes.hpp>
#include <limits>

namespace heml {
namespace {

constexpr double of_mises = 1.0 / 54;  // mises_measure() in fan_flow_tensions.hpp

/// Without an early end, which would keep the loop from being vectorised.
template <class Real>
bool is_any_set(const Real* values, std::size_t count) {
  using Word = std::conditional_t<sizeof(Real) == 4, std::int32_t, std::int64_t>;
  Word any = 0;
  for (std::size_t i = 0; i < count; ++i) any |= values[i] != Real(0) ? Word(1) : Word(0);
  return any != 0;
}

}  // namespace

template <class Real>
void FanFlow<Real>::put(const FanLayout<Real>& layout, std::size_t lanes, const FanSlots<Real>& of_part,
                        std::size_t place, std::size_t number) {
  const ElementGroup<Real>& group = *of_part.group;
  const FanPlace& at = places_.list[place];
  const auto s = static_cast<std::size_t>(at.slot);
  Real* to = &shape_[fan_flow_numbers * (number / lanes * lanes) + number % lanes];
  Real A[6];
  for (std::size_t i = 0; i < 6; ++i) A[i] = group.A[i][s];
  map_symmetric(edges_at(layout, at).inverse, false, 6 * static_cast<double>(group.volume[s]), A, 1, to, lanes);
  const Real least = of_part.flow->least_stress_of_flow(s);
  to[6 * lanes] = static_cast<Real>(of_mises) * least * least;
}

template <class Real>
void FanFlow<Real>::read(const FanLayout<Real>& layout, std::size_t lanes, const std::vector<FanTerms<Real>>& terms,
                         const std::vector<FanSlots<Real>>& slots) {
  places_ = find_places(layout, lanes, terms, groups_of(slots));
  start_.clear();
  std::size_t size = 0;
  for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
    start_.push_back(size);
    if (terms[layout.blocks[b].part].flows) size += places_.count(b);
  }
  beyond_.assign(size, Real(0));
  shape_.assign(fan_flow_numbers * size, Real(0));
  place_of_slot_.assign(slots.size(), {});
  for (std::size_t p = 0; p < slots.size(); ++p)
    if (terms[p].flows) place_of_slot_[p].resize(slots[p].group->size());
  for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
    const std::size_t part = layout.blocks[b].part;
    if (!terms[part].flows) continue;
    for (std::size_t k = 0; k < places_.count(b); ++k) {
      const std::size_t place = places_.first(b) + k, number = start_[b] + k;
      if (places_.list[place].slot >= 0) {
        place_of_slot_[part][static_cast<std::size_t>(places_.list[place].slot)] = {place, number};
        put(layout, lanes, slots[part], place, number);
        continue;
      }
      Real* to = &shape_[fan_flow_numbers * (number / lanes * lanes) + number % lanes];  // a right-angled corner
      for (std::size_t i = 0; i < 3; ++i) to[i * lanes] = 1;
      to[6 * lanes] = std::numeric_limits<Real>::infinity();
    }
  }
  is_known_ = true;
}

template <class Real>
void FanFlow<Real>::put(const FanLayout<Real>& layout, std::size_t lanes, std::size_t part,
                        const FanSlots<Real>& of_part, std::span<const std::size_t> slots) {
  assert(is_known_);
  for (const std::size_t s : slots) {
    if (s >= of_part.group->size()) continue;  // padding
    const SlotPlace& at = place_of_slot_[part][s];
    put(layout, lanes, of_part, at.place, at.number);
  }
}

template <class Real>
std::vector<std::size_t> FanFlow<Real>::beyond(const FanLayout<Real>& layout, std::size_t part) const {
  std::vector<std::size_t> slots;
  for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
    if (layout.blocks[b].part != part) continue;
    const Real* of_block = beyond_.data() + start_[b];
    if (!is_any_set(of_block, places_.count(b))) continue;
    for (std::size_t k = 0; k < places_.count(b); ++k) {
      const int slot = places_.list[places_.first(b) + k].slot;
      if (of_block[k] != Real(0) && slot >= 0) slots.push_back(static_cast<std::size_t>(slot));
    }
  }
  std::sort(slots.begin(), slots.end());
  return slots;
}

template <class Real>
std::size_t FanFlow<Real>::bytes() const {
  std::size_t sum = bytes_of(shape_, beyond_, places_.list, places_.start, start_);
  for (const auto& part : place_of_slot_) sum += bytes_of(part);
  return sum;
}

template class FanFlow<float>;
template class FanFlow<double>;

}  // namespace heml
