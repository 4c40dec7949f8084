#include <algorithm>
#include <heml/elastic/point_layout.hpp>

namespace heml {

template <class Real>
PointLayout::PointLayout(const std::vector<const ElementGroup<Real>*>& groups, const VirtualCorners<Real>& corners) {
  std::vector<std::size_t> sizes;
  for (const auto* group : groups) sizes.push_back(group ? group->size() / element_points : 0);
  const std::vector<std::size_t> counts = block_counts(sizes, max_point_block_elements);
  for (std::size_t p = 0; p < groups.size(); ++p)
    for (std::size_t b = 0; b < counts[p]; ++b) {
      const std::size_t first = sizes[p] * b / counts[p];
      blocks.push_back({p, first, sizes[p] * (b + 1) / counts[p] - first, 0});
    }
  // Blocks follow each other as their nodes do, so that the thread that runs some has their nodes in its cache.
  const auto element = [&](const Block& block, std::size_t k) {
    return element_at(*groups[block.part], element_points * (block.first + k));
  };
  std::sort(blocks.begin(), blocks.end(),
            [&](const Block& a, const Block& b) { return element(a, a.elements / 2) < element(b, b.elements / 2); });

  std::vector<std::vector<int>> nodes_of(blocks.size());
  std::vector<std::vector<int>*> lists;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    std::vector<int>& list = nodes_of[b];
    for (std::size_t k = 0; k < blocks[b].elements; ++k)
      for (const int n : corners.nodes_of(element(blocks[b], k))) list.push_back(n);
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    lists.push_back(&list);
  }
  nodes = NodeBlocks(std::move(lists), std::vector<char>(corners.nodes(), 0));

  std::vector<std::uint16_t> record(corners.nodes());
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (std::size_t i = 0; i < nodes_of[b].size(); ++i)
      record[static_cast<std::size_t>(nodes_of[b][i])] = static_cast<std::uint16_t>(8 * i);
    blocks[b].index = index.size();
    for (std::size_t k = 0; k < blocks[b].elements; ++k)
      for (const int n : corners.nodes_of(element(blocks[b], k))) index.push_back(record[static_cast<std::size_t>(n)]);
  }
}

template PointLayout::PointLayout(const std::vector<const ElementGroup<float>*>&, const VirtualCorners<float>&);
template PointLayout::PointLayout(const std::vector<const ElementGroup<double>*>&, const VirtualCorners<double>&);

}  // namespace heml
