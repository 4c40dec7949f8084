#include <algorithm>
#include <cassert>
#include <cmath>
#include <heml/elastic/fan_state.hpp>
#include <heml/elastic/group_loops.hpp>
#include <heml/math/bytes.hpp>
#include <heml/math/symmetric3.hpp>

namespace heml {
namespace {

/// The edges of a fan's tetrahedron in those of the element, as columns, and the inverse; det = ±1.
struct FanEdges {
  double M[3][3], inverse[3][3];

  FanEdges(const std::array<std::uint8_t, 4>& corner, double foot0, double foot1) {
    double at[4][3] = {};  // p q r0 r1 in the edges
    for (std::size_t c = 0; c < 4; ++c)
      if (corner[c] > 0) at[c][corner[c] - 1] = 1;
    for (int i = 0; i < 3; ++i) {
      const double a = at[1][i] - at[0][i];
      M[i][0] = a;
      M[i][1] = at[2][i] - at[0][i] - foot0 * a;
      M[i][2] = at[3][i] - at[0][i] - foot1 * a;
    }
    double det = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        inverse[a][i] = M[j][b] * M[k][c] - M[j][c] * M[k][b];
      }
      det += M[i][0] * inverse[0][i];
    }
    for (auto& row : inverse)
      for (double& entry : row) entry /= det;
  }
};

/// Writes scale · N S Nᵀ, or with N transposed scale · Nᵀ S N; `from` and `to` have steps between their numbers.
template <class Real>
void map_symmetric(const double (&N)[3][3], bool transposed, double scale, const Real* from, std::size_t from_step,
                   Real* to, std::size_t to_step) {
  double S[6], out[6], Nt[3][3];
  for (std::size_t c = 0; c < 6; ++c) S[c] = static_cast<double>(from[c * from_step]);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) Nt[i][j] = N[j][i];
  congruence3(transposed ? Nt : N, S, out);
  for (std::size_t c = 0; c < 6; ++c) to[c * to_step] = static_cast<Real>(scale * out[c]);
}

constexpr std::size_t max_lanes = 16;

/// tr (A*⁻¹TA*⁻¹T) of the tensions T that are fixed during the step; numbers of a lane are `lanes` apart.
template <class Real>
Real square_of_fixed(const FanTerms<Real>& terms, const Real* shape, const Real* state, std::size_t lanes) {
  Real T[6] = {};
  for (std::size_t k = 0; k < terms.branch_count; ++k)
    for (std::size_t c = 0; c < 6; ++c)
      T[c] += terms.branches[k].decay * state[(6 * (k + 1) + c) * lanes] - terms.branches[k].gain * state[c * lanes];
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

using Nodes = std::array<int, 4>;

Nodes sorted(Nodes nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

}  // namespace

/// Calls visit(part, place, edges of the fan, first number of the state) for every element in a fan.
template <class Real>
template <class Visit>
void FanState<Real>::each_element(const FanLayout<Real>& layout, std::size_t lanes,
                                  const std::vector<FanTerms<Real>>& terms, const Visit& visit) const {
  for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
    const auto& block = layout.blocks[b];
    const FanTerms<Real>& of_part = terms[block.part];
    if (of_part.state == 0) continue;
    const Real* shape = &layout.shape[block.shape];
    const Place* place = &places_[place_start_[b]];
    std::size_t state = start_[b];
    for (std::size_t g = 0; g < block.groups; ++g) {
      const FanSize size = layout.size[block.group + g];
      for (std::size_t i = 0; i < size.tets; ++i, place += lanes, state += of_part.state * lanes)
        for (std::size_t l = 0; l < lanes; ++l) {
          if (place[l].slot < 0) continue;
          const std::size_t after = (i + 1) % size.ring;
          const FanEdges edges(place[l].corner, static_cast<double>(shape[i * lanes + l]),
                               static_cast<double>(shape[after * lanes + l]));
          visit(block.part, place[l], edges, state + l);
        }
      shape += (size.ring + size.tets * of_part.constants) * lanes;
    }
  }
}

/// Finds each tetrahedron of a fan among the elements of its block by its nodes.
template <class Real>
void FanState<Real>::find_places(const FanLayout<Real>& layout, std::size_t lanes,
                                 const std::vector<FanSlots<Real>>& slots) {
  struct Found {
    Nodes nodes;  ///< ascending
    std::size_t at;
    bool operator<(const Found& other) const { return nodes < other.nodes; }
  };
  std::vector<std::size_t> slot_of;
  for (const FanSlots<Real>& part : slots)
    for (std::size_t s = 0; s < part.group->size(); ++s) {
      const auto t = static_cast<std::size_t>(part.group->element[s]);
      if (t >= slot_of.size()) slot_of.resize(t + 1);
      slot_of[t] = s;
    }
  places_.clear(), place_start_.clear();
  std::vector<Found> elements, in_fans;
  std::vector<Nodes> order;  // p q r_i r_i+1 of in_fans[k].at
  for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
    const auto& block = layout.blocks[b];
    const NodeBlocks::Block& block_nodes = layout.nodes.blocks[b];
    const ElementGroup<Real>& group = *slots[block.part].group;
    place_start_.push_back(places_.size());
    elements.clear(), in_fans.clear(), order.clear();
    for (std::size_t k = 0; k < block.elements; ++k) {
      const std::size_t s = slot_of[static_cast<std::size_t>(layout.element[block.element + k])];
      elements.push_back({sorted({group.node[0][s], group.node[1][s], group.node[2][s], group.node[3][s]}), s});
    }
    const std::uint16_t* index = &layout.index[block.index];
    for (std::size_t g = 0; g < block.groups; ++g) {
      const FanSize size = layout.size[block.group + g];
      for (std::size_t i = 0; i < size.tets; ++i)
        for (std::size_t l = 0; l < lanes; ++l, places_.emplace_back()) {
          const std::size_t row[4] = {0, 1, 2 + i, 2 + (i + 1) % size.ring};
          Nodes nodes;
          bool is_dummy = false;
          for (std::size_t c = 0; c < 4; ++c) {
            const std::size_t local = index[row[c] * lanes + l] / std::size_t{8};
            is_dummy = is_dummy || local >= block_nodes.nodes;
            nodes[c] = is_dummy ? -1 : static_cast<int>(layout.nodes.place[block_nodes.place + local] / 3);
          }
          if (is_dummy) continue;
          in_fans.push_back({sorted(nodes), places_.size()});
          order.push_back(nodes);
        }
      index += (2 + size.ring) * lanes;
    }
    std::vector<std::size_t> of_place(in_fans.empty() ? 0 : in_fans.back().at - place_start_.back() + 1);
    for (std::size_t k = 0; k < in_fans.size(); ++k) of_place[in_fans[k].at - place_start_.back()] = k;
    std::stable_sort(elements.begin(), elements.end());
    std::stable_sort(in_fans.begin(), in_fans.end());
    assert(elements.size() == in_fans.size());
    for (std::size_t k = 0; k < elements.size(); ++k) {
      assert(elements[k].nodes == in_fans[k].nodes);
      Place& place = places_[in_fans[k].at];
      place.slot = static_cast<int>(elements[k].at);
      const Nodes& nodes = order[of_place[in_fans[k].at - place_start_.back()]];
      for (std::size_t c = 0; c < 4; ++c)
        for (std::uint8_t corner = 0; corner < 4; ++corner)
          if (group.node[corner][elements[k].at] == nodes[c]) place.corner[c] = corner;
    }
  }
}

template <class Real>
void FanState<Real>::read(const FanLayout<Real>& layout, std::size_t lanes, const std::vector<FanTerms<Real>>& terms,
                          const std::vector<FanSlots<Real>>& slots) {
  find_places(layout, lanes, slots);
  std::size_t size = 0;
  start_.clear();
  for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
    const std::size_t end = b + 1 < layout.blocks.size() ? place_start_[b + 1] : places_.size();
    start_.push_back(size);
    size += terms[layout.blocks[b].part].state * (end - place_start_[b]);
  }
  now_.assign(size, Real(0));
  each_element(layout, lanes, terms, [&](std::size_t p, const Place& place, const FanEdges& edges, std::size_t at) {
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
  each_element(layout, lanes, terms, [&](std::size_t p, const Place& place, const FanEdges& edges, std::size_t at) {
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
                           const std::vector<FanSlots<Real>>& slots) const {
  Real largest = 0;
  for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
    const auto& block = layout.blocks[b];
    const FanTerms<Real>& of_part = terms[block.part];
    if (of_part.branch_count == 0) continue;
    const ElementGroup<Real>& group = *slots[block.part].group;
    const Real* shape = &layout.shape[block.shape];
    const Real* state = now(b) + of_part.viscous_state * lanes;
    const Place* place = &places_[place_start_[b]];
    for (std::size_t g = 0; g < block.groups; ++g) {
      const FanSize size = layout.size[block.group + g];
      shape += size.ring * lanes;
      for (std::size_t i = 0; i < size.tets; ++i) {
        Real square[max_lanes];
        for (std::size_t l = 0; l < lanes; ++l) square[l] = square_of_fixed(of_part, shape + l, state + l, lanes);
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
  return bytes_of(now_, next_, start_, places_, place_start_);
}

template class FanState<float>;
template class FanState<double>;

}  // namespace heml
