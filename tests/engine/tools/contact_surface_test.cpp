#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <heml/tools/contact_surface.hpp>

#include "support.hpp"

namespace heml::contact_surface_test {

using namespace heml::test;

namespace {

/// Its tip at a place for good.
ContactSurface capsule_at(const Vec3& tip, const Vec3& shaft, double radius) {
  Probe probe(radius, shaft, 0);
  probe.go({tip}, 0, 0);
  return surface_of(probe, 0);
}

ContactSurface ball(const Vec3& center, double radius) { return capsule_at(center, Vec3::Zero(), radius); }

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + t * (b - a) - p).norm();
}

/// By the plane where p lies above the triangle, by its edges elsewhere.
double distance_to_triangle(const Vec3& p, const std::array<Vec3, 3>& x) {
  const Vec3 n = (x[1] - x[0]).cross(x[2] - x[0]).normalized();
  bool above = true;
  double distance = 1e300;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = x[i], &b = x[(i + 1) % 3];
    above = above && (b - a).cross(p - a).dot(n) >= 0;
    distance = std::min(distance, distance_to_segment(p, a, b));
  }
  return above ? std::abs(n.dot(p - x[0])) : distance;
}

/// Distance along the axis is convex: its minimum lies between the better two thirds.
double distance_of(const Vec3& tip, const Vec3& tail, const std::array<Vec3, 3>& x) {
  double low = 0, high = 1;
  const auto at = [&](double s) { return distance_to_triangle(tip + s * (tail - tip), x); };
  for (int k = 0; k < 200; ++k) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (at(a) < at(b) ? high : low) = at(a) < at(b) ? b : a;
  }
  return at((low + high) / 2);
}

Vec3 place_of(const ContactPoint& point, const std::array<Vec3, 3>& x) {
  return point.weights[0] * x[0] + point.weights[1] * x[1] + point.weights[2] * x[2];
}

std::array<Vec3, 3> random_triangle(std::mt19937_64& random) {
  return {random_vector(random, 1), random_vector(random, 1), random_vector(random, 1)};
}

}  // namespace

TEST_CASE("above a plane the gap of a node is its height, and only nodes nearer than the reach are met") {
  std::mt19937_64 random(1);
  const Vec3 n = Vec3(1, 2, -2) / 3, origin(0.5, 0, 1);
  std::vector<Vec3> x;
  for (int k = 0; k < 50; ++k) x.push_back(random_vector(random, 1));
  const ContactBoundary boundary{{3, 7, 8, 20, 31, 49}, {}};
  std::vector<int> expected, met;
  for (const int k : boundary.nodes)
    if ((x[static_cast<std::size_t>(k)] - origin).dot(n) < 0.1) expected.push_back(k);
  REQUIRE(expected.size() > 1);
  REQUIRE(expected.size() < boundary.nodes.size());
  const auto at = [&](int k) { return x[static_cast<std::size_t>(k)]; };
  const ContactSurface plane = surface_of(PlacedTable{{origin, n, 0.5}}, 0);
  CHECK(plane.friction == 0.5);
  each_contact(plane, boundary, 0.1, at, [&](const ContactPoint& point) {
    met.push_back(point.nodes[0]);
    CHECK(point.count == 1);
    CHECK(point.weights[0] == 1);
    CHECK(point.gap == doctest::Approx((at(point.nodes[0]) - origin).dot(n)).epsilon(1e-14));
    CHECK((point.normal - n).norm() == 0);
    CHECK(updated_gap(plane, point, [&](int k) -> Vec3 { return at(k) + 0.25 * n; }) ==
          doctest::Approx(point.gap + 0.25).epsilon(1e-14));
  });
  CHECK(met == expected);
}

TEST_CASE("a table that rises is below its place by what is left of its way") {
  const Vec3 n = Vec3(2, -1, 2) / 3, place(0.5, 0, 1);
  const PlacedTable placed{{place, n, 0.5}, 0.3, 0.2, 1};
  const auto below = [&](double time) { return n.dot(place - surface_of(placed, time).point); };
  CHECK(below(1) == doctest::Approx(0.3));
  CHECK(below(2) == doctest::Approx(0.1));
  CHECK(surface_of(placed, 2.6).point == place);
  CHECK(surface_of(PlacedTable{{place, n, 0.5}}, 0).point == place);
  CHECK(placed.rises(2));
  CHECK_FALSE(placed.rises(2.6));
}

TEST_CASE("a ball meets a face at its inside, an edge or a corner, whichever is nearest") {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  struct Case {
    Vec3 center;
    double distance;
    std::array<double, 3> weights;
    Vec3 normal;
  };
  for (const Case& of : {Case{{0.25, 0.5, 0.3}, 0.3, {0.25, 0.25, 0.5}, {0, 0, -1}},
                         Case{{0.25, 0.5, -0.3}, 0.3, {0.25, 0.25, 0.5}, {0, 0, 1}},
                         Case{{0.5, -0.3, 0.4}, 0.5, {0.5, 0.5, 0}, {0, 0.6, -0.8}},
                         Case{{1.5, -0.2, 1.4}, 1.5, {0, 1, 0}, Vec3(-0.5, 0.2, -1.4) / 1.5}}) {
    CAPTURE(of.center.transpose());
    const double distance = (of.weights[0] * a + of.weights[1] * b + of.weights[2] * c - of.center).norm();
    const auto point = capsule_face_contact(ball(of.center, 0.7), {4, 5, 6}, a, b, c, 1);
    REQUIRE(point);
    CHECK(distance == doctest::Approx(of.distance));
    CHECK(point->nodes == std::array<int, 4>{4, 5, 6, 4});
    CHECK(point->count == 3);
    CHECK(point->gap == doctest::Approx(of.distance - 0.7));
    for (std::size_t k = 0; k < 3; ++k) CHECK(point->weights[k] == doctest::Approx(of.weights[k]));
    CHECK((point->normal - of.normal).norm() < 1e-14);
    CHECK_FALSE(capsule_face_contact(ball(of.center, 0.7), {4, 5, 6}, a, b, c, of.distance - 0.7 - 1e-9));
    CHECK(capsule_face_contact(ball(of.center, 0.7), {4, 5, 6}, a, b, c, of.distance - 0.7 + 1e-9));
  }
  CHECK_FALSE(capsule_face_contact(ball({0.25, 0.25, 0}, 0.7), {4, 5, 6}, a, b, c, 1));  // no direction is out
}

TEST_CASE("the gap of a capsule is the least distance of its axis and the face, less its radius") {
  std::mt19937_64 random(2);
  int along_axis = 0;
  for (int k = 0; k < 400; ++k) {
    const std::array<Vec3, 3> x = random_triangle(random);
    const Vec3 n = (x[1] - x[0]).cross(x[2] - x[0]);
    const Vec3 tip = random_vector(random, 2), tail = random_vector(random, 2);
    if (n.dot(tip - x[0]) * n.dot(tail - x[0]) < 0 && distance_of(tip, tail, x) < 1e-9) continue;  // see below
    const ContactSurface capsule = capsule_at(tip, tail - tip, 0.1);
    const auto point = capsule_face_contact(capsule, {0, 1, 2}, x[0], x[1], x[2], 10);
    REQUIRE(point);
    const double distance = distance_of(tip, tail, x);
    CHECK(point->gap == doctest::Approx(distance - 0.1).epsilon(1e-9));
    const auto& w = point->weights;
    CHECK(std::min({w[0], w[1], w[2]}) >= 0);
    CHECK(w[0] + w[1] + w[2] == doctest::Approx(1));
    const Vec3 place = place_of(*point, x), on_axis = place - distance * point->normal;
    CHECK(point->normal.norm() == doctest::Approx(1));
    CHECK(distance_to_segment(on_axis, tip, tail) < 1e-9);
    along_axis += (on_axis - tip).norm() > 0.01 && (on_axis - tail).norm() > 0.01 ? 1 : 0;
  }
  CHECK(along_axis > 20);
}

TEST_CASE("where the axis passes through a face the contact is at the crossing, out over the less deep end") {
  std::mt19937_64 random(4);
  int crossings = 0;
  for (int k = 0; k < 4000; ++k) {
    const std::array<Vec3, 3> x = random_triangle(random);
    const Vec3 tip = random_vector(random, 1), tail = random_vector(random, 1), axis = tail - tip;
    if (distance_of(tip, tail, x) > 1e-9) continue;
    ++crossings;
    const auto point = capsule_face_contact(capsule_at(tip, axis, 0.1), {0, 1, 2}, x[0], x[1], x[2], 0);
    REQUIRE(point);
    CHECK(distance_to_segment(place_of(*point, x), tip, tail) < 1e-9);  // no other point of the face is as near
    const auto height = [&](const Vec3& p) { return point->normal.dot(p - x[0]); };
    CHECK(std::abs(point->normal.dot(x[1] - x[0])) < 1e-12);
    CHECK(std::abs(point->normal.dot(x[2] - x[0])) < 1e-12);
    CHECK(point->normal.norm() == doctest::Approx(1));
    // Moved along the normal by its depth, the face is free of the axis, and no shorter way along its normal frees it.
    const double depth = -point->gap - 0.1;
    REQUIRE(depth >= 0);
    CHECK(std::max(height(tip), height(tail)) == doctest::Approx(depth));
    CHECK(-std::min(height(tip), height(tail)) >= depth * (1 - 1e-12));
    const auto moved = [&](double by) {
      std::array<Vec3, 3> y = x;
      for (Vec3& corner : y) corner += by * point->normal;
      return y;
    };
    CHECK(distance_of(tip, tail, moved(depth + 1e-6)) > 0.9e-6);
  }
  CHECK(crossings > 100);
}

TEST_CASE("the gap of a capsule is continuous as its tip goes through a face") {
  const std::array<Vec3, 3> x = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  for (const double height : {0.02, 1e-6, -1e-6, -0.02, -0.3}) {
    const Vec3 tip(0.25, 0.25, height);
    const auto point = capsule_face_contact(capsule_at(tip, Vec3(0.1, 0, 2), 0.05), {0, 1, 2}, x[0], x[1], x[2], 1);
    REQUIRE(point);
    CHECK(point->gap == doctest::Approx(height - 0.05));
    CHECK((point->normal - Vec3(0, 0, -1)).norm() < 1e-12);
  }
}

TEST_CASE("a probe meets every face within reach of it, in their order") {
  std::mt19937_64 random(3);
  std::vector<Vec3> x;
  ContactBoundary boundary;
  for (int f = 0; f < 600; ++f) {
    const Vec3 middle = random_vector(random, 4);
    for (int k = 0; k < 3; ++k) x.push_back(middle + random_vector(random, 0.6));
    boundary.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  const Vec3 tip(-1, -0.5, 0.3), tail(1, 1.5, -0.4);
  std::vector<int> expected, met;
  for (std::size_t f = 0; f < boundary.faces.size(); ++f)
    if (distance_of(tip, tail, {x[3 * f], x[3 * f + 1], x[3 * f + 2]}) < 0.9) expected.push_back(static_cast<int>(f));
  each_contact(
      capsule_at(tip, tail - tip, 0.5), boundary, 0.4, [&](int n) { return x[static_cast<std::size_t>(n)]; },
      [&](const ContactPoint& point) { met.push_back(point.nodes[0] / 3); });
  CHECK(expected.size() > 10);
  CHECK(met == expected);
}

TEST_CASE("no face that a capsule touches is said to be away from it") {
  std::mt19937_64 random(4);
  int touched = 0, away = 0;
  for (int k = 0; k < 20000; ++k) {
    const Vec3 tip = random_vector(random, 1), shaft = k % 3 ? random_vector(random, 2) : Vec3(Vec3::Zero());
    const Vec3 middle = random_vector(random, 3);
    const std::array<Vec3, 3> x{middle + random_vector(random, 1), middle + random_vector(random, 1),
                                middle + random_vector(random, 1)};
    const ContactSurface capsule = capsule_at(tip, shaft, 0.3);
    const bool touches = capsule_face_contact(capsule, {0, 1, 2}, x[0], x[1], x[2], 0.2).has_value();
    const bool may = may_touch(capsule, x[0], x[1], x[2], 0.2);
    CHECK((may || !touches));
    touched += touches;
    away += !may;
  }
  CHECK(touched > 500);
  CHECK(away > 5000);
}

TEST_CASE("the gap of a capsule grows by how far its point is moved along the normal") {
  const std::array<Vec3, 3> x = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const ContactSurface surface = ball({0.2, 0.3, 0.5}, 0.6);
  const auto point = capsule_face_contact(surface, {0, 1, 2}, x[0], x[1], x[2], 0);
  REQUIRE(point);
  CHECK(updated_gap(surface, *point, [&](int n) -> Vec3 {
          return x[static_cast<std::size_t>(n)] + 0.04 * point->normal;
        }) == doctest::Approx(point->gap + 0.04));
  CHECK(updated_gap(surface, *point, [&](int n) -> Vec3 { return x[static_cast<std::size_t>(n)] - Vec3(0, 0, 5); }) ==
        0);
}

TEST_CASE("a thread's gap is what is left of its length, and back is towards each other") {
  const ContactSurface thread = surface_of(Suture{{3, 8}, 0.5, 0.5, 0, 0}, 0);
  const Vec3 a(1, 0, 0), b(1, 0.3, 0.4);
  const auto point = thread_contact(thread, a, b, 1e-9);
  REQUIRE(point);
  CHECK(point->count == 2);
  CHECK(point->nodes[0] == 3);
  CHECK(point->nodes[1] == 8);
  CHECK(point->weights == std::array<double, 4>{1, -1, 0, 0});
  CHECK(std::abs(point->gap) < 1e-15);
  CHECK((point->normal - Vec3(0, 0.6, 0.8)).norm() < 1e-15);  // the first goes to the second
  const auto longer = thread_contact(thread, a, Vec3(1, 0.6, 0.8), 0);
  REQUIRE(longer);
  CHECK(longer->gap == doctest::Approx(-0.5));
  CHECK_FALSE(thread_contact(thread, a, Vec3(1, 0.3, 0), 0.19));
  CHECK(thread_contact(thread, a, Vec3(1, 0.3, 0), 0.21));
  CHECK_FALSE(thread_contact(thread, a, a, 1));  // no direction
  CHECK(updated_gap(thread, *longer, [&](int n) -> Vec3 { return n == 3 ? a : Vec3(2, 0, 0); }) ==
        doctest::Approx(-0.5));
}

TEST_CASE("a thread is drawn in linearly in time and stays as short as it got") {
  const Suture suture{{0, 1}, 0.2, 0.05, 1, 3};
  for (const auto& [time, length] :
       {std::pair{0.0, 0.2}, {1.0, 0.2}, {2.0, 0.15}, {3.0, 0.1}, {4.0, 0.05}, {9.0, 0.05}})
    CHECK(surface_of(suture, time).radius == doctest::Approx(length));
  CHECK(Suture{{0, 1}, 0.2, 0.05, 1, 0}.length(0) == doctest::Approx(0.05));
}

TEST_CASE("a probe goes along its path at its speed and stays at the end, and sets out anew from where it is") {
  Probe probe(0.1, Vec3(0, 1, 0), 0);
  probe.go({Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(3, 0, 4)}, 2, 10);
  CHECK((probe.tip(9) - Vec3(0, 0, 0)).norm() == 0);
  CHECK((probe.tip(11) - Vec3(2, 0, 0)).norm() < 1e-15);
  CHECK((probe.tip(12.5) - Vec3(3, 0, 2)).norm() < 1e-15);
  CHECK((probe.tip(100) - Vec3(3, 0, 4)).norm() == 0);
  CHECK((surface_of(probe, 11).other - Vec3(2, 1, 0)).norm() < 1e-15);
  probe.go({Vec3(2, 5, 0)}, 1, 11);
  CHECK((probe.tip(11) - Vec3(2, 0, 0)).norm() < 1e-15);
  CHECK((probe.tip(14) - Vec3(2, 3, 0)).norm() < 1e-14);
}

}  // namespace heml::contact_surface_test
