#include <doctest/doctest.h>

#include <algorithm>
#include <heml/elastic/node_blocks.hpp>
#include <numeric>
#include <set>

namespace heml::node_blocks_test {

TEST_CASE("blocks of all parts are of about equal size and, in all, an even number") {
  using Counts = std::vector<std::size_t>;
  CHECK(block_counts({}, 100).empty());
  CHECK(block_counts({0, 100}, 100) == Counts{0, 1});
  CHECK(block_counts({101}, 100) == Counts{2});
  CHECK(block_counts({401}, 100) == Counts{8});
  CHECK(block_counts({1601}, 100) == Counts{32});  // a multiple of 16, not the next power of two
  CHECK(block_counts({3201}, 100) == Counts{48});
  CHECK(block_counts({600, 200}, 100) == Counts{6, 2});
  CHECK(block_counts({640, 161}, 100) == Counts{13, 3});  // 16 of some 50 each
  CHECK(block_counts({1000, 1}, 100) == Counts{16, 1});
  for (const Counts& sizes : {Counts{150, 150, 150, 1}, Counts{255, 1}, Counts{149, 51}, Counts{99, 99, 99, 99}}) {
    const Counts counts = block_counts(sizes, 100);
    for (std::size_t p = 0; p < sizes.size(); ++p) CHECK(sizes[p] <= 100 * counts[p]);
  }
}

TEST_CASE("nodes of one block are its own, others are shared, and sums are in the order of blocks") {
  std::vector<int> first{0, 1, 2, 3}, second{2, 4, 5}, third{2, 5, 6};
  std::vector<char> is_shared(8, 0);  // node 7 is of no block
  is_shared[6] = 1;
  const NodeBlocks blocks({&first, &second, &third}, is_shared);
  REQUIRE(blocks.blocks.size() == 3);
  CHECK(first == std::vector{0, 1, 3, 2});
  CHECK(second == std::vector{4, 2, 5});
  CHECK(third == std::vector{2, 5, 6});
  CHECK(blocks.blocks[0].own == 3);
  CHECK(blocks.blocks[1].own == 1);
  CHECK(blocks.blocks[2].own == 0);
  CHECK(blocks.place == std::vector<std::uint32_t>{0, 3, 9, 6, 12, 6, 15, 6, 15, 18});
  CHECK(blocks.shared_node == std::vector{2, 5, 6, 7});
  CHECK(blocks.shared_slots == 6);

  // What is written at a slot tells the block: a sum in another order would round to other bits.
  ThreadTeam alone(1);
  std::vector<float> of_slot(blocks.shared_slots, 0), of_node(8, -1);
  const float values[] = {1e8f, -1e8f, 1};
  for (std::size_t b = 0; b < 3; ++b)
    for (std::size_t k = blocks.blocks[b].own; k < blocks.blocks[b].nodes; ++k)
      of_slot[blocks.blocks[b].shared_slot + k - blocks.blocks[b].own] = values[b];
  blocks.sum_shared<1>(of_slot.data(), of_node.data(), alone);
  CHECK(of_node[2] == (1e8f + -1e8f) + 1);
  CHECK(of_node[5] == -1e8f + 1);
  CHECK(of_node[6] == 1);
  CHECK(of_node[7] == 0);   // nobody pulls there
  CHECK(of_node[0] == -1);  // left to the block
}

TEST_CASE("sums at shared nodes are the same for any number of threads") {
  constexpr int nodes = 3000, count = 12;
  std::vector<std::vector<int>> of_block(count);
  std::vector<std::vector<int>*> lists;
  for (int b = 0; b < count; ++b) {
    for (int n = 0; n < nodes; ++n)
      if (n % (b + 2) == 0) of_block[static_cast<std::size_t>(b)].push_back(n);
    lists.push_back(&of_block[static_cast<std::size_t>(b)]);
  }
  const NodeBlocks blocks(lists, std::vector<char>(nodes, 0));
  std::vector<double> of_slot(3 * blocks.shared_slots), one(3 * nodes, 0), many(3 * nodes, 0);
  for (std::size_t i = 0; i < of_slot.size(); ++i) of_slot[i] = 1.0 / static_cast<double>(i + 1);
  ThreadTeam alone(1), three(3);
  blocks.sum_shared<3>(of_slot.data(), one.data(), alone);
  blocks.sum_shared<3>(of_slot.data(), many.data(), three);
  CHECK(one == many);
  CHECK(std::set<std::size_t>(blocks.shared_slot.begin(), blocks.shared_slot.end()).size() == blocks.shared_slots);
}

}  // namespace heml::node_blocks_test
