#include <algorithm>
#include <heml/elastic/fan_block.hpp>
#include <heml/elastic/fan_cut.hpp>

namespace heml {
namespace {

constexpr std::size_t longest = longest_fan;

/// One tetrahedron at one of its edges: (p, q, from, to) has positive volume.
struct Sector {
  int p, q, from, to;
  std::size_t tet;
  std::uint64_t edge() const { return static_cast<std::uint64_t>(p) << 32 | static_cast<std::uint64_t>(q); }
};

std::vector<Sector> sectors_by_edge(const std::vector<Tet>& tets) {
  constexpr std::size_t even[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                                      {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};
  std::vector<Sector> sectors;
  sectors.reserve(6 * tets.size());
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (const auto& order : even) {
      Sector s{tets[t][order[0]], tets[t][order[1]], tets[t][order[2]], tets[t][order[3]], t};
      if (s.p > s.q) std::swap(s.p, s.q), std::swap(s.from, s.to);
      sectors.push_back(s);
    }
  std::sort(sectors.begin(), sectors.end(), [](const Sector& a, const Sector& b) {
    return a.edge() != b.edge() ? a.edge() < b.edge() : a.tet < b.tet;
  });
  return sectors;
}

/// The longest chain among the sectors of one edge whose tetrahedra are not yet taken, at most `longest`.
class LongestChain {
 public:
  std::vector<const Sector*> operator()(const Sector* begin, const Sector* end, const std::vector<char>& taken) {
    left_.clear();
    for (const Sector* s = begin; s != end; ++s)
      if (!taken[s->tet]) left_.push_back(s);
    std::vector<const Sector*> best;
    const auto follows = [&](int node) {
      const auto next = std::find_if(left_.begin(), left_.end(), [&](const Sector* s) { return s->from == node; });
      return next == left_.end() ? nullptr : *next;
    };
    const auto try_from = [&](const Sector* first) {
      std::vector<const Sector*> chain;
      for (const Sector* s = first; s && chain.size() < longest; s = follows(s->to)) {
        if (std::find(chain.begin(), chain.end(), s) != chain.end()) break;  // round, or overlapping tetrahedra
        chain.push_back(s);
      }
      if (chain.size() > best.size()) best = chain;
    };
    for (const Sector* first : left_)
      if (std::none_of(left_.begin(), left_.end(), [&](const Sector* s) { return s->to == first->from; }))
        try_from(first);
    if (best.empty() && !left_.empty()) try_from(left_.front());  // a closed ring
    return best;
  }

 private:
  std::vector<const Sector*> left_;
};

Fan fan_of(const std::vector<const Sector*>& chain) {
  Fan fan{chain.front()->p, chain.front()->q, {chain.front()->from}, {}};
  for (const Sector* s : chain) {
    fan.ring.push_back(s->to);
    fan.tets.push_back(s->tet);
  }
  return fan;
}

/// By length; longest chains first, since what they leave is short anyway.
std::vector<std::vector<Fan>> greedy_fans(const std::vector<Tet>& tets) {
  const std::vector<Sector> sectors = sectors_by_edge(tets);
  std::vector<std::pair<std::size_t, std::size_t>> edges;  // range of sectors
  for (std::size_t i = 0, j; i < sectors.size(); i = j) {
    for (j = i; j < sectors.size() && sectors[j].edge() == sectors[i].edge();) ++j;
    edges.push_back({i, j});
  }
  std::vector<std::vector<std::size_t>> waiting(longest + 1);  // edges by a bound on their longest chain
  for (std::size_t e = edges.size(); e-- > 0;)
    waiting[std::min(longest, edges[e].second - edges[e].first)].push_back(e);
  std::vector<char> taken(tets.size(), 0);
  std::vector<std::vector<Fan>> fans(longest + 1);
  LongestChain longest_chain;
  for (std::size_t m = longest; m > 0; --m)
    while (!waiting[m].empty()) {
      const std::size_t e = waiting[m].back();
      waiting[m].pop_back();
      const auto chain = longest_chain(&sectors[edges[e].first], sectors.data() + edges[e].second, taken);
      if (chain.size() < m) {
        if (!chain.empty()) waiting[chain.size()].push_back(e);
        continue;
      }
      for (const Sector* s : chain) taken[s->tet] = 1;
      fans[m].push_back(fan_of(chain));
      waiting[m].push_back(e);
    }
  return fans;
}

Fan part_of(const Fan& fan, std::size_t begin, std::size_t end) {
  const auto at = [](const auto& list, std::size_t i) { return list.begin() + static_cast<std::ptrdiff_t>(i); };
  return {fan.p, fan.q, {at(fan.ring, begin), at(fan.ring, end + 1)}, {at(fan.tets, begin), at(fan.tets, end)}};
}

}  // namespace

std::vector<Fan> cut_into_fans(const std::vector<Tet>& tets, std::size_t lanes) {
  auto fans = greedy_fans(tets);
  std::vector<Fan> result;
  for (std::size_t m = longest; m > 0; --m) {
    auto& list = fans[m];
    while (list.size() % lanes != 0) {
      if (m == 1) {
        list.push_back({-1, -1, {-1, -1}, {}});
        continue;
      }
      const Fan fan = std::move(list.back());
      list.pop_back();
      fans[(m + 1) / 2].push_back(part_of(fan, 0, (m + 1) / 2));
      fans[m / 2].push_back(part_of(fan, (m + 1) / 2, m));
    }
    const std::size_t groups = list.size() / lanes;
    for (std::size_t g = 0; g < groups; ++g)
      for (std::size_t l = 0; l < lanes; ++l) result.push_back(std::move(list[l * groups + g]));
  }
  return result;
}

}  // namespace heml
