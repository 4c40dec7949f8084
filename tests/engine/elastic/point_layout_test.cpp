#include <doctest/doctest.h>

#include <heml/elastic/point_layout.hpp>
#include <heml/mesh/generate.hpp>
#include <set>

#include "quadratic_body.hpp"

namespace heml::point_layout_test {

using test::sample_material;

TEST_CASE("every element of a point kernel is in one block, with records of its own nodes") {
  TetMesh mesh = make_box(Vec3::Ones(), {6, 5, 6});
  const MidEdges midedges = add_midedge_nodes(mesh);
  const VirtualCorners<double> corners(mesh, midedges);
  const TetMesh points = virtual_tets(mesh, midedges);
  // Three parts, of which the second is no point kernel's.
  std::vector<std::vector<int>> of_part(3);
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t)
    for (int q = 0; q < 4; ++q) of_part[t % 7 == 0 ? 1 : t % 7 < 3 ? 2 : 0].push_back(4 * t + q);
  std::vector<ElementGroup<double>> groups;
  for (const auto& elements : of_part) groups.push_back(make_group<double>(points, elements, sample_material("stvk")));
  const PointLayout layout({&groups[0], nullptr, &groups[2]}, corners);

  REQUIRE(layout.blocks.size() >= 4);
  REQUIRE(layout.nodes.blocks.size() == layout.blocks.size());
  std::set<std::size_t> seen;
  std::size_t last = 0;
  for (std::size_t b = 0; b < layout.blocks.size(); ++b) {
    const PointLayout::Block& block = layout.blocks[b];
    const NodeBlocks::Block& nodes = layout.nodes.blocks[b];
    CHECK(block.part != 1);
    CHECK(block.elements > 0);
    CHECK(block.elements <= max_point_block_elements);
    for (std::size_t k = 0; k < block.elements; ++k) {
      const std::size_t element = element_at(groups[block.part], 4 * (block.first + k));
      CHECK(seen.insert(element).second);
      for (std::size_t a = 0; a < 10; ++a) {
        const std::size_t local = layout.index[block.index + 10 * k + a] / std::size_t{8};
        REQUIRE(local < nodes.nodes);
        CHECK(layout.nodes.place[nodes.place + local] == 3 * static_cast<std::uint32_t>(corners.nodes_of(element)[a]));
      }
    }
    const std::size_t middle = element_at(groups[block.part], 4 * (block.first + block.elements / 2));
    CHECK((b == 0 || middle > last));
    last = middle;
  }
  CHECK(4 * seen.size() == of_part[0].size() + of_part[2].size());
  CHECK(PointLayout({&groups[0], nullptr, &groups[2]}, corners) == layout);
}

}  // namespace heml::point_layout_test
