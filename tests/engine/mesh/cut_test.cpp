#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <engine/mesh/strokes.hpp>
#include <heml/mesh/quality.hpp>
#include <set>

namespace heml::cut_test {

namespace {

using Body = test::CutBody;
using test::cube, test::cut_in_parts, test::random_stroke, test::still, test::sway;

/// Area of the boundary at rest, m². Checks that the boundary is closed (every edge traversed equally often in both
/// directions) and that no face has more than two elements.
double closed_area(const Body& body) {
  const std::vector<Tet> all = body.tets();
  const auto counts = face_counts(all, static_cast<int>(body.mesh.nodes.size()));
  std::map<std::pair<int, int>, int> turns;
  double area = 0;
  for (std::size_t t = 0; t < all.size(); ++t)
    for (std::size_t f = 0; f < 4; ++f) {
      CHECK(counts[4 * t + f] <= 2);
      if (counts[4 * t + f] != 1) continue;
      std::array<int, 3> n;
      for (std::size_t k = 0; k < 3; ++k) n[k] = all[t][static_cast<std::size_t>(tet_faces[f][k])];
      for (std::size_t k = 0; k < 3; ++k) {
        const int a = n[k], b = n[(k + 1) % 3];
        turns[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
      }
      const auto at = [&](int node) { return body.mesh.nodes[static_cast<std::size_t>(node)]; };
      area += (at(n[1]) - at(n[0])).cross(at(n[2]) - at(n[0])).norm() / 2;
    }
  for (const auto& [edge, turn] : turns) CHECK(turn == 0);
  return area;
}

/// A blade parallel to z, from z = low to high, that moves from one point of the plane z = 0 to another.
Sweep along(const Vec3& from, const Vec3& to, double low = -1, double high = 2) {
  const Vec3 below(0, 0, low), above(0, 0, high);
  return {{{from + below, from + above}, {to + below, to + above}}};
}

double worst_angle(const Body& body, std::size_t from = 0) {
  double worst = 180;
  for (std::size_t k = from; k < body.topology.elements.size(); ++k) {
    std::array<Vec3, 4> x;
    for (std::size_t a = 0; a < 4; ++a)
      x[a] =
          body.mesh
              .nodes[static_cast<std::size_t>(body.mesh.tets[static_cast<std::size_t>(body.topology.elements[k])][a])];
    worst = std::min(worst, min_dihedral(x));
  }
  return worst;
}

}  // namespace

TEST_CASE("cut: a blade through all of a body makes two, and loses nothing") {
  for (const int cells : {1, 2, 5}) {
    CAPTURE(cells);
    Body body = cube(cells);
    Cut made;
    REQUIRE(body.cut(along(Vec3(-1, 0.43, 0), Vec3(2, 0.52, 0)), made) == "");
    CHECK(body.components() == 2);
    CHECK(std::abs(body.volume() - 1) <= 1e-12);
    for (const Tet& t : body.tets()) CHECK(body.volume(t) > 0);
    const double area = closed_area(body);
    CHECK(area == doctest::Approx(6 + 2 * made.area).epsilon(1e-9));
    CHECK(made.area >= 0.9);
    CHECK(made.area <= 1.3);  // snapping makes the cut uneven
  }
}

TEST_CASE("cut: with hardly any snapping the cut is the plane itself") {
  Body body = cube(4);
  body.snap = 1e-9;
  Cut made;
  REQUIRE(body.cut(along(Vec3(-1, 0.43, 0), Vec3(2, 0.52, 0)), made) == "");
  const double slope = 0.09 / 3;
  CHECK(made.area == doctest::Approx(std::sqrt(1 + slope * slope)).epsilon(1e-9));
  CHECK(body.components() == 2);
  for (const int n : made.stroke.nodes) {
    const Vec3& X = body.mesh.nodes[static_cast<std::size_t>(n)];
    CHECK(std::abs(X.y() - 0.43 - slope * (X.x() + 1)) <= 1e-9);
  }
}

TEST_CASE("cut: a blade that stops inside leaves one body, parted as far as it went") {
  Body body = cube(8);
  Cut made;
  REQUIRE(body.cut(along(Vec3(-1, 0.45, 0), Vec3(0.5, 0.45, 0)), made) == "");
  CHECK(body.components() == 1);
  CHECK(made.area >= 0.35);
  CHECK(made.area <= 0.65);
  CHECK(std::abs(body.volume() - 1) <= 1e-12);
  closed_area(body);
  // Nodes of the slit are duplicated: two at one place.
  int pairs = 0;
  std::set<std::array<int, 2>> places;
  for (const InsertedNode& node : made.edit.nodes)
    pairs += node.from == node.to || !places.insert({node.from, node.to}).second;
  CHECK(pairs > 0);
  // The body is intact beyond the slit's end: no node of the cut lies there.
  for (const int n : made.stroke.nodes)
    CHECK(body.mesh.nodes[static_cast<std::size_t>(n)].x() <= 0.5 + 1.0 / 8 + body.snap);
}

TEST_CASE("cut: lies within the snapping distance of the sweep and leaves no sliver") {
  Body body = cube(6, 3);
  const double before = worst_angle(body);
  Cut made;
  const Sweep sweep{{{Vec3(-0.2, 0.3, -1), Vec3(-0.2, 0.5, 2)},
                     {Vec3(0.5, 0.5, -1), Vec3(0.5, 0.6, 2)},
                     {Vec3(1.2, 0.3, -1), Vec3(1.2, 0.8, 2)}}};
  REQUIRE(body.cut(sweep, made) == "");
  const SweptSurface surface(oriented(sweep));
  for (const int n : made.stroke.nodes)
    CHECK(surface.nearest(body.mesh.nodes[static_cast<std::size_t>(n)]).distance <= body.snap);
  CHECK(body.components() == 2);
  const double after = worst_angle(body);
  MESSAGE("smallest dihedral angle " << before << "° before, " << after << "° after");
  CHECK(after >= 4);
}

TEST_CASE("cut: 200 random sweeps, one after the other, lose nothing and turn nothing inside out") {
  Body body = cube(6, 5);
  const double side = body.snap;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-0.3, 1.3);
  int done = 0;
  double shortest = 1;
  for (int k = 0; k < 200; ++k) {
    CAPTURE(k);
    const auto point = [&] { return Vec3(place(random), place(random), place(random)); };
    Sweep sweep;
    const Vec3 start = point(), way = (point() - start) / 3, blade = 0.4 * (point() - start);
    for (int moment = 0; moment < 4; ++moment)
      sweep.blades.push_back({start + moment * way, start + moment * way + blade});
    done += body.cut(sweep) == "";
    REQUIRE(std::abs(body.volume() - 1) <= 1e-12);
    for (const Tet& t : body.tets()) {
      if (!(body.volume(t) > 0)) FAIL("an element is flat or inside out");
      for (int a = 0; a < 4; ++a)
        for (int b = a + 1; b < 4; ++b)
          shortest = std::min(shortest, (body.mesh.nodes[static_cast<std::size_t>(t[a])] -
                                         body.mesh.nodes[static_cast<std::size_t>(t[b])])
                                            .norm());
    }
  }
  CHECK(done > 100);
  closed_area(body);
  MESSAGE(done << " cuts, " << body.topology.elements.size() << " elements, " << body.components()
               << " pieces, shortest edge " << shortest << " of snapping distance " << side << ", smallest angle "
               << worst_angle(body) << "°");
}

TEST_CASE("cut: a stroke in 2, 10 or 100 sweeps severs what one sweep severs") {
  for (const int cells : {4, 6})
    for (unsigned seed = 1; seed <= 6; ++seed) {
      CAPTURE(cells);
      CAPTURE(seed);
      Body one = cube(cells, seed);
      const double area = cut_in_parts(one, random_stroke(seed), 1, still);
      CHECK(one.components() >= 2);
      for (const int parts : {2, 10, 100}) {
        CAPTURE(parts);
        Body many = cube(cells, seed);
        const double in_parts = cut_in_parts(many, random_stroke(seed), parts, still);
        CHECK(many.components() == one.components());
        CHECK(std::abs(in_parts - area) <= 0.05 * area);  // crossings snap otherwise where a sweep ends
        CHECK(std::abs(many.volume() - 1) <= 1e-12);
        CHECK(closed_area(many) == doctest::Approx(6 + 2 * in_parts).epsilon(1e-9));
      }
    }
}

TEST_CASE("cut: a stroke goes on at its front in the tissue, which moves between the sweeps, by little or by a lot") {
  for (const int cells : {4, 5, 6})
    for (unsigned seed = 1; seed <= 12; ++seed)
      for (const int parts : {2, 4, 10, 20, 100}) {
        CAPTURE(cells);
        CAPTURE(seed);
        CAPTURE(parts);
        Body body = cube(cells, seed);
        cut_in_parts(body, random_stroke(seed), parts, sway);
        CHECK(body.components() == 2);
        CHECK(std::abs(body.volume() - 1) <= 1e-12);
        closed_area(body);
      }
}

TEST_CASE("cut: tissue that swings upon a blade beside it is cut from its surface on") {
  Body body = cube(5);
  const Sweep beside = along(Vec3(-0.3, 0.5, 0), Vec3(-0.05, 0.5, 0));
  Stroke stroke;
  stroke.front = BladeFront(beside.blades.back(), body.mesh, body.x, body.topology);
  CHECK_FALSE(stroke.front.in_tissue());
  for (Vec3& x : body.x) x.x() -= 0.3;
  Cut made;
  REQUIRE(body.cut(along(Vec3(-0.05, 0.5, 0), Vec3(1.1, 0.5, 0)), made, stroke) == "");
  CHECK(body.components() == 2);
}

TEST_CASE("cut: a blade in the air cuts nothing where tissue beside it swings away and other tissue stays") {
  Body body = cube(5);
  const Sweep beside = along(Vec3(-0.3, 0.5, 0), Vec3(-0.05, 0.5, 0));
  Stroke stroke;
  stroke.front = BladeFront(beside.blades.back(), body.mesh, body.x, body.topology);
  for (Vec3& x : body.x) x.x() += 0.3 * (1 - x.z());
  Cut made;
  CHECK(body.cut(along(Vec3(-0.05, 0.5, 0), Vec3(-0.2, 0.5, 0)), made, stroke).find("meets no edge") !=
        std::string::npos);
}

TEST_CASE("cut: a stroke in parts that stops inside leaves one body") {
  Body body = cube(6);
  Sweep stroke = random_stroke(1);
  for (std::size_t k = 51; k < stroke.blades.size(); ++k) stroke.blades[k] = stroke.blades[50];
  const double area = cut_in_parts(body, stroke, 50, still);
  CHECK(body.components() == 1);
  CHECK(area > 0.2);
}

TEST_CASE("cut: a deformed body is cut where it is, and splits are the same at rest") {
  Body body = cube(5);
  for (Vec3& x : body.x) x = Vec3(x.x() + 0.3 * x.y() * x.y(), 1.5 * x.y(), x.z()) + Vec3(10, 0, 0);
  Cut made;
  REQUIRE(body.cut(along(Vec3(9, 0.7, 0), Vec3(12, 0.7, 0)), made) == "");
  CHECK(body.components() == 2);
  CHECK(std::abs(body.volume() - 1) <= 1e-12);
  for (const int n : made.stroke.nodes) {
    const auto k = static_cast<std::size_t>(n);
    CHECK(std::abs(body.mesh.nodes[k].y() - 0.7 / 1.5) <= body.snap);
    CHECK(std::abs(body.x[k].y() - 0.7) <= 2 * body.snap);
  }
}

TEST_CASE("cut: a sweep that misses the body, or has no area, is refused with a message") {
  Body body = cube(2);
  CHECK(body.cut(along(Vec3(3, 0, 0), Vec3(3, 1, 0))).find("meets no edge") != std::string::npos);
  CHECK(body.cut(along(Vec3(0, 0, 0), Vec3(0, 0, 0))).find("sweeps no area") != std::string::npos);
  CHECK(body.cut({{{Vec3::Zero(), Vec3::Ones()}}}).find("sweeps no area") != std::string::npos);
  CHECK(body.cut({}).find("sweeps no area") != std::string::npos);
}

}  // namespace heml::cut_test
