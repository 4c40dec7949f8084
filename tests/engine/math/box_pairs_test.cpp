#include <doctest/doctest.h>

#include <algorithm>
#include <heml/math/box_pairs.hpp>
#include <random>

using heml::intersecting_pairs;

namespace {

using Box = Eigen::AlignedBox3d;
using Pairs = std::vector<std::pair<int, int>>;

Pairs sorted(Pairs pairs) {
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

TEST_CASE("pairs of boxes: those that a search of all pairs finds, each once, whatever their sizes") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(0, 1), exponent(-4, 0);
  std::vector<Box> boxes;
  for (int k = 0; k < 300; ++k) {
    const Eigen::Vector3d low(place(random), place(random), place(random));
    const Eigen::Vector3d size(place(random), place(random), place(random));
    boxes.emplace_back(low, low + std::pow(10, exponent(random)) * size);
  }
  boxes.emplace_back(Eigen::Vector3d(0.2, 0.2, 0.2), Eigen::Vector3d(1e12, 1e12, 1e12));
  boxes.push_back(boxes.front());
  Pairs expected;
  for (std::size_t a = 0; a < boxes.size(); ++a)
    for (std::size_t b = a + 1; b < boxes.size(); ++b)
      if (boxes[a].intersects(boxes[b])) expected.emplace_back(static_cast<int>(a), static_cast<int>(b));
  CHECK(expected.size() > 300);
  CHECK(sorted(intersecting_pairs(boxes)) == expected);

  // Of three groups, the second of one box, the last a gap away in numbers; boxes of different ones are widened.
  const double margin = 0.05;
  std::vector<int> group;
  for (std::size_t k = 0; k < boxes.size(); ++k) group.push_back(k == 7 ? 1 : k % 3 == 0 ? 4 : 0);
  Pairs of_groups;
  const auto widened = [&](std::size_t k) {
    const Eigen::Vector3d more = Eigen::Vector3d::Constant(margin);
    return Box(boxes[k].min() - more, boxes[k].max() + more);
  };
  for (std::size_t a = 0; a < boxes.size(); ++a)
    for (std::size_t b = a + 1; b < boxes.size(); ++b)
      if (group[a] == group[b] ? boxes[a].intersects(boxes[b]) : widened(a).intersects(widened(b)))
        of_groups.emplace_back(static_cast<int>(a), static_cast<int>(b));
  CHECK(of_groups.size() > expected.size());
  CHECK(sorted(intersecting_pairs(boxes, group, margin)) == of_groups);
  std::erase_if(of_groups, [&](const auto& pair) {
    return group[static_cast<std::size_t>(pair.first)] == group[static_cast<std::size_t>(pair.second)];
  });
  CHECK(of_groups.size() > 100);
  CHECK(sorted(intersecting_pairs(boxes, group, margin, false)) == of_groups);
}

TEST_CASE("pairs of boxes: boxes that touch are a pair, one box alone or none has none") {
  const Box left(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 1));
  const Box right(Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(2, 2, 2));
  const Box away(Eigen::Vector3d(3, 3, 3), Eigen::Vector3d(4, 4, 4));
  CHECK(intersecting_pairs({left, right, away}) == Pairs{{0, 1}});
  CHECK(intersecting_pairs({left}).empty());
  CHECK(intersecting_pairs({}).empty());
}
