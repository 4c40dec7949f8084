#include <doctest/doctest.h>

#include <heml/session/remaining_skin.hpp>
#include <heml/session/skin_cutter.hpp>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "skinned_body.hpp"

namespace heml::skin_cutter_test {
namespace {

using namespace heml::test;

/// Of each node of the mesh: the number of its piece of the body.
std::vector<int> pieces_of(const World& world) {
  const TetMesh& mesh = world.setup().mesh;
  std::vector<int> piece(mesh.nodes.size());
  std::iota(piece.begin(), piece.end(), 0);
  const auto root = [&](int n) {
    while (piece[static_cast<std::size_t>(n)] != n) n = piece[static_cast<std::size_t>(n)];
    return n;
  };
  for (const int t : world.topology()->elements)
    for (const int n : mesh.tets[static_cast<std::size_t>(t)])
      piece[static_cast<std::size_t>(root(n))] = root(mesh.tets[static_cast<std::size_t>(t)][0]);
  std::vector<int> result;
  for (std::size_t n = 0; n < piece.size(); ++n) result.push_back(root(static_cast<int>(n)));
  return result;
}

/// The skin after its pieces have moved apart by 1 m a piece.
TriangleMesh moved_apart(const SkinnedBody& body, const Skin& skin) {
  const std::vector<int> piece = pieces_of(*body.world);
  std::map<int, float> number;
  std::vector<Vec3f> nodes;
  for (std::size_t n = 0; n < piece.size(); ++n) {
    number.try_emplace(piece[n], static_cast<float>(number.size()));
    nodes.push_back(body.world->setup().mesh.nodes[n].cast<float>() + Vec3f(number[piece[n]], 0, 0));
  }
  TriangleMesh moved{{}, skin.surface.mesh.triangles, ""};
  for (std::size_t v = 0; v < skin.surface.mesh.nodes.size(); ++v)
    moved.nodes.push_back(skin.embedding.at<Vec3f>(v, nodes).cast<double>());
  return moved;
}

double longest_edge(const TriangleMesh& surface) {
  double longest = 0;
  for (const Triangle& t : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      longest = std::max(longest, (surface.nodes[static_cast<std::size_t>(t[k])] -
                                   surface.nodes[static_cast<std::size_t>(t[(k + 1) % 3])])
                                      .norm());
  return longest;
}

/// The part of the skin's area, without strips, that hangs on another piece of the body than the one below it.
double astray(const SkinnedBody& body, const Skin& skin, double above) {
  const std::vector<int> piece = pieces_of(*body.world);
  const TetMesh& mesh = body.world->setup().mesh;
  const auto surface = body.surface();
  const OriginalSkin original(*surface);
  const RemainingSkin left(*surface, original);
  double wrong = 0, sum = 0;
  for (const Triangle& t : skin.surface.mesh.triangles) {
    std::array<Vec3, 3> x;
    double lowest = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = skin.surface.mesh.nodes[static_cast<std::size_t>(t[k])];
      lowest = std::min(lowest, std::max(-x[k].minCoeff(), (x[k] - Vec3::Constant(SkinnedBody::side)).maxCoeff()));
    }
    if (lowest < above / 2) continue;  // a strip
    const double size = (x[1] - x[0]).cross(x[2] - x[0]).norm() / 2;
    const int tile = left.at(original.tree().nearest((x[0] + x[1] + x[2]) / 3).point);
    REQUIRE(tile >= 0);
    const Tet& below = mesh.tets[static_cast<std::size_t>(surface->elements[left.face(tile)])];
    sum += size;
    for (const int n : t) {
      const int hangs_on = skin.embedding.nodes[static_cast<std::size_t>(n)][0];
      if (piece[static_cast<std::size_t>(hangs_on)] != piece[static_cast<std::size_t>(below[0])]) wrong += size / 3;
    }
  }
  return wrong / sum;
}

void check_arrays(const Skin& skin) {
  const std::size_t vertices = skin.surface.mesh.nodes.size();
  CHECK(skin.embedding.size() == vertices);
  CHECK(skin.embedding.weights.size() == vertices);
  CHECK(skin.embedding.tets.size() == vertices);
  CHECK(skin.anchors.size() == vertices);
  CHECK(skin.same.size() == vertices);
  for (const Triangle& t : skin.surface.mesh.triangles)
    for (const int n : t) CHECK(static_cast<std::size_t>(n) < vertices);
}

}  // namespace

TEST_CASE("a severed skin comes apart with its body: no triangle spans the cut") {
  for (const double above : {0.0, 0.001, 0.004}) {
    SkinnedBody body(above);
    body.sever(0.033, 0.051);
    const auto cut = body.cut();
    check_arrays(*cut);
    const TriangleMesh moved = moved_apart(body, *cut);
    CHECK(moved.triangles.size() > body.skin->surface.mesh.triangles.size());
    CHECK(longest_edge(moved) < 2 * longest_edge(body.skin->surface.mesh));  // strips included
    CHECK(astray(body, *cut, above) < 0.002 + above);                        // curtains lean at edges of the box
    // The body's two pieces, and the skin's.
    std::set<bool> halves;
    for (const Vec3& x : moved.nodes) halves.insert(x.x() > 0.5);
    CHECK(halves.size() == 2);
  }
}

TEST_CASE("cuts at random that cross each other leave no triangle across them") {
  std::mt19937 random(11);
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int round = 0; round < 12; ++round) {
    SkinnedBody body(round % 2 == 0 ? 0.001 : 0);
    for (int cut = 0; cut < 3; ++cut) {
      const Vec3 normal = Vec3(number(-1, 1), number(-1, 1), number(-1, 1)).normalized();
      const Vec3 along = normal.unitOrthogonal(), across = normal.cross(along);
      const Vec3 middle(number(0.03, 0.05), number(0.03, 0.05), number(0.03, 0.05));
      const double reach = 0.1;
      const Vec3 a = middle - reach * along - reach * across, b = middle + reach * along - reach * across;
      body.apply(CutTissue{{{{a, a + 2 * reach * across}, {b, b + 2 * reach * across}}}, false});
    }
    const auto cut = body.cut();
    check_arrays(*cut);
    CHECK(astray(body, *cut, round % 2 == 0 ? 0.001 : 0) < 0.01);
    CHECK(longest_edge(moved_apart(body, *cut)) < 2 * longest_edge(body.skin->surface.mesh));
    const double before = area(body.skin->surface.mesh), after = area(cut->surface.mesh);
    CHECK(after > 0.995 * before);
    CHECK(after < 1.1 * before);
  }
}

TEST_CASE("a skin that is the body's own surface, cut through its very nodes, comes apart too") {
  for (const int cells : {6, 12}) {
    SkinnedBody fresh(0);
    fresh.take(SkinnedBody::shell(SkinnedBody::side, cells));
    const double plane = SkinnedBody::side / 2;
    fresh.sever(plane, plane);
    const auto cut = fresh.cut();
    check_arrays(*cut);
    const TriangleMesh moved = moved_apart(fresh, *cut);
    CHECK(longest_edge(moved) < 1.01 * longest_edge(fresh.skin->surface.mesh));
    CHECK(astray(fresh, *cut, 0) < 1e-4);
    CHECK(area(moved) == doctest::Approx(area(fresh.skin->surface.mesh)).epsilon(1e-4));
  }
}

TEST_CASE("a cut leaves the area of the skin, and strips close the gap to the wound") {
  SkinnedBody close(0);
  close.sever(0.033, 0.051);
  CHECK(area(close.cut()->surface.mesh) == doctest::Approx(area(close.skin->surface.mesh)).epsilon(1e-6));
  SkinnedBody high(0.004);
  high.sever(0.033, 0.051);
  const double strips = area(high.cut()->surface.mesh) - area(high.skin->surface.mesh);
  const double line = 4 * SkinnedBody::side;  // about the length of the cut round the body
  CHECK(strips > 2 * 0.004 * line);
  CHECK(strips < 2 * 0.004 * line * 1.5);
}

TEST_CASE("where elements are removed the skin over them is gone, and only there") {
  SkinnedBody body(0.001);
  const TetMesh& mesh = body.world->setup().mesh;
  RemoveElements remove;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    Vec3 middle = Vec3::Zero();
    for (const int n : mesh.tets[t]) middle += mesh.nodes[static_cast<std::size_t>(n)] / 4;
    if (middle.z() > 0.067 && middle.x() < 0.04) remove.which.tets.push_back(static_cast<int>(t));
  }
  REQUIRE(!remove.which.tets.empty());
  body.apply(remove);
  const auto cut = body.cut();
  check_arrays(*cut);
  bool beside = false;
  for (const Triangle& t : cut->surface.mesh.triangles) {
    Vec3 middle = Vec3::Zero();
    for (const int n : t) middle += cut->surface.mesh.nodes[static_cast<std::size_t>(n)] / 3;
    CHECK_FALSE((middle.z() > 0.0801 && middle.x() < 0.039));
    beside |= middle.z() > 0.0801 && middle.x() > 0.041;
  }
  CHECK(beside);
}

TEST_CASE("a body that has lost all of its surface has no skin left") {
  SkinnedBody body(0.001);
  const TetMesh& mesh = body.world->setup().mesh;
  RemoveElements remove;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (const int n : mesh.tets[t]) {
      const Vec3& x = mesh.nodes[static_cast<std::size_t>(n)];
      if (std::min(x.minCoeff(), (Vec3::Constant(SkinnedBody::side) - x).minCoeff()) > 1e-6) continue;
      remove.which.tets.push_back(static_cast<int>(t));
      break;
    }
  body.apply(remove);
  REQUIRE(!body.world->topology()->elements.empty());
  const auto cut = body.cut();
  check_arrays(*cut);
  CHECK(cut->surface.mesh.triangles.empty());
}

TEST_CASE("new vertices have the look of the place where they are") {
  SkinnedBody body(0.002);
  for (const Vec3& x : body.skin->surface.mesh.nodes) {
    body.skin->surface.places.push_back({static_cast<float>(x.x()), static_cast<float>(x.y())});
    body.skin->surface.colours.push_back(Vec3f(0, 0, static_cast<float>(x.z())));
  }
  body.sever(0.033, 0.051);
  const auto cut = body.cut();
  REQUIRE(cut->surface.places.size() == cut->surface.mesh.nodes.size());
  REQUIRE(cut->surface.colours.size() == cut->surface.mesh.nodes.size());
  int on_skin = 0;
  for (std::size_t v = body.skin->surface.mesh.nodes.size(); v < cut->surface.places.size(); ++v) {
    const Vec3 x = cut->surface.mesh.nodes[v];
    const Vec3 seen(cut->surface.places[v][0], cut->surface.places[v][1], cut->surface.colours[v].z());
    const double outside = std::max(-x.minCoeff(), (x - Vec3::Constant(SkinnedBody::side)).maxCoeff());
    if (outside > 0.0019) {
      ++on_skin;
      CHECK((seen - x).norm() < 1e-6);
    } else {
      CHECK((seen - x).norm() < 0.006);  // the foot of a strip, which has the look of its top
    }
  }
  CHECK(on_skin > 100);
}

TEST_CASE("at rest a cut skin lies where it was, in flat pieces of cut elements too") {
  SkinnedBody body(0.002);
  body.sever(0.0333, 0.0401);
  const auto cut = body.cut();
  std::vector<Vec3f> nodes;
  for (const Vec3& x : body.world->setup().mesh.nodes) nodes.push_back(x.cast<float>());
  float most = 0;
  for (std::size_t v = 0; v < cut->embedding.size(); ++v) {
    CHECK((cut->embedding.at<Vec3f>(v, nodes) - cut->surface.mesh.nodes[v].cast<float>()).norm() < 1e-5f);
    for (const float w : cut->embedding.weights[v]) most = std::max(most, std::abs(w));
  }
  CHECK(most < 8);
}

TEST_CASE("a frame has the cut skin while the body is cut, the same one each time, and the first one after undo") {
  SkinnedBody body(0.001);
  SkinAttachment attachment(body.skin);
  std::shared_ptr<const SurfaceMesh> surface = body.whole;
  const auto skin_now = [&] {
    Frame frame;
    surface = make_surface_mesh(*body.world, surface);
    frame.surface_mesh = surface;
    attachment.attach(*body.world, frame);
    return frame.skin;
  };
  CHECK(skin_now() == body.skin);
  body.sever(0.033, 0.051);
  const auto cut = skin_now();
  CHECK(cut != body.skin);
  CHECK(cut->surface.mesh.triangles.size() > body.skin->surface.mesh.triangles.size());
  CHECK(skin_now() == cut);
  body.apply(Undo{});
  CHECK(skin_now() == body.skin);
}

}  // namespace heml::skin_cutter_test
