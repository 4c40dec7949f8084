#include <algorithm>
#include <cassert>
#include <heml/elastic/fan_places.hpp>
#include <heml/math/symmetric3.hpp>

namespace heml {
namespace {

using Nodes = std::array<int, 4>;

Nodes sorted(Nodes nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// Tetrahedra of a block by their nodes.
struct Found {
  Nodes nodes;  ///< ascending
  std::size_t at;
  bool operator<(const Found& other) const { return nodes < other.nodes; }
};

/// Adds the places of a block, without slots, and the nodes p q r_i r_i+1 of those that have a fan.
template <class Real>
void add_places(const FanLayout<Real>& layout, std::size_t b, std::size_t lanes, std::size_t constants,
                std::vector<FanPlace>& places, std::vector<Nodes>& order, std::vector<Found>& in_fans) {
  const auto& block = layout.blocks[b];
  const NodeBlocks::Block& block_nodes = layout.nodes.blocks[b];
  const std::uint16_t* index = &layout.index[block.index];
  std::size_t shape = block.shape;
  for (std::size_t g = 0; g < block.groups; ++g) {
    const FanSize size = layout.size[block.group + g];
    for (std::size_t i = 0; i < size.tets; ++i)
      for (std::size_t l = 0; l < lanes; ++l) {
        const std::size_t after = (i + 1) % size.ring, row[4] = {0, 1, 2 + i, 2 + after};
        FanPlace& place = places.emplace_back();
        place.first_foot = static_cast<std::uint32_t>(shape + i * lanes + l);
        place.foot = static_cast<std::uint32_t>(shape + after * lanes + l);
        Nodes nodes;
        bool is_dummy = false;
        for (std::size_t c = 0; c < 4; ++c) {
          const std::size_t local = index[row[c] * lanes + l] / std::size_t{8};
          is_dummy = is_dummy || local >= block_nodes.nodes;
          nodes[c] = is_dummy ? -1 : static_cast<int>(layout.nodes.place[block_nodes.place + local] / 3);
        }
        order.push_back(nodes);
        if (!is_dummy) in_fans.push_back({sorted(nodes), places.size() - 1});
      }
    index += (2 + size.ring) * lanes;
    shape += (size.ring + size.tets * constants) * lanes;
  }
}

}  // namespace

FanEdges::FanEdges(const std::array<std::uint8_t, 4>& corner, double first_foot, double foot) {
  double at[4][3] = {};  // p q r0 r1 in the edges
  for (std::size_t c = 0; c < 4; ++c)
    if (corner[c] > 0) at[c][corner[c] - 1] = 1;
  for (int i = 0; i < 3; ++i) {
    const double a = at[1][i] - at[0][i];
    M[i][0] = a;
    M[i][1] = at[2][i] - at[0][i] - first_foot * a;
    M[i][2] = at[3][i] - at[0][i] - foot * a;
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

/// Finds each tetrahedron of a fan among the elements of its block by its nodes.
template <class Real>
FanPlaces find_places(const FanLayout<Real>& layout, std::size_t lanes, const std::vector<FanTerms<Real>>& terms,
                      const std::vector<const ElementGroup<Real>*>& groups) {
  std::vector<std::size_t> slot_of;
  for (const ElementGroup<Real>* group : groups)
    for (std::size_t s = 0; s < group->size(); ++s) {
      const auto t = static_cast<std::size_t>(group->element[s]);
      if (t >= slot_of.size()) slot_of.resize(t + 1);
      slot_of[t] = s;
    }
  FanPlaces places;
  std::vector<Found> elements, in_fans;
  std::vector<Nodes> order;  // of the block's places
  for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
    const auto& block = layout.blocks[b];
    const ElementGroup<Real>& group = *groups[block.part];
    const std::size_t first = places.list.size();
    places.start.push_back(first);
    elements.clear(), in_fans.clear(), order.clear();
    for (std::size_t k = 0; k < block.elements; ++k) {
      const std::size_t s = slot_of[static_cast<std::size_t>(layout.element[block.element + k])];
      elements.push_back({sorted({group.node[0][s], group.node[1][s], group.node[2][s], group.node[3][s]}), s});
    }
    add_places(layout, b, lanes, terms[block.part].constants, places.list, order, in_fans);
    std::stable_sort(elements.begin(), elements.end());
    std::stable_sort(in_fans.begin(), in_fans.end());
    assert(elements.size() == in_fans.size());
    for (std::size_t k = 0; k < elements.size(); ++k) {
      assert(elements[k].nodes == in_fans[k].nodes);
      FanPlace& place = places.list[in_fans[k].at];
      place.slot = static_cast<int>(elements[k].at);
      const Nodes& nodes = order[in_fans[k].at - first];
      for (std::size_t c = 0; c < 4; ++c)
        for (std::uint8_t corner = 0; corner < 4; ++corner)
          if (group.node[corner][elements[k].at] == nodes[c]) place.corner[c] = corner;
    }
  }
  places.start.push_back(places.list.size());
  return places;
}

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

template FanPlaces find_places(const FanLayout<float>&, std::size_t, const std::vector<FanTerms<float>>&,
                               const std::vector<const ElementGroup<float>*>&);
template FanPlaces find_places(const FanLayout<double>&, std::size_t, const std::vector<FanTerms<double>>&,
                               const std::vector<const ElementGroup<double>*>&);
template void map_symmetric(const double (&)[3][3], bool, double, const float*, std::size_t, float*, std::size_t);
template void map_symmetric(const double (&)[3][3], bool, double, const double*, std::size_t, double*, std::size_t);

}  // namespace heml
