#include <doctest/doctest.h>

#include <app/window/label_place.hpp>
#include <vector>

namespace heml::label_place_test {

using window::place_beside;

namespace {

const panel::Area picture{{0, 0}, {400, 300}};
const ImVec2 size{80, 20};
constexpr float gap = 10;

panel::Area label_of(const std::vector<ImVec2>& points) {
  const ImVec2 from = place_beside(points, size, picture, gap);
  return {from, {from.x + size.x, from.y + size.y}};
}

}  // namespace

TEST_CASE("a label stands beside the middle of a line that leaves room there") {
  const panel::Area upright = label_of({{200, 50}, {200, 250}});
  CHECK(upright.from.x == 210);
  CHECK(upright.from.y == 140);
  const panel::Area level = label_of({{100, 150}, {300, 150}});
  CHECK(level.from.x == 160);
  CHECK(level.from.y == 160);
}

TEST_CASE("a label covers neither points nor lines, and stays in the picture") {
  const std::vector<std::vector<ImVec2>> lines{{{150, 150}, {190, 150}}, {{100, 100}, {140, 130}, {180, 100}},
                                               {{390, 20}, {390, 280}},  {{5, 5}, {15, 15}, {5, 25}},
                                               {{380, 290}, {395, 295}}, {{10, 10}, {390, 290}},
                                               {{200, 150}, {202, 151}}};
  for (const std::vector<ImVec2>& points : lines) {
    CAPTURE(points[0].x);
    const panel::Area label = label_of(points);
    CHECK(label.from.x >= 0);
    CHECK(label.from.y >= 0);
    CHECK(label.to.x <= 400);
    CHECK(label.to.y <= 300);
    for (std::size_t k = 1; k < points.size(); ++k)
      for (int i = 0; i <= 100; ++i) {
        const float t = static_cast<float>(i) / 100;
        const ImVec2 &a = points[k - 1], &b = points[k];
        CHECK_FALSE(label.contains(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)));
      }
  }
}

TEST_CASE("where there is no room the label stays in the picture") {
  const panel::Area low{{0, 0}, {90, 25}};
  const std::vector<ImVec2> points{{20, 10}, {60, 10}};
  const ImVec2 from = place_beside(points, size, low, gap);
  CHECK(low.contains(from.x, from.y));
  CHECK(from.x + size.x <= 90);
  CHECK(from.y + size.y <= 25);
}

}  // namespace heml::label_place_test
