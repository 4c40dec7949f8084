// Cuts of quadratic tetrahedra: pieces have the field of their element, and one middle an edge.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <functional>
#include <heml/mesh/cut.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/quadratic_edit.hpp>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "support.hpp"

namespace heml::quadratic_edit_test {

namespace {

using Field = std::function<Vec3(const Vec3&)>;

/// A box of irregular quadratic tetrahedra to which cuts are applied.
struct Body {
  TetMesh mesh = make_box(Vec3(0.09, 0.06, 0.06), {3, 2, 2});
  MidEdges midedges;
  std::vector<Vec3> x;
  Topology topology = full_topology(mesh);
  Stroke stroke;

  explicit Body(const Field& field, double curved = 0) {
    std::mt19937_64 random(5);
    for (Vec3& X : mesh.nodes) X += test::random_vector(random, 0.003);
    const std::size_t corners = mesh.nodes.size();
    midedges = heml::add_midedge_nodes(mesh);
    for (std::size_t n = corners; n < mesh.nodes.size(); ++n)
      if (curved > 0) mesh.nodes[n] += test::random_vector(random, curved);
    for (const Vec3& X : mesh.nodes) x.push_back(field(X));
  }

  MeshEdit sweep(const std::vector<std::array<Vec3, 2>>& blades) {
    Cut cut;
    if (!make_cut({blades}, mesh, x, topology, 0.5 * 0.03, stroke, cut).ok()) return {};  // through the air
    stroke = cut.stroke;
    add_midedge_nodes(mesh, midedges, cut.edit);
    topology = apply_edit(topology, cut.edit, static_cast<int>(mesh.tets.size()));
    append(cut.edit, x);
    append(cut.edit, mesh);
    midedges.insert(midedges.end(), cut.edit.midedges.begin(), cut.edit.midedges.end());
    return cut.edit;
  }

  const Vec3& rest(int n) const { return mesh.nodes[static_cast<std::size_t>(n)]; }
  std::array<int, 10> nodes_of(int t) const {
    return quadratic_nodes(mesh.tets[static_cast<std::size_t>(t)], midedges[static_cast<std::size_t>(t)]);
  }
  /// Where an element's map of reference space takes a place in it.
  Vec3 mapped(int t, const std::array<double, 4>& place, const std::vector<Vec3>& values) const {
    Vec3 sum = Vec3::Zero();
    const auto nodes = nodes_of(t);
    const auto at = [&](std::size_t a) -> const Vec3& { return values[static_cast<std::size_t>(nodes[a])]; };
    for (std::size_t i = 0; i < 4; ++i) sum += place[i] * (2 * place[i] - 1) * at(i);
    for (std::size_t e = 0; e < 6; ++e) sum += 4 * place[tet_edges[e][0]] * place[tet_edges[e][1]] * at(4 + e);
    return sum;
  }
  double volume(int t) const {
    const Tet& tet = mesh.tets[static_cast<std::size_t>(t)];
    return signed_volume(rest(tet[0]), rest(tet[1]), rest(tet[2]), rest(tet[3]));
  }
  double volume() const {
    double sum = 0;
    for (const int t : topology.elements) sum += volume(t);
    return sum;
  }
  /// Parts that share no node, middles included.
  int components() const {
    std::vector<int> root(mesh.nodes.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int n) {
      while (root[static_cast<std::size_t>(n)] != n) n = root[static_cast<std::size_t>(n)];
      return n;
    };
    std::set<int> used, parts;
    for (const int t : topology.elements)
      for (const int n : nodes_of(t)) {
        used.insert(n);
        root[static_cast<std::size_t>(find(n))] = find(nodes_of(t)[0]);
      }
    for (const int n : used) parts.insert(find(n));
    return static_cast<int>(parts.size());
  }
};

std::vector<std::array<Vec3, 2>> blade(const std::vector<Vec3>& tips) {
  std::vector<std::array<Vec3, 2>> blades;
  for (const Vec3& tip : tips) blades.push_back({tip - Vec3(0, 0, 1), tip + Vec3(0, 0, 1)});
  return blades;
}

std::vector<std::array<Vec3, 2>> across() { return blade({Vec3(0.041, -1, 0), Vec3(0.052, 1, 0)}); }

/// One middle an edge and one edge a middle, in all elements; middles of straight edges lie in the middle.
void check_middles(const Body& body, bool straight) {
  std::map<std::pair<int, int>, int> middle_of;
  std::map<int, std::pair<int, int>> edge_of;
  for (const int t : body.topology.elements)
    for (std::size_t e = 0; e < 6; ++e) {
      const Tet& tet = body.mesh.tets[static_cast<std::size_t>(t)];
      const std::pair<int, int> edge = std::minmax(tet[tet_edges[e][0]], tet[tet_edges[e][1]]);
      const int middle = body.midedges[static_cast<std::size_t>(t)][e];
      REQUIRE(middle_of.emplace(edge, middle).first->second == middle);
      REQUIRE(edge_of.emplace(middle, edge).first->second == edge);
      if (straight) CHECK((body.rest(middle) - (body.rest(edge.first) + body.rest(edge.second)) / 2).norm() <= 1e-15);
    }
}

}  // namespace

TEST_CASE("a cut of quadratic elements: rigid, affine and quadratic fields are those of before at every new node") {
  std::mt19937_64 random(11);
  const Mat3 turn = test::random_rotation(random), gradient = test::random_gradient(random, 0.7, 1.4);
  std::array<Mat3, 3> bend;
  for (Mat3& part : bend) part = 3 * test::random_gradient(random, 0.7, 1.4);
  const Vec3 shift(0.2, -0.1, 0.3);
  const std::vector<Field> fields = {
      [](const Vec3& X) { return X; }, [&](const Vec3& X) { return Vec3(turn * X + shift); },
      [&](const Vec3& X) { return Vec3(gradient * X + shift); },
      [&](const Vec3& X) {
        return Vec3(X + 0.2 * Vec3(X.dot(bend[0] * X), X.dot(bend[1] * X), X.dot(bend[2] * X)));
      }};
  for (std::size_t k = 0; k < fields.size(); ++k) {
    CAPTURE(k);
    Body body(fields[k]);
    const std::size_t before = body.x.size();
    // Where the blade has to pass depends on the field: through the middle of the body, across its length.
    const Vec3 middle = fields[k](Vec3(0.045, 0.03, 0.03)), ahead = fields[k](Vec3(0.046, 0.03, 0.03)) - middle;
    const Vec3 down = ahead.unitOrthogonal(), along = ahead.cross(down).normalized();
    const MeshEdit edit = body.sweep({{middle - down - along, middle - down + along},
                                      {middle + down - along, middle + down + along}});
    REQUIRE(body.x.size() > before);
    CHECK(edit.midedges.size() == edit.added.size());
    for (std::size_t n = before; n < body.x.size(); ++n)
      CHECK((body.x[n] - fields[k](body.mesh.nodes[n])).norm() <= 2e-15 * (1 + shift.norm()));
    check_middles(body, true);
  }
}

TEST_CASE("a cut of quadratic elements: pieces keep volume, and a cut all through severs") {
  Body body([](const Vec3& X) { return X; });
  const double volume = body.volume();
  REQUIRE(body.components() == 1);
  const MeshEdit edit = body.sweep(across());
  CHECK(body.components() == 2);
  CHECK(body.volume() == doctest::Approx(volume).epsilon(1e-14));
  for (const int t : body.topology.elements) CHECK(body.volume(t) > 0);
  CHECK(count_inverted_points(body.mesh, {{}, {}, edit.added, {}, edit.midedges}) == 0);
  // Crossed edges have lost their middles; all that is new comes last, corners first.
  std::set<int> corners;
  for (const Tet& tet : edit.added) corners.insert(tet.begin(), tet.end());
  const auto old_nodes = static_cast<int>(body.mesh.nodes.size() - edit.nodes.size());
  int last_corner = 0, first_middle = static_cast<int>(body.mesh.nodes.size());
  for (const int n : corners) last_corner = std::max(last_corner, n);
  for (const auto& of_element : edit.midedges)
    for (const int n : of_element)
      if (n >= old_nodes) first_middle = std::min(first_middle, n);
  CHECK(first_middle == last_corner + 1);
}

TEST_CASE("a cut of quadratic elements: half through it opens, and further sweeps of the stroke sever") {
  Body body([](const Vec3& X) { return Vec3(X.x(), X.y() - 2 * X.x() * X.x(), X.z() * (1 + X.x())); });
  const double volume = body.volume();
  const auto at = [](double y) { return Vec3(0.047, y, 0); };
  for (int k = 0; k < 6; ++k) {
    body.sweep(blade({at(0.08 - 0.02 * k), at(0.06 - 0.02 * k)}));
    check_middles(body, true);
    if (k == 2) CHECK(body.components() == 1);
  }
  CHECK(body.components() == 2);
  CHECK(body.volume() == doctest::Approx(volume).epsilon(1e-14));
}

TEST_CASE("the boundary of quadratic elements after edits has four triangles a face, closes, and holds their volume") {
  Body body([](const Vec3& X) { return X; });
  body.sweep(across());
  body.topology.elements.erase(body.topology.elements.begin() + 3, body.topology.elements.begin() + 9);
  const BoundaryFaces fine = fine_boundary(body.mesh, body.midedges, body.topology);
  const BoundaryFaces coarse = extract_boundary(with_elements(body.mesh, body.topology.elements));
  CHECK(fine.triangles.size() == 4 * coarse.triangles.size());
  std::map<std::pair<int, int>, int> balance;
  double enclosed = 0;
  for (std::size_t f = 0; f < fine.triangles.size(); ++f) {
    const auto& [a, b, c] = fine.triangles[f];
    enclosed += body.rest(a).dot(body.rest(b).cross(body.rest(c))) / 6;
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      ++balance[{from, to}];
      --balance[{to, from}];
    }
    const auto nodes = body.nodes_of(body.topology.elements[static_cast<std::size_t>(fine.tets[f])]);
    CHECK(std::find(nodes.begin(), nodes.end(), a) != nodes.end());
  }
  for (const auto& [edge, count] : balance) CHECK(count == 0);
  CHECK(enclosed == doctest::Approx(body.volume()).epsilon(1e-12));
}

TEST_CASE("a cut of curved quadratic elements: a piece lies where the element's map has it, at rest and deformed") {
  Body body([](const Vec3& X) { return Vec3(X.x() + X.y() * X.z(), 1.1 * X.y(), X.z() - X.x() * X.x()); }, 2e-3);
  const MeshEdit edit = body.sweep(across());
  check_middles(body, false);
  std::mt19937_64 random(2);
  const auto old_nodes = static_cast<int>(body.mesh.nodes.size() - edit.nodes.size());
  const int first = static_cast<int>(body.mesh.tets.size() - edit.added.size());
  for (std::size_t k = 0; k < edit.added.size(); ++k) {
    const int piece = first + static_cast<int>(k), whole = edit.parents[k];
    const Tet& parent = body.mesh.tets[static_cast<std::size_t>(whole)];
    std::array<double, 4> in_piece{}, in_whole{};
    for (double& value : in_piece) value = test::uniform(random, 0, 1);
    const double sum = std::accumulate(in_piece.begin(), in_piece.end(), 0.0);
    for (double& value : in_piece) value /= sum;
    const auto add = [&](int n, double weight) {
      in_whole[static_cast<std::size_t>(std::find(parent.begin(), parent.end(), n) - parent.begin())] += weight;
    };
    for (std::size_t c = 0; c < 4; ++c) {
      const int n = edit.added[k][c];
      if (n < old_nodes) {
        add(n, in_piece[c]);
        continue;
      }
      const InsertedNode& node = edit.nodes[static_cast<std::size_t>(n - old_nodes)];
      add(node.from, (1 - node.weight) * in_piece[c]);
      add(node.to, node.weight * in_piece[c]);
    }
    for (const auto* values : {&body.mesh.nodes, &body.x})
      CHECK((body.mapped(piece, in_piece, *values) - body.mapped(whole, in_whole, *values)).norm() <= 1e-15);
  }
}

}  // namespace heml::quadratic_edit_test
