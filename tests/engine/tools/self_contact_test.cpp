// Which pairs of a soup of tetrahedra meet, against a search of all pairs by the definition in self_contact.hpp.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <heml/mesh/generate.hpp>
#include <heml/tools/self_contact.hpp>
#include <set>

#include "engine/tools/small_tets.hpp"

namespace heml::self_contact_test {

using namespace heml::test;

namespace {

using Places = std::vector<Vec3>;
using Key = std::array<int, 5>;  ///< the nodes of a pair, those of a face and of an edge ascending; whether of edges

Key key_of(const ContactPair& pair) {
  auto nodes = pair.nodes;
  if (pair.side == 0) {
    std::sort(nodes.begin() + 1, nodes.end());
  } else {
    std::sort(nodes.begin(), nodes.begin() + 2);
    std::sort(nodes.begin() + 2, nodes.end());
    if (nodes[2] < nodes[0]) nodes = {nodes[2], nodes[3], nodes[0], nodes[1]};
  }
  return {nodes[0], nodes[1], nodes[2], nodes[3], pair.side == 0 ? 0 : 1};
}

/// What of a condition is known: that it holds, that it does not; or it is too near its threshold to tell.
enum class Sure { no, maybe, yes };
Sure above(double value, double threshold, double margin) {
  return value > threshold + margin ? Sure::yes : value < threshold - margin ? Sure::no : Sure::maybe;
}
Sure all_of(std::initializer_list<Sure> conditions) { return std::min(conditions); }

/// Tetrahedra of edge 1 that move as they are: gaps are linear in time, and directions do not change.
struct Soup {
  TetMesh mesh;
  Places from, to;

  Soup(std::mt19937_64& random, int count, double size) {
    for (int t = 0; t < count; ++t) {
      const Mat3 R = random_rotation(random);
      const Vec3 far(4.0 * t, 0, 0), place = random_vector(random, size);
      std::array<Vec3, 4> corners = regular_tet(R);
      for (Vec3& X : corners) X += far;
      add_tet(mesh, corners);  // apart at rest: no initial overlap is ignored
      for (const Vec3& X : corners) from.push_back(X - far + place);
    }
    to = from;
  }

  void move(std::mt19937_64& random, double by) {
    from = to;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      const Vec3 displacement = random_vector(random, by);
      for (std::size_t k = 4 * t; k < 4 * t + 4; ++k) to[k] = from[k] + displacement;
    }
  }

  Vec3 centre(std::size_t t) const { return (from[4 * t] + from[4 * t + 1] + from[4 * t + 2] + from[4 * t + 3]) / 4; }
  Vec3 displacement(std::size_t t) const { return to[4 * t] - from[4 * t]; }
};

constexpr double height = 0.816496580927726;  // of a regular tetrahedron, √(2/3)

/// Whether a gap closes or is closed, and at which part of the way.
Sure closes(double first, double last, double& part) {
  part = first <= 0 ? 0 : last >= 0 ? (last < first ? 1 : 0) : first / (first - last);
  if (std::abs(first) < 0.003 || std::abs(last) < 0.003) return Sure::maybe;  // touching
  return std::min(first, last) < 0 ? Sure::yes : Sure::no;
}

/// Node `n` of tetrahedron A and the face of B opposite to its corner `apex`.
Sure node_meets_face(const Soup& soup, std::size_t A, std::size_t n, std::size_t B, std::size_t apex) {
  std::array<Vec3, 3> x;
  for (std::size_t k = 0, c = 0; c < 4; ++c)
    if (c != apex) x[k++] = soup.from[4 * B + c];
  Vec3 normal = (x[1] - x[0]).cross(x[2] - x[0]).normalized();
  if (normal.dot(soup.from[4 * B + apex] - x[0]) > 0) normal = -normal;
  const Vec3 r = soup.from[4 * A + n] - x[0], moves = soup.displacement(A) - soup.displacement(B);
  double part = 0;
  const double first = normal.dot(r), last = first + normal.dot(moves);
  const Sure near = closes(first, last, part);
  // Its three areas by the corners of the face, of the point where the gap closes.
  const Vec3 p = soup.from[4 * A + n] + part * moves;
  double least = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = x[(i + 1) % 3], &b = x[(i + 2) % 3];
    const Vec3 inwards = normal.cross(b - a).normalized();
    least = std::min(least, inwards.dot(p - a) / inwards.dot(x[i] - a));
  }
  // The mean of the three faces' normals round a corner of a regular tetrahedron points from its centre.
  const double facing = -normal.dot((soup.from[4 * A + n] - soup.centre(A)).normalized());
  return all_of({near, above(least, 0, 0.02), above(facing, 0.1, 0.01), above(height / 2, -first, 0.005)});
}

/// Whether a direction points out of the edge a, b of a body, between the normals of its two faces, at which c and d
/// are the opposite corners.
Sure is_out(const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = (b - a).normalized(), to_c = c - a - u.dot(c - a) * u, to_d = d - a - u.dot(d - a) * u;
  return all_of({above(-direction.dot(to_c.normalized()), 0, 0.04), above(-direction.dot(to_d.normalized()), 0, 0.04)});
}

/// The edges of corners i, j of A and k, l of B.
Sure edges_meet(const Soup& soup, std::size_t A, std::size_t i, std::size_t j, std::size_t B, std::size_t k,
                std::size_t l) {
  const auto others = [](std::size_t a, std::size_t b) {
    std::array<std::size_t, 2> rest{};
    for (std::size_t c = 0, n = 0; c < 4; ++c)
      if (c != a && c != b) rest[n++] = c;
    return rest;
  };
  const auto a = [&](std::size_t c) -> const Vec3& { return soup.from[4 * A + c]; };
  const auto b = [&](std::size_t c) -> const Vec3& { return soup.from[4 * B + c]; };
  const Vec3 u = a(j) - a(i), v = b(l) - b(k), moves = soup.displacement(A) - soup.displacement(B);
  const double sine = u.cross(v).norm();  // edges of 1
  if (sine < 0.05) return Sure::no;
  // Out of B: away from its centre, as seen from the middle of its edge.
  Vec3 normal = u.cross(v) / sine;
  if (normal.dot((b(k) + b(l)) / 2 - soup.centre(B)) < 0) normal = -normal;
  const double first = normal.dot(a(i) - b(k)), last = first + normal.dot(moves);
  double part = 0;
  const Sure near = closes(first, last, part);
  // Where the two lines pass: a(i) + s u and b(k) + t v, seen along the normal.
  const Vec3 r = b(k) - a(i) - part * moves, across_u = normal.cross(u), across_v = normal.cross(v);
  const double s = across_v.dot(r) / across_v.dot(u), t = -across_u.dot(r) / across_u.dot(v);
  const double within = std::min({s, 1 - s, t, 1 - t});
  const auto [c, d] = others(i, j);
  const auto [e, f] = others(k, l);
  return all_of({near, above(within, 0, 0.02), above(sine, 0.3, 0.01), is_out(-normal, a(i), a(j), a(c), a(d)),
                 is_out(normal, b(k), b(l), b(e), b(f)), above(height / 2, -first, 0.005)});
}

struct Expected {
  std::set<Key> sure, possible;
};

Expected search_all(const Soup& soup) {
  Expected all;
  const auto note = [&](Sure sure, const ContactPair& pair) {
    if (sure == Sure::yes) all.sure.insert(key_of(pair));
    if (sure != Sure::no) all.possible.insert(key_of(pair));
  };
  const auto number = [](std::size_t t, std::size_t c) { return static_cast<int>(4 * t + c); };
  for (std::size_t A = 0; A < soup.mesh.tets.size(); ++A)
    for (std::size_t B = 0; B < soup.mesh.tets.size(); ++B) {
      if (A == B) continue;
      for (std::size_t n = 0; n < 4; ++n)
        for (std::size_t apex = 0; apex < 4; ++apex)
          note(node_meets_face(soup, A, n, B, apex),
               {{number(A, n), number(B, (apex + 1) % 4), number(B, (apex + 2) % 4), number(B, (apex + 3) % 4)}, 0});
      if (A > B) continue;
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j)
          for (std::size_t k = 0; k < 4; ++k)
            for (std::size_t l = k + 1; l < 4; ++l)
              note(edges_meet(soup, A, i, j, B, k, l), {{number(A, i), number(A, j), number(B, k), number(B, l)}, 1});
    }
  return all;
}

struct Counts {
  int faces = 0, edges = 0;
};

/// Checks one step of the soup.
void compare(SelfContact& contact, const Soup& soup, Counts& counts) {
  const auto place = [](const Places& x) { return [&x](int n) { return x[static_cast<std::size_t>(n)]; }; };
  const auto& pairs = contact.contacts_between(place(soup.from), place(soup.to));
  CHECK(std::is_sorted(pairs.begin(), pairs.end()));
  std::set<Key> found;
  for (const ContactPair& pair : pairs) found.insert(key_of(pair));
  CHECK(found.size() == pairs.size());
  REQUIRE(contact.contact_points().size() == pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto point = point_of(pairs[i], place(soup.from));
    const ContactPoint& given = contact.contact_points()[i];
    REQUIRE(point);
    CHECK(given.nodes == pairs[i].nodes);
    CHECK(given.weights == point->weights);
    CHECK(given.gap == point->gap);
    CHECK(given.normal == point->normal);
  }
  const Expected expected = search_all(soup);
  CHECK(std::includes(found.begin(), found.end(), expected.sure.begin(), expected.sure.end()));
  CHECK(std::includes(expected.possible.begin(), expected.possible.end(), found.begin(), found.end()));
  for (const Key& key : expected.sure) ++(key[4] == 0 ? counts.faces : counts.edges);
}

/// Two bodies as one mesh.
TetMesh together(TetMesh mesh, const TetMesh& other) {
  for (Tet tet : other.tets) {
    for (int& n : tet) n += static_cast<int>(mesh.nodes.size());
    mesh.tets.push_back(tet);
  }
  mesh.nodes.insert(mesh.nodes.end(), other.nodes.begin(), other.nodes.end());
  mesh.regions.assign(mesh.tets.size(), 0);
  return mesh;
}

/// A search that is kept from step to step, and one from nothing in each.
struct KeptAndNew {
  const TetMesh& mesh;
  SelfContact kept{{}, mesh};
  std::size_t met = 0, changes = 0, last = 0;

  explicit KeptAndNew(const TetMesh& of) : mesh(of) {}
  template <class From, class To>
  void compare(const From& from, const To& to) {
    SelfContact anew({}, mesh);
    const std::vector<ContactPair> expected = anew.contacts_between(from, to);
    CHECK(kept.contacts_between(from, to) == expected);
    met += expected.size();
    changes += expected.size() != last;
    last = expected.size();
  }
};

}  // namespace

TEST_CASE("of tetrahedra thrown about those pairs meet that a search of all pairs finds") {
  Counts counts;
  for (unsigned seed = 0; seed < 10; ++seed) {
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    Soup soup(random, 40, 1.8);
    soup.move(random, uniform(random, 0.05, 1));
    SelfContact contact({}, soup.mesh);
    compare(contact, soup, counts);
  }
  CHECK(counts.faces > 200);
  CHECK(counts.edges > 200);
}

TEST_CASE("edges whose bodies turn their backs on each other at rest meet when one is brought round") {
  Counts counts;
  for (const unsigned seed : {97u, 203u, 246u, 255u}) {
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    Soup soup(random, 40, 1.8);
    soup.move(random, uniform(random, 0.1, 1.5));
    SelfContact contact({}, soup.mesh);
    compare(contact, soup, counts);
  }
}

TEST_CASE("candidates kept from earlier steps miss no pair, and are kept for some steps") {
  Counts counts;
  std::mt19937_64 random(99);
  Soup soup(random, 40, 1.8);
  SelfContact contact({}, soup.mesh);
  for (int step = 0; step < 60; ++step) {
    CAPTURE(step);
    soup.move(random, step < 40 ? 0.02 : 0.05);
    compare(contact, soup, counts);
  }
  CHECK(contact.broad_phase_count() > 1);
  CHECK(contact.broad_phase_count() < 30);
  CHECK(counts.faces > 100);
  CHECK(counts.edges > 100);
}

TEST_CASE("no pair is missed where a part moves fast, bodies are drawn over each other, and what is slow is struck") {
  const TetMesh lower = make_box(Vec3(6, 2, 3), {6, 2, 3});
  const TetMesh mesh = together(lower, make_box(Vec3(4, 2, 3), {3, 2, 2}, Vec3(0.3, 2.02, 0.2)));
  const auto lower_nodes = static_cast<int>(lower.nodes.size());
  KeptAndNew both(mesh);
  // The upper box slides to and fro and down; one end of the lower one swings, at first for itself, and then strikes.
  const auto place = [&](int n, double t) -> Vec3 {
    Vec3 x = mesh.nodes[static_cast<std::size_t>(n)];
    if (n >= lower_nodes) return x + Vec3(std::sin(t), 0.03 * std::cos(3 * t) - 0.02, 0.3 * t);
    const double swing = std::max(0.0, x.x() - 3);
    return x + Vec3(0, 0.02 * swing * swing * std::sin(5 * t), 0);
  };
  for (int step = 0; step < 300; ++step) {
    CAPTURE(step);
    const double t = 0.01 * step, h = step % 50 < 40 ? 0.01 : 0.002;
    const auto at_from = [&](int n) { return place(n, t); };
    const auto at_to = [&](int n) { return place(n, t + h); };
    both.compare(at_from, at_to);
  }
  CHECK(both.met > 2000);
  CHECK(both.changes > 30);
  CHECK(both.kept.broad_phase_count() < 100);
}

TEST_CASE("pairs that sleep by what is certain are those that a new search rejects, on flat surfaces that tremble") {
  const TetMesh mesh =
      together(make_box(Vec3(3, 3, 3), {3, 3, 3}), make_box(Vec3(3, 2, 3), {2, 2, 3}, Vec3(0.3, 3, 0.2)));
  std::mt19937_64 random(17);
  KeptAndNew both(mesh);
  for (int step = 0; step < 400; ++step) {
    CAPTURE(step);
    // Bends of up to twice the sine of a ridge; from step to step far less.
    const double phase = 0.01 * step, tremor = step % 100 < 80 ? 1e-4 : 1e-2;
    std::vector<Vec3> from = mesh.nodes, to;
    for (Vec3& x : from) x.y() += 0.04 * std::sin(2.1 * x.x() + phase) * std::cos(1.7 * x.z() - 2 * phase);
    for (Vec3& x : from) x += random_vector(random, tremor);
    for (const Vec3& x : from) to.push_back(x + random_vector(random, 10 * tremor));
    const auto at_from = [&](int n) { return from[static_cast<std::size_t>(n)]; };
    const auto at_to = [&](int n) { return to[static_cast<std::size_t>(n)]; };
    both.compare(at_from, at_to);
  }
  CHECK(both.met > 4000);
  CHECK(both.changes > 50);
}

TEST_CASE("edges that bore a load stay in contact while their bend is not clearly gone") {
  // Two roofs, ridge across ridge; the lower one's ridge sinks until it is a valley.
  TetMesh mesh;
  add_tet(mesh, {Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, -1, -0.3), Vec3(0, 1, -0.3)});
  add_tet(mesh, {Vec3(0, -2, 0), Vec3(0, 2, 0), Vec3(1, 0, 0.3), Vec3(-1, 0, 0.3)});
  const auto place = [&](double bend) {
    return [&mesh, bend](int n) -> Vec3 {
      Vec3 x = mesh.nodes[static_cast<std::size_t>(n)];
      if (n == 2 || n == 3) x.z() = -bend;
      return x;
    };
  };
  SelfContact contact({}, mesh);
  const std::vector<ContactPair> borne = contact.contacts_between(place(0.3), place(0.3));
  REQUIRE(borne.size() == 1);
  REQUIRE(borne[0].side != 0);
  for (const double bend : {0.012, 0.005}) {
    CHECK(contact.contacts_between(place(bend), place(bend)).empty());
    CHECK(contact.contacts_between(place(bend), place(bend), borne) == borne);
  }
  const auto& sunk = contact.contacts_between(place(-0.05), place(-0.05), borne);
  CHECK(std::find(sunk.begin(), sunk.end(), borne[0]) == sunk.end());
}

TEST_CASE("a pair that touches within its face is in contact, one that touches the face's plane outside is not") {
  TetMesh mesh;
  add_tet(mesh, {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0), Vec3(0, 0, -2)});
  add_tet(mesh, {Vec3(0, 0, 3), Vec3(-1, -1, 5), Vec3(1, -1, 5), Vec3(0, 1, 5)});
  for (const double y : {0.5, 1.1})
    for (const double gap : {1e-4, -1e-4}) {
      CAPTURE(y);
      CAPTURE(gap);
      SelfContact contact({}, mesh);
      const auto place = [&](int n) -> Vec3 {
        return mesh.nodes[static_cast<std::size_t>(n)] + (n < 4 ? Vec3(0, 0, 0) : Vec3(0, y, gap - 3));
      };
      CHECK(contact.contacts_between(place, place).size() == (y < 1 ? 1 : 0));
    }
}

TEST_CASE("a face that bore a load stays in contact while the node is just beside it") {
  TetMesh mesh;
  add_tet(mesh, {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0), Vec3(0, 0, -2)});
  add_tet(mesh, {Vec3(0, 0, 3), Vec3(-1, -1, 5), Vec3(1, -1, 5), Vec3(0, 1, 5)});
  const auto place = [&mesh](double y, double gap) {
    return [&mesh, y, gap](int n) -> Vec3 {
      return mesh.nodes[static_cast<std::size_t>(n)] + (n < 4 ? Vec3(0, 0, 0) : Vec3(0, y, gap - 3));
    };
  };
  SelfContact contact({}, mesh);
  const std::vector<ContactPair> borne = contact.contacts_between(place(0.5, -1e-4), place(0.5, -1e-4));
  REQUIRE(borne.size() == 1);
  REQUIRE(borne[0].side == 0);
  CHECK(contact.contacts_between(place(1.1, -1e-4), place(1.1, -1e-4)).empty());
  CHECK(contact.contacts_between(place(1.1, -1e-4), place(1.1, -1e-4), borne) == borne);
  CHECK(contact.contacts_between(place(1.5, -1e-4), place(1.5, -1e-4), borne).empty());  // clearly outside
  CHECK(contact.contacts_between(place(1.1, 0.1), place(1.1, 0.1), borne).empty());      // gone up
}

TEST_CASE("long steps are searched along the way of each node, once while it ends near there") {
  Counts counts;
  std::mt19937_64 random(33);
  Soup soup(random, 40, 1.8);
  SelfContact contact({}, soup.mesh);
  for (int step = 0; step < 30; ++step) {
    CAPTURE(step);
    soup.move(random, step % 3 == 0 ? 0.02 : 0.8);
    compare(contact, soup, counts);
    const long sweeps = contact.sweep_count();
    const Places far = soup.to;
    for (const double part : {0.9, 0.5, 0.2}) {  // as a solver that finds what stops them
      for (std::size_t n = 0; n < far.size(); ++n) soup.to[n] = soup.from[n] + part * (far[n] - soup.from[n]);
      compare(contact, soup, counts);
    }
    CHECK(contact.sweep_count() == sweeps);
    if (step % 3 != 0) {  // another start within the boxes, where other faces may face each other
      soup.from = soup.to;
      soup.to = far;
      compare(contact, soup, counts);
      CHECK(contact.sweep_count() == sweeps + 1);
    }
    soup.to = far;
  }
  CHECK(contact.sweep_count() == 40);
  CHECK(counts.faces > 500);
  CHECK(counts.edges > 500);
}

TEST_CASE("a body of which one node flies away is searched in the time of its pairs") {
  const TetMesh mesh = make_box(Vec3(1, 1, 1), {12, 12, 12});
  const auto at_rest = [&](int n) { return mesh.nodes[static_cast<std::size_t>(n)]; };
  SelfContact contact({}, mesh);
  contact.contacts_between(at_rest, [&](int n) { return (at_rest(n) + Vec3(0, 0, n == 0 ? -1e12 : 0)).eval(); });
  CHECK(contact.sweep_count() == 1);
  CHECK(contact.tested_count() < 10000);
}

TEST_CASE("tetrahedra at rest are searched once, and only near pairs are tested") {
  std::mt19937_64 random(8);
  Soup soup(random, 30, 1.6);
  SelfContact contact({}, soup.mesh);
  const auto place = [&](int n) { return soup.from[static_cast<std::size_t>(n)]; };
  contact.contacts_between(place, place);
  const long tested = contact.tested_count();
  for (int step = 1; step < 50; ++step) contact.contacts_between(place, place);
  CHECK(contact.broad_phase_count() == 1);
  CHECK(contact.filter_count() == 1);
  CHECK(contact.tested_count() == 50 * tested);
  SelfContact moving({}, soup.mesh);  // the same pairs with a motion that wakes more
  moving.contacts_between(place, [&](int n) { return (place(n) + Vec3(n % 2 ? 0.1 : 0, 0, 0)).eval(); });
  CHECK(tested < moving.tested_count() / 2);
}

TEST_CASE("pairs that overlap at rest are ignored, however they move after") {
  std::mt19937_64 random(3);
  TetMesh mesh;
  add_tet(mesh, regular_tet());
  std::array<Vec3, 4> moved = regular_tet();
  for (Vec3& X : moved) X += Vec3(0.02, 0.01, -0.03);
  add_tet(mesh, moved);
  SelfContact contact({}, mesh);
  const auto at = [&](double by) {
    return [&mesh, by](int n) -> Vec3 {
      return mesh.nodes[static_cast<std::size_t>(n)] + (n < 4 ? by : 0) * Vec3::UnitZ();
    };
  };
  CHECK(contact.contacts_between(at(0), at(0.01)).empty());
  CHECK(contact.contacts_between(at(0.01), at(-0.02)).empty());
}

TEST_CASE("places that are no numbers make no pairs") {
  TetMesh mesh;
  add_tet(mesh, regular_tet());
  SelfContact contact({}, mesh);
  const auto nan = [](int) -> Vec3 { return Vec3::Constant(std::nan("")); };
  CHECK(contact.contacts_between(nan, nan).empty());
}

TEST_CASE("tissue thrown out of the range of numbers meets nothing, and meets again once it is back") {
  TetMesh mesh;
  add_tet(mesh, {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0), Vec3(0, 0, -2)});
  add_tet(mesh, {Vec3(0, -0.2, 0.5), Vec3(-1, -1, 2.5), Vec3(1, -1, 2.5), Vec3(0, 1, 2.5)});
  SelfContact contact({}, mesh);
  const auto at = [&](double by) {
    return [&mesh, by](int n) -> Vec3 {
      return mesh.nodes[static_cast<std::size_t>(n)] - (n < 4 ? 0 : by) * Vec3::UnitZ();
    };
  };
  CHECK(contact.contacts_between(at(0), at(1e300)).empty());
  CHECK(contact.contacts_between(at(0), at(0.6)).size() == 1);
}

TEST_CASE("the gap of a node and a face, and of two edges, is that along their common normal") {
  const std::array<Vec3, 4> face = {Vec3(0.2, 0.3, 0.7), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const auto above = point_of(ContactPair{{0, 1, 2, 3}, 0}, face);
  REQUIRE(above);
  CHECK(above->gap == doctest::Approx(0.7));
  CHECK((above->normal - Vec3::UnitZ()).norm() < 1e-15);
  const std::array<double, 4> weights = {1, -0.5, -0.2, -0.3};
  for (std::size_t k = 0; k < 4; ++k) CHECK(above->weights[k] == doctest::Approx(weights[k]));

  const std::array<Vec3, 4> edges = {Vec3(-1, 0, 0.4), Vec3(3, 0, 0.4), Vec3(0, -2, 0), Vec3(0, 8, 0)};
  for (const int side : {1, -1}) {
    const auto across = point_of(ContactPair{{0, 1, 2, 3}, side}, edges);
    REQUIRE(across);
    CHECK(across->gap == doctest::Approx(side * 0.4));
    CHECK((across->normal - side * Vec3::UnitZ()).norm() < 1e-15);
    const std::array<double, 4> parts = {0.75, 0.25, -0.8, -0.2};
    for (std::size_t k = 0; k < 4; ++k) CHECK(across->weights[k] == doctest::Approx(parts[k]));
  }
  CHECK_FALSE(point_of(ContactPair{{0, 1, 2, 3}, 1}, {Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(0, 0, 0), Vec3(2, 0, 0)}));
  CHECK_FALSE(point_of(ContactPair{{0, 1, 2, 3}, 0}, {Vec3(0, 0, 1), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)}));
}

TEST_CASE("the slope of a gap by its nodes is the normal times their weights, which have no sum") {
  std::mt19937_64 random(5);
  for (int k = 0; k < 60; ++k) {
    std::array<Vec3, 4> x;
    for (Vec3& place : x) place = random_vector(random, 1);
    const ContactPair pair{{0, 1, 2, 3}, k % 3 - 1};
    const auto point = point_of(pair, x);
    if (!point) continue;
    double sum = 0;
    for (std::size_t n = 0; n < 4; ++n) {
      sum += point->weights[n];
      for (int i = 0; i < 3; ++i) {
        const auto gap = [&](double by) {
          auto moved = x;
          moved[n][i] += by;
          return point_of(pair, moved)->gap;
        };
        const double by = 1e-5, slope = (8 * (gap(by) - gap(-by)) - (gap(2 * by) - gap(-2 * by))) / (12 * by);
        const double scale = 1 + std::abs(point->weights[n]);
        CHECK(std::abs(slope - point->weights[n] * point->normal[i]) < 1e-6 * scale * scale);
      }
    }
    CHECK(std::abs(sum) < 1e-9);
  }
}

}  // namespace heml::self_contact_test
