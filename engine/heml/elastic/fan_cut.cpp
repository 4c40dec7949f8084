#include <algorithm>
#include <array>
#include <compare>
#include <heml/elastic/fan_block.hpp>
#include <heml/elastic/fan_cut.hpp>

namespace heml {
namespace {

constexpr std::size_t max_tets = max_fan_tets;

/// Fan sizes in the order of the greedy search: those that read fewest nodes per tetrahedron first.
const std::vector<FanSize>& sizes_by_cost() {
  static const std::vector<FanSize> sizes = [] {
    std::vector<FanSize> list;
    for (std::size_t m = max_tets; m > 0; --m) {
      const auto tets = static_cast<std::uint8_t>(m), more = static_cast<std::uint8_t>(m + 1);
      if (m > 2) list.push_back({tets, tets});
      list.push_back({tets, more});
    }
    std::stable_sort(list.begin(), list.end(),
                     [](FanSize a, FanSize b) { return (2 + a.ring) * b.tets < (2 + b.ring) * a.tets; });
    return list;
  }();
  return sizes;
}

/// Position of a size in sizes_by_cost().
std::size_t rank_of(std::size_t tets, bool closed) {
  using Ranks = std::array<std::array<std::size_t, 2>, max_tets + 1>;
  static const Ranks ranks = [] {
    Ranks table{};
    for (std::size_t k = 0; const FanSize size : sizes_by_cost()) table[size.tets][size.ring == size.tets] = k++;
    return table;
  }();
  return ranks[tets][closed];
}

/// One tetrahedron seen from one of its edges pq: (p, q, from, to) has positive volume.
struct Sector {
  int p, q, from, to;
  std::size_t tet;
  std::uint64_t edge() const { return static_cast<std::uint64_t>(p) << 32 | static_cast<std::uint64_t>(q); }
};

std::vector<Sector> sectors_by_edge(const std::vector<Tet>& tets) {
  constexpr std::size_t even[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                                      {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};
  struct Key {
    std::uint64_t edge;
    std::size_t sector;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<Sector> sectors;
  std::vector<Key> order;
  sectors.reserve(6 * tets.size());
  order.reserve(6 * tets.size());
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (const auto& corner : even) {
      Sector s{tets[t][corner[0]], tets[t][corner[1]], tets[t][corner[2]], tets[t][corner[3]], t};
      if (s.p > s.q) std::swap(s.p, s.q), std::swap(s.from, s.to);
      order.push_back({s.edge(), sectors.size()});
      sectors.push_back(s);
    }
  std::sort(order.begin(), order.end());
  std::vector<Sector> sorted;
  sorted.reserve(sectors.size());
  for (const Key& key : order) sorted.push_back(sectors[key.sector]);
  return sorted;
}

/// Finds the longest chain of adjacent tetrahedra round one edge that are not taken yet, at most `max_tets`.
class LongestChain {
 public:
  const std::vector<const Sector*>& operator()(const Sector* begin, const Sector* end, const std::vector<char>& taken) {
    left_.clear();
    best_.clear();
    for (const Sector* s = begin; s != end; ++s)
      if (!taken[s->tet]) left_.push_back(s);
    for (const Sector* first : left_)
      if (std::none_of(left_.begin(), left_.end(), [&](const Sector* s) { return s->to == first->from; }))
        try_from(first);
    if (best_.empty() && !left_.empty()) try_from(left_.front());  // a closed ring
    return best_;
  }

 private:
  void try_from(const Sector* first) {
    chain_.clear();
    for (const Sector* s = first; s && chain_.size() < max_tets; s = after(s)) {
      if (std::find(chain_.begin(), chain_.end(), s) != chain_.end()) break;  // ring closed, or tetrahedra overlap
      chain_.push_back(s);
    }
    if (chain_.size() > best_.size()) std::swap(chain_, best_);
  }
  const Sector* after(const Sector* of) const {
    const auto next = std::find_if(left_.begin(), left_.end(), [&](const Sector* s) { return s->from == of->to; });
    return next == left_.end() ? nullptr : *next;
  }

  std::vector<const Sector*> left_, chain_, best_;
};

bool is_closed(const std::vector<const Sector*>& chain) {
  return chain.size() > 2 && chain.back()->to == chain.front()->from;
}

Fan fan_of(const std::vector<const Sector*>& chain) {
  Fan fan{chain.front()->p, chain.front()->q, {}, {}};
  fan.ring.reserve(chain.size() + 1);
  fan.tets.reserve(chain.size());
  fan.ring.push_back(chain.front()->from);
  for (const Sector* s : chain) {
    fan.ring.push_back(s->to);
    fan.tets.push_back(s->tet);
  }
  if (is_closed(chain)) fan.ring.pop_back();
  return fan;
}

/// Greedy: takes the best fans first, since the remaining ones are short in any order. Result: fans by rank of size.
std::vector<std::vector<Fan>> greedy_fans(const std::vector<Tet>& tets) {
  const std::vector<Sector> sectors = sectors_by_edge(tets);
  std::vector<std::pair<std::size_t, std::size_t>> edges;  // sectors [first, second) of each edge
  for (std::size_t i = 0, j; i < sectors.size(); i = j) {
    for (j = i; j < sectors.size() && sectors[j].edge() == sectors[i].edge();) ++j;
    edges.push_back({i, j});
  }
  const std::size_t ranks = sizes_by_cost().size();
  std::vector<std::vector<std::size_t>> waiting(ranks);  // edges by the best rank that their chains can have
  for (std::size_t e = edges.size(); e-- > 0;) {
    const std::size_t round = edges[e].second - edges[e].first;
    waiting[rank_of(std::min(max_tets, round), round > 2 && round <= max_tets)].push_back(e);
  }
  std::vector<char> taken(tets.size(), 0);
  std::vector<std::vector<Fan>> fans(ranks);
  LongestChain max_chain;
  for (std::size_t rank = 0; rank < ranks; ++rank)
    while (!waiting[rank].empty()) {
      const std::size_t e = waiting[rank].back();
      waiting[rank].pop_back();
      const auto& chain = max_chain(&sectors[edges[e].first], sectors.data() + edges[e].second, taken);
      if (chain.empty()) continue;
      const std::size_t found = rank_of(chain.size(), is_closed(chain));
      if (found > rank) {
        waiting[found].push_back(e);
        continue;
      }
      for (const Sector* s : chain) taken[s->tet] = 1;
      fans[found].push_back(fan_of(chain));  // a better rank than this one where tetrahedra overlap round an edge
      waiting[rank].push_back(e);
    }
  return fans;
}

Fan part_of(const Fan& fan, std::size_t begin, std::size_t end) {
  const auto at = [](const auto& list, std::size_t i) { return list.begin() + static_cast<std::ptrdiff_t>(i); };
  return {fan.p, fan.q, {at(fan.ring, begin), at(fan.ring, end + 1)}, {at(fan.tets, begin), at(fan.tets, end)}};
}

/// Opens a closed fan or halves an open one of two tetrahedra or more, and passes the result to `put`.
template <class Put>
void cut_shorter(Fan fan, const Put& put) {
  const std::size_t m = fan.tets.size();
  if (fan.ring.size() == m) {
    fan.ring.push_back(fan.ring.front());
    return put(fan);
  }
  put(part_of(fan, 0, (m + 1) / 2));
  put(part_of(fan, (m + 1) / 2, m));
}

}  // namespace

std::vector<Fan> cut_into_fans(const std::vector<Tet>& tets, std::size_t lanes) {
  auto fans = greedy_fans(tets);
  const auto put = [&](const Fan& fan) {
    fans[rank_of(fan.tets.size(), fan.ring.size() == fan.tets.size())].push_back(fan);
  };
  std::vector<Fan> result;
  for (auto& list : fans) {
    while (list.size() % lanes != 0) {
      if (&list == &fans.back()) {
        list.push_back({-1, -1, {-1, -1}, {}});
        continue;
      }
      const Fan fan = std::move(list.back());
      list.pop_back();
      cut_shorter(fan, put);
    }
    const std::size_t groups = list.size() / lanes;
    for (std::size_t g = 0; g < groups; ++g)
      for (std::size_t l = 0; l < lanes; ++l) result.push_back(std::move(list[l * groups + g]));
  }
  return result;
}

}  // namespace heml
