#include <algorithm>
#include <cmath>
#include <heml/elastic/deviator_square.hpp>
#include <heml/elastic/fan_flow.hpp>
#include <heml/elastic/fan_state.hpp>
#include <heml/elastic/group_loops.hpp>
#include <heml/math/bytes.hpp>
#include <heml/math/symmetric3.hpp>

namespace heml {
namespace {

constexpr std::size_t max_lanes = 16;

/// The tensions that are fixed during the step; numbers of a lane are `lanes` apart.
template <class Real>
void put_fixed(const FanTerms<Real>& terms, const Real* state, std::size_t lanes, Real T[6]) {
  std::fill_n(T, 6, Real(0));
  for (std::size_t k = 0; k < terms.branch_count; ++k)
    for (std::size_t c = 0; c < 6; ++c)
      T[c] += terms.branches[k].decay * state[(6 * (k + 1) + c) * lanes] - terms.branches[k].gain * state[c * lanes];
}

/// tr (A*⁻¹TA*⁻¹T) of the fixed tensions T. A: of FanFlow::shape().
template <class Real>
Real square_of_flowed(const FanTerms<Real>& terms, const Real* A, const Real* state, std::size_t lanes) {
  Real T[6], of_lane[6], inverse[6], W[3][3];
  put_fixed(terms, state, lanes, T);
  for (std::size_t c = 0; c < 6; ++c) of_lane[c] = A[c * lanes];
  inverse3(of_lane, inverse);
  product3(inverse, T, W);
  return trace_of_square(W);
}

/// The same of a rest shape that has not flowed.
template <class Real>
Real square_of_fixed(const FanTerms<Real>& terms, const Real* shape, const Real* state, std::size_t lanes) {
  Real T[6];
  put_fixed(terms, state, lanes, T);
  Real p = shape[0], q00 = shape[lanes], q11 = shape[2 * lanes], q01 = shape[3 * lanes];
  if (terms.is_principal) {  // of the Cholesky factor
    q11 = q01 * q01 + q11 * q11, q01 *= q00, q00 *= q00, p *= p;
  }
  const Real det = 1 / (q00 * q11 - q01 * q01), i00 = q11 * det, i11 = q00 * det, i01 = -q01 * det, ip = 1 / p;
  const Real w00 = i00 * T[1] + i01 * T[5], w01 = i00 * T[5] + i01 * T[2];
  const Real w10 = i01 * T[1] + i11 * T[5], w11 = i01 * T[5] + i11 * T[2];
  const Real coupling = T[3] * (i00 * T[3] + i01 * T[4]) + T[4] * (i01 * T[3] + i11 * T[4]);
  return ip * T[0] * ip * T[0] + 2 * ip * coupling + w00 * w00 + w11 * w11 + 2 * w01 * w10;
}

}  // namespace

/// Calls visit(part, place, edges of the fan, first number of the state) for every element in a fan.
template <class Real>
template <class Visit>
void FanState<Real>::each_element(const FanLayout<Real>& layout, std::size_t lanes,
                                  const std::vector<FanTerms<Real>>& terms, const Visit& visit) const {
  for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
    const std::size_t part = layout.blocks[b].part, state = terms[part].state;
    if (state == 0) continue;
    for (std::size_t k = 0; k < places_.count(b); ++k) {
      const FanPlace& place = places_.list[places_.first(b) + k];
      if (place.slot >= 0)
        visit(part, place, edges_at(layout, place), start_[b] + state * (k / lanes * lanes) + k % lanes);
    }
  }
}

template <class Real>
void FanState<Real>::read(const FanLayout<Real>& layout, std::size_t lanes, const std::vector<FanTerms<Real>>& terms,
                          const std::vector<FanSlots<Real>>& slots) {
  places_ = find_places(layout, lanes, terms, groups_of(slots));
  std::size_t size = 0;
  start_.clear();
  for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
    start_.push_back(size);
    size += terms[layout.blocks[b].part].state * places_.count(b);
  }
  now_.assign(size, Real(0));
  each_element(layout, lanes, terms, [&](std::size_t p, const FanPlace& place, const FanEdges& edges, std::size_t at) {
    const Real* values = slots[p].values->data() + slots[p].each * static_cast<std::size_t>(place.slot);
    const std::size_t viscous = terms[p].viscous_state;
    if (viscous > 0) map_symmetric(edges.M, true, 1, values, 1, &now_[at], lanes);
    for (std::size_t k = viscous; k < terms[p].state; k += 6)
      map_symmetric(edges.inverse, false, -1, values + 6 + k - viscous, 1, &now_[at + k * lanes], lanes);
  });
  is_known_ = true;
}

template <class Real>
void FanState<Real>::write(const FanLayout<Real>& layout, std::size_t lanes, const std::vector<FanTerms<Real>>& terms,
                           const std::vector<FanSlots<Real>>& slots) const {
  each_element(layout, lanes, terms, [&](std::size_t p, const FanPlace& place, const FanEdges& edges, std::size_t at) {
    Real* values = slots[p].values->data() + slots[p].each * static_cast<std::size_t>(place.slot);
    const std::size_t viscous = terms[p].viscous_state;
    if (viscous > 0) map_symmetric(edges.inverse, true, 1, &now_[at], lanes, values, 1);
    for (std::size_t k = viscous; k < terms[p].state; k += 6)
      map_symmetric(edges.M, false, -1, &now_[at + k * lanes], lanes, values + 6 + k - viscous, 1);
  });
  for (const FanSlots<Real>& part : slots) {
    if (!part.values) continue;
    const auto last = part.values->begin() + static_cast<std::ptrdiff_t>(part.each * (part.group->size() - 1));
    for (std::size_t s = part.group->size(); s < part.group->volume.size(); ++s)  // padding repeats the last slot
      std::copy_n(last, part.each, part.values->begin() + static_cast<std::ptrdiff_t>(part.each * s));
  }
}

/// |S|² = tr (A⁻¹TA⁻¹T) / V² = 36 tr (A*⁻¹TA*⁻¹T).
template <class Real>
Real FanState<Real>::bound(const FanLayout<Real>& layout, std::size_t lanes, const std::vector<FanTerms<Real>>& terms,
                           const std::vector<FanSlots<Real>>& slots, const FanFlow<Real>& flow) const {
  Real largest = 0;
  for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
    const auto& block = layout.blocks[b];
    const FanTerms<Real>& of_part = terms[block.part];
    if (of_part.branch_count == 0) continue;
    const ElementGroup<Real>& group = *slots[block.part].group;
    const Real* shape = &layout.shape[block.shape];
    const Real* state = now(b) + of_part.viscous_state * lanes;
    const Real* flowed = of_part.flows ? flow.shape(b) : nullptr;
    const FanPlace* place = &places_.list[places_.first(b)];
    for (std::size_t g = 0; g < block.groups; ++g) {
      const FanSize size = layout.size[block.group + g];
      shape += size.ring * lanes;
      for (std::size_t i = 0; i < size.tets; ++i) {
        Real square[max_lanes];
        for (std::size_t l = 0; l < lanes; ++l)
          square[l] = flowed ? square_of_flowed(of_part, flowed + l, state + l, lanes)
                             : square_of_fixed(of_part, shape + l, state + l, lanes);
        if (flowed) flowed += fan_flow_numbers * lanes;
        for (std::size_t l = 0; l < lanes; ++l) {
          if (place[l].slot < 0) continue;
          const auto rest = rest_shape(group, static_cast<std::size_t>(place[l].slot));
          const Real gamma = max_gradient(rest.A, CornerWeights<Real>{});
          const Real bound = 24 / group.density * std::sqrt(square[l]) * gamma;
          largest = bound > largest || std::isnan(bound) ? bound : largest;
        }
        shape += of_part.constants * lanes, state += of_part.state * lanes, place += lanes;
      }
    }
  }
  return largest;
}

template <class Real>
std::size_t FanState<Real>::bytes() const {
  return bytes_of(now_, next_, start_, places_.list, places_.start);
}

template class FanState<float>;
template class FanState<double>;

}  // namespace heml
