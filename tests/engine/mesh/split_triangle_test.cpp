#include <doctest/doctest.h>

#include <heml/mesh/split_triangle.hpp>
#include <map>
#include <random>

namespace heml::split_triangle_test {
namespace {

using Eigen::Vector2d;

struct Case {
  std::vector<Vector2d> points{{0, 0}, {1, 0}, {0.2, 0.9}};
  std::array<std::vector<int>, 3> sides;
  std::vector<std::array<int, 2>> segments;

  int add(const Vector2d& point) {
    points.push_back(point);
    return static_cast<int>(points.size()) - 1;
  }
  int on_side(std::size_t k, double place) {
    sides[k].push_back(add(points[k] + place * (points[(k + 1) % 3] - points[k])));
    return sides[k].back();
  }
  int inside(double second, double third) {
    return add((1 - second - third) * points[0] + second * points[1] + third * points[2]);
  }
  double area(const Triangle& t) const {
    const Vector2d a = points[static_cast<std::size_t>(t[1])] - points[static_cast<std::size_t>(t[0])],
                   b = points[static_cast<std::size_t>(t[2])] - points[static_cast<std::size_t>(t[0])];
    return (a.x() * b.y() - a.y() * b.x()) / 2;
  }

  /// The parts fill the triangle without overlap, and segments are edges of two of them.
  void check() const {
    double sum = 0;
    std::map<std::array<int, 2>, int> edges;  // by direction
    for (const Triangle& part : split_triangle(points, sides, segments)) {
      CHECK(area(part) > 0);
      sum += area(part);
      for (std::size_t k = 0; k < 3; ++k) ++edges[{part[k], part[(k + 1) % 3]}];
    }
    CHECK(sum == doctest::Approx(area({0, 1, 2})).epsilon(1e-12));
    std::size_t single = 0;
    for (const auto& [edge, count] : edges) {
      CHECK(count == 1);
      single += !edges.contains({edge[1], edge[0]});
    }
    CHECK(single == 3 + sides[0].size() + sides[1].size() + sides[2].size());  // the outline, unbroken
    for (const auto& [a, b] : segments) {
      CHECK(edges.contains({a, b}));
      CHECK(edges.contains({b, a}));
    }
  }
};

}  // namespace

TEST_CASE("a triangle without points stays") {
  const Case whole;
  CHECK(split_triangle(whole.points, whole.sides, whole.segments) == std::vector<Triangle>{{0, 1, 2}});
}

TEST_CASE("a line through a triangle divides it, from side to side or to an end inside") {
  Case through;
  through.segments = {{through.on_side(0, 0.4), through.on_side(1, 0.3)}};
  through.check();
  Case bent;
  const int bend = bent.inside(0.3, 0.3);
  bent.segments = {{bent.on_side(0, 0.5), bend}, {bend, bent.on_side(2, 0.7)}};
  bent.check();
  Case ending;
  ending.segments = {{ending.on_side(1, 0.5), ending.inside(0.2, 0.2)}};
  ending.check();
}

TEST_CASE("three points in a line inside give no part across the middle one") {
  Case line;
  const int a = line.inside(0.2, 0.2), b = line.inside(0.3, 0.2), c = line.inside(0.4, 0.2);
  line.segments = {{a, b}, {b, c}};
  line.check();
}

TEST_CASE("triangles with points and lines at random are filled by their parts") {
  std::mt19937 random(5);
  const auto number = [&] { return std::uniform_real_distribution<double>(0, 1)(random); };
  for (int round = 0; round < 300; ++round) {
    Case some;
    for (std::size_t k = 0; k < 3; ++k) {
      double place = 0;
      for (auto count = random() % 4; count > 0; --count) some.on_side(k, place += 0.02 + 0.2 * number());
    }
    std::vector<int> inner;
    for (auto count = random() % 5; count > 0; --count) {
      const double second = 0.05 + 0.4 * number();
      inner.push_back(some.inside(second, 0.05 + 0.4 * number()));
    }
    // A line through the inner points from left to right does not cross itself.
    std::sort(inner.begin(), inner.end(), [&](int a, int b) {
      return some.points[static_cast<std::size_t>(a)].x() < some.points[static_cast<std::size_t>(b)].x();
    });
    for (std::size_t i = 0; i + 1 < inner.size(); ++i) some.segments.push_back({inner[i], inner[i + 1]});
    some.check();
  }
}

}  // namespace heml::split_triangle_test
