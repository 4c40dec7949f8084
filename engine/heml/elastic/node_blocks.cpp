#include <algorithm>
#include <heml/elastic/node_blocks.hpp>
#include <numeric>

namespace heml {

std::vector<std::size_t> block_counts(const std::vector<std::size_t>& elements, std::size_t most) {
  const std::size_t all = std::accumulate(elements.begin(), elements.end(), std::size_t{0});
  std::size_t count = 1;
  while (all > count * most) count += std::min<std::size_t>(count, 16);
  std::vector<std::size_t> result;
  for (const std::size_t size : elements) {
    const std::size_t share = all == 0 ? 0 : (size * count + all / 2) / all;  // rounded
    result.push_back(std::max(share, (size + most - 1) / most));
  }
  return result;
}

NodeBlocks::NodeBlocks(std::vector<std::vector<int>*> nodes, std::vector<char> is_shared) {
  const auto at = [](int n) { return static_cast<std::size_t>(n); };
  std::vector<std::size_t> touches(is_shared.size(), 0), fill(is_shared.size(), 0);
  for (const auto* of_block : nodes)
    for (const int n : *of_block) ++touches[at(n)];
  shared_start.push_back(0);
  for (std::size_t n = 0; n < is_shared.size(); ++n) {
    if (touches[n] != 1) is_shared[n] = 1;
    if (!is_shared[n]) continue;
    fill[n] = shared_start.back();
    shared_node.push_back(static_cast<int>(n));
    shared_start.push_back(shared_start.back() + touches[n]);
  }
  shared_slot.resize(shared_start.back());
  for (auto* of_block : nodes) {
    const auto others =
        std::stable_partition(of_block->begin(), of_block->end(), [&](int n) { return !is_shared[at(n)]; });
    blocks.push_back(
        {place.size(), static_cast<std::size_t>(others - of_block->begin()), of_block->size(), shared_slots});
    for (auto n = others; n != of_block->end(); ++n) shared_slot[fill[at(*n)]++] = shared_slots++;
    for (const int n : *of_block) place.push_back(3 * static_cast<std::uint32_t>(n));
  }
}

}  // namespace heml
