#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <heml/mesh/element_sets.hpp>
#include <numeric>

namespace heml {
namespace {

constexpr std::size_t max_sets = 10'000;
constexpr std::size_t min_members = 1'000'000;  // that sets may have in all; more where the file is larger

std::string capitals(std::string_view name) {
  std::string text(name);
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

struct NumberedTet {
  long long number;
  int tet;
};

/// The tetrahedra of a range: a run of those that are sorted by number.
void add_range(const std::vector<NumberedTet>& tets, const NumberRange& range, std::vector<int>& members) {
  auto at = std::lower_bound(tets.begin(), tets.end(), range.first,
                             [](const NumberedTet& tet, long long number) { return tet.number < number; });
  for (; at != tets.end() && at->number <= range.last; ++at)
    if ((at->number - range.first) % range.step == 0) members.push_back(at->tet);
}

std::size_t count_range(const std::vector<NumberedTet>& tets, const NumberRange& range) {
  const auto less = [](const NumberedTet& tet, long long number) { return tet.number < number; };
  const auto begin = std::lower_bound(tets.begin(), tets.end(), range.first, less);
  return static_cast<std::size_t>(std::lower_bound(begin, tets.end(), range.last, less) - begin) + 1;
}

}  // namespace

std::size_t ElementSets::find_or_add(std::string_view name, const Scanner& in) {
  const auto [entry, is_new] = index_.try_emplace(capitals(name), sets_.size());
  if (is_new) sets_.push_back({std::string(name), {}, {}});
  if (sets_.size() > max_sets) in.fail(fmt::format("more than {} sets of elements", max_sets), "save fewer");
  return entry->second;
}

void ElementSets::add(std::size_t set, const NumberRange& range) {
  std::vector<NumberRange>& ranges = sets_[set].ranges;
  if (!ranges.empty() && ranges.back().step == 1 && range.step == 1 && range.first - 1 == ranges.back().last)
    ranges.back().last = range.last;
  else
    ranges.push_back(range);
}

void ElementSets::add_set(std::size_t set, std::string_view other, const Scanner& in) {
  const auto found = index_.find(capitals(other));
  if (found == index_.end() || found->second >= set)
    in.fail(fmt::format("the set {} names the set {}, which is not given before it", in_quotes(sets_[set].name),
                        in_quotes(other)));
  sets_[set].others.push_back(found->second);
}

void ElementSets::put(const std::vector<long long>& numbers, const Scanner& in, TetMesh& mesh) const {
  std::vector<NumberedTet> tets(numbers.size());
  for (std::size_t t = 0; t < tets.size(); ++t) tets[t] = {numbers[t], static_cast<int>(t)};
  const auto less = [](const NumberedTet& a, const NumberedTet& b) { return a.number < b.number; };
  if (!std::is_sorted(tets.begin(), tets.end(), less)) std::stable_sort(tets.begin(), tets.end(), less);

  const std::size_t max_members = min_members + 4 * in.size();
  std::size_t visited = 0;
  const auto visit = [&](std::size_t count) {
    visited += count;
    if (visited > max_members)
      in.fail("the sets of elements hold far more elements than the file has bytes", "save fewer sets");
  };
  std::vector<std::vector<int>> members(sets_.size());
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    for (const NumberRange& range : sets_[s].ranges) {
      visit(count_range(tets, range));
      add_range(tets, range, members[s]);
    }
    for (const std::size_t other : sets_[s].others) {
      visit(members[other].size() + 1);
      members[s].insert(members[s].end(), members[other].begin(), members[other].end());
    }
    std::sort(members[s].begin(), members[s].end());
    members[s].erase(std::unique(members[s].begin(), members[s].end()), members[s].end());
  }

  std::vector<std::size_t> used;
  for (const std::string& name : chosen_)
    if (const auto found = index_.find(capitals(name)); found != index_.end() && !members[found->second].empty())
      used.push_back(found->second);
  if (used.empty()) {
    used.resize(sets_.size());
    std::iota(used.begin(), used.end(), 0u);
  }
  std::stable_sort(used.begin(), used.end(),
                   [&](std::size_t a, std::size_t b) { return members[a].size() > members[b].size(); });
  constexpr std::size_t none = max_sets;
  std::vector<std::size_t> set_of(numbers.size(), none);
  for (const std::size_t s : used)
    for (const int t : members[s]) set_of[static_cast<std::size_t>(t)] = s;

  std::vector<int> region(max_sets + 1, 0);
  for (const std::size_t s : set_of) region[s] = 1;
  int last = 0;
  for (std::size_t s = 0; s < none; ++s)
    if (region[s] == 1) {
      region[s] = ++last;
      mesh.region_names[last] = plain_name(sets_[s].name);
    }
  region[none] = 0;
  mesh.regions.resize(numbers.size());
  for (std::size_t t = 0; t < set_of.size(); ++t) mesh.regions[t] = region[set_of[t]];
}

}  // namespace heml
