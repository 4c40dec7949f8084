#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <heml/mesh/intersections.hpp>
#include <heml/mesh/mend/mend.hpp>
#include <heml/mesh/mend/remesh.hpp>
#include <heml/mesh/quality.hpp>
#include <map>
#include <messages.hpp>
#include <numbers>
#include <random>

#include "engine/mesh/files.hpp"
#include "engine/mesh/solids.hpp"

namespace heml::mend_test {

namespace {

/// A torus of radii 1 and 0.4, or by `tube` another one.
TriangleMesh torus(int around = 32, int across = 16, double tube = 0.4) {
  TriangleMesh surface{{}, {}, "torus"};
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      const double r = 1 + tube * std::cos(v);
      surface.nodes.push_back({r * std::cos(u), r * std::sin(u), tube * std::sin(v)});
    }
  const auto node = [&](int i, int j) { return i % around * across + j % across; };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      surface.triangles.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      surface.triangles.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  return surface;
}

/// A unit sphere: a box's surface blown up.
TriangleMesh sphere(int cells = 8, const Vec3& centre = Vec3::Zero(), double radius = 1) {
  TriangleMesh surface = box_surface({2, 2, 2}, cells, {-1, -1, -1});
  for (Vec3& x : surface.nodes) x = centre + radius * x.normalized();
  surface.source = "sphere";
  return surface;
}

TriangleMesh solid(int kind) {
  if (kind == 0) return sphere();
  if (kind == 1) return torus();
  return box_surface({1, 0.7, 0.4}, 5);
}

std::size_t open_edges(const TriangleMesh& surface) {
  std::map<std::pair<int, int>, int> count;
  for (const Triangle& t : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i) ++count[std::minmax({t[i], t[(i + 1) % 3]})];
  return static_cast<std::size_t>(
      std::count_if(count.begin(), count.end(), [](const auto& edge) { return edge.second != 2; }));
}

/// Mends it and checks that the result is closed and has a volume within a share of the right one.
MendReport mended_to(double volume, TriangleMesh surface, double tolerance) {
  const MendedSurface mended = mend_surface(std::move(surface));
  CHECK(mended.report.unmended.empty());
  CHECK(open_edges(mended.surface) == 0);
  CHECK(self_intersections(mended.surface).pairs == 0);
  CHECK(enclosed_volume(mended.surface) == doctest::Approx(volume).epsilon(tolerance));
  return mended.report;
}

double volume_of(TetMesh mesh) { return check_tets(mesh).volume; }

/// Gives every triangle nodes of its own, moved by up to `jitter`.
TriangleMesh torn(const TriangleMesh& surface, double jitter) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> step(-jitter, jitter);
  TriangleMesh result{{}, {}, surface.source};
  for (const Triangle& t : surface.triangles) {
    for (const int n : t) result.nodes.push_back(surface.nodes[n] + Vec3(step(random), step(random), step(random)));
    const int first = static_cast<int>(result.nodes.size()) - 3;
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

}  // namespace

TEST_CASE("a sound surface stays as it is, to the bit, and nothing is told") {
  for (int kind = 0; kind < 3; ++kind) {
    CAPTURE(kind);
    const TriangleMesh surface = solid(kind);
    const MendedSurface mended = mend_surface(surface);
    CHECK(mended.surface.nodes == surface.nodes);
    CHECK(mended.surface.triangles == surface.triangles);
    CHECK(to_lines(mended.report).empty());
  }
}

TEST_CASE("triangles turned inward are turned outward and counted") {
  TriangleMesh surface = torus();
  const double volume = enclosed_volume(surface);
  for (std::size_t t = 0; t < surface.triangles.size(); t += 5)
    std::swap(surface.triangles[t][0], surface.triangles[t][2]);
  CHECK(mended_to(volume, surface, 1e-12).turned == 205);
  for (Triangle& t : surface.triangles) std::swap(t[0], t[1]);
  CHECK(mended_to(volume, surface, 1e-12).turned == 1024 - 205);
}

TEST_CASE("triangles with nodes of their own, a little apart, are welded") {
  const TriangleMesh whole = torus();
  const MendReport report = mended_to(enclosed_volume(whole), torn(whole, 1e-7), 1e-5);
  CHECK(report.welded == 3 * 1024 - 512);
  CHECK(report.holes.holes == 0);
  CHECK(to_lines(report) == std::vector<std::string>{"welded 2560 nodes to others beside them"});
}

TEST_CASE("a crack wider than round-off is welded") {
  TriangleMesh surface = sphere();
  const double volume = enclosed_volume(surface);
  const std::size_t half = surface.triangles.size() / 2;  // with nodes of their own
  std::vector<int> copy(surface.nodes.size(), -1);
  for (std::size_t t = 0; t < half; ++t)
    for (int& n : surface.triangles[t]) {
      if (copy[n] < 0) {
        copy[n] = static_cast<int>(surface.nodes.size());
        surface.nodes.push_back(surface.nodes[n] + Vec3(0.003, 0, 0));
      }
      n = copy[n];
    }
  const MendReport report = mended_to(volume, surface, 0.01);
  CHECK(report.welded > 10);
  CHECK(report.holes.holes == 0);
}

TEST_CASE("copies and flat triangles are removed") {
  TriangleMesh surface = sphere();
  const double volume = enclosed_volume(surface);
  const auto [a, b, c] = surface.triangles[7];
  surface.triangles.push_back({b, c, a});
  surface.triangles.push_back({b, a, c});
  surface.triangles.push_back({a, b, b});
  const MendReport report = mended_to(volume, surface, 1e-12);
  CHECK(report.duplicates == 2);
  CHECK(report.flat == 1);
}

TEST_CASE("T-junctions are split, with a flat triangle in them or without") {
  TriangleMesh surface = box_surface({1, 1, 1}, 3);
  const auto [a, b, c] = surface.triangles[4];
  const int middle = static_cast<int>(surface.nodes.size());
  surface.nodes.push_back((surface.nodes[a] + surface.nodes[b]) / 2);
  surface.triangles[4] = {a, middle, c};
  surface.triangles.push_back({middle, b, c});
  CHECK(mended_to(1, surface, 1e-12).split == 1);
  surface.triangles.push_back({a, b, middle});
  const MendReport report = mended_to(1, surface, 1e-12);
  CHECK(report.split == 1);
  CHECK(report.flat == 1);
}

TEST_CASE("loose crumbs are left out, a second body is not") {
  TriangleMesh surface = sphere();
  const double volume = enclosed_volume(surface);
  surface = together(surface, cube(0.5, {3, 0, 0}));
  const int first = static_cast<int>(surface.nodes.size());
  for (const Vec3& x : {Vec3(2, 2, 2), Vec3(2.03, 2, 2), Vec3(2, 2.03, 2)}) surface.nodes.push_back(x);
  surface.triangles.push_back({first, first + 1, first + 2});
  const MendReport report = mended_to(volume + 0.125, together(surface, cube(0.01, {-3, 0, 0})), 1e-12);
  CHECK(report.crumbs.parts == 2);
  CHECK(report.crumbs.triangles == 1 + 48);
  CHECK(report.holes.holes == 0);
}

TEST_CASE("holes are closed and measured") {
  TriangleMesh surface = sphere(12);
  const double volume = enclosed_volume(surface);
  std::erase_if(surface.triangles, [&](const Triangle& t) { return surface.nodes[t[0]].z() > 0.97; });
  surface.triangles.erase(surface.triangles.begin() + 3);
  const MendReport report = mended_to(volume, surface, 0.02);
  CHECK(report.holes.holes == 2);
  CHECK(report.holes.longest > 1);
  CHECK(report.holes.longest < 3);
  CHECK(report.holes.largest_share > 0.005);
  CHECK(report.holes.largest_share < 0.05);
  CHECK(says(to_lines(report)[0], "closed 2 holes"));
}

TEST_CASE("half a ball is closed by a disc, a tube by two") {
  TriangleMesh ball = sphere(12);
  std::erase_if(ball.triangles, [&](const Triangle& t) {
    return ball.nodes[t[0]].z() + ball.nodes[t[1]].z() + ball.nodes[t[2]].z() > 1e-9;
  });
  CHECK(mended_to(2 * std::numbers::pi / 3, ball, 0.06).holes.largest_share == doctest::Approx(0.5).epsilon(0.1));
  TriangleMesh tube = torus(40);
  std::erase_if(tube.triangles, [&](const Triangle& t) { return tube.nodes[t[0]].x() > 0; });
  CHECK(mended_to(enclosed_volume(torus(40)) / 2, tube, 0.1).holes.holes == 2);
}

TEST_CASE("sheets are refused, and left out beside a body") {
  TriangleMesh sheet = box_surface({1, 1, 1}, 4);
  std::erase_if(sheet.triangles, [&](const Triangle& t) {
    return sheet.nodes[t[0]].z() + sheet.nodes[t[1]].z() + sheet.nodes[t[2]].z() > 1e-9;
  });
  CHECK(says(refusal([&] { mend_surface(sheet); }), "100 % of it is sheets"));
  for (Vec3& x : sheet.nodes) x += Vec3(5, 0, 0);
  const MendReport report = mended_to(enclosed_volume(sphere()), together(sphere(), sheet), 1e-12);
  CHECK(report.holes.sheets == 1);
  TriangleMesh two_sided = sheet;
  for (const Triangle& t : sheet.triangles) two_sided.triangles.push_back({t[0], t[2], t[1]});
  CHECK(says(refusal([&] { mend_surface(two_sided); }), "100 % of it is sheets"));
}

TEST_CASE("a wall between two rooms and a fin are left out") {
  TriangleMesh surface = box_surface({1, 1, 1}, 2);
  TriangleMesh other = box_surface({1, 1, 1}, 2, {1, 0, 0});
  CHECK(mended_to(2, together(surface, other), 1e-12).walls.triangles == 8);
  const auto [a, b, c] = surface.triangles[0];
  surface.nodes.push_back(surface.nodes[a] + Vec3(-0.5, -0.5, -0.5));
  surface.triangles.push_back({a, b, static_cast<int>(surface.nodes.size()) - 1});
  CHECK(mended_to(1, surface, 1e-12).walls.parts == 1);
}

TEST_CASE("what is smoothed apart at a crease is counted") {
  const TriangleMesh creased = creased_box();
  const MendReport report = mend_surface(creased).report;
  CHECK(report.smoothed == static_cast<int>(self_intersections(creased).pairs));
  CHECK(report.smoothed > 0);
  CHECK(report.crossings == 0);
  CHECK(report.unmended.empty());
  CHECK(mend_surface(sphere()).report.smoothed == 0);
}

TEST_CASE("bodies that cross are united by meshing anew") {
  const double size = 1, overlap = 0.5 * 0.6 * 0.7;
  const TriangleMesh crossing = together(cube(size, {0, 0, 0}), cube(size, {0.5, 0.4, 0.3}));
  const MendedSurface mended = mend_surface(crossing);
  CHECK(says(mended.report.unmended, "meets triangle"));
  CHECK(mended.report.crossings == static_cast<int>(self_intersections(crossing).pairs));
  const TetMesh mesh = tetrahedralize(mended);
  CHECK(volume_of(mesh) == doctest::Approx(2 - overlap).epsilon(0.03));
  CHECK(mesh.tets.size() < 15000);
  double worst = 180;
  for (const auto& [a, b, c, d] : mesh.tets)
    worst = std::min(worst, min_dihedral({mesh.nodes[a], mesh.nodes[b], mesh.nodes[c], mesh.nodes[d]}));
  CHECK(worst > 5);
  const TetMesh again = tetrahedralize(mended);
  CHECK(again.nodes == mesh.nodes);
  CHECK(again.tets == mesh.tets);
}

TEST_CASE("meshing anew keeps cavities, spans what is open still, and follows the volume wanted") {
  TriangleMesh hollow = together(sphere(8), sphere(8, Vec3::Zero(), 0.5));
  orient_by_sky(hollow);
  const double volume = enclosed_volume(hollow);
  CHECK(volume_of(remesh(hollow, {})) == doctest::Approx(volume).epsilon(0.02));
  TriangleMesh open = torus();
  const double whole = enclosed_volume(open);
  std::erase_if(open.triangles, [&](const Triangle& t) { return t[0] % 97 == 5; });
  const TetMesh coarse = remesh(open, {}), fine = remesh(open, whole / 100000);
  CHECK(volume_of(coarse) == doctest::Approx(whole).epsilon(0.03));
  CHECK(volume_of(fine) == doctest::Approx(whole).epsilon(0.02));
  CHECK(fine.tets.size() > 1.3 * static_cast<double>(coarse.tets.size()));
}

TEST_CASE("a scan by others with holes in its base is closed and filled") {
  if (shared_data("bunny.obj").empty()) {
    MESSAGE("skipped: no surfaces by others here");
    return;
  }
  TriangleMesh bunny;
  const std::string said = refusal([&] { bunny = read_surface(shared_data("bunny.obj")); });
  if (says(said, "HEML_ASSIMP")) return;
  const MendedSurface mended = mend_surface(bunny);
  CHECK(open_edges(mended.surface) == 0);
  CHECK(to_lines(mended.report).size() == 1);
  CHECK(mended.report.holes.holes == 4);
  CHECK(mended.report.holes.edges == 42);
  CHECK(mended.surface.nodes == bunny.nodes);
}

TEST_CASE("what has no volume, no place or no triangles is refused") {
  TriangleMesh flat{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}, "flat"};
  CHECK(says(refusal([&] { mend_surface(flat); }), "no triangle has an area"));
  flat.nodes[2] = {0, std::nan(""), 0};
  CHECK(says(refusal([&] { mend_surface(flat); }), "node 2"));
  flat.triangles[0][1] = 7;
  flat.nodes[2] = {0, 1, 0};
  CHECK(says(refusal([&] { mend_surface(flat); }), "names node 7"));
  CHECK(says(refusal([] { mend_surface({}); }), "no triangles"));
  TriangleMesh outward = sphere();
  for (Triangle& t : outward.triangles) std::swap(t[0], t[1]);
  CHECK(says(refusal([&] { remesh(outward, {}); }), "winds round no volume"));
}

TEST_CASE("any damage gives a closed surface, one to be meshed anew, or an error") {
  std::mt19937 random(12);
  const auto pick = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
  int closed = 0, anew = 0, refused = 0;
  for (int round = 0; round < 120; ++round) {
    CAPTURE(round);
    TriangleMesh surface = solid(round % 3);
    const double volume = enclosed_volume(surface);
    const std::size_t damages = 1 + pick(1 + round / 4);
    for (std::size_t k = 0; k < damages; ++k) {
      const std::size_t t = pick(surface.triangles.size());
      Triangle& triangle = surface.triangles[t];
      switch (pick(6)) {
        case 0:
          surface.triangles.erase(surface.triangles.begin() + static_cast<std::ptrdiff_t>(t));
          break;
        case 1:
          std::swap(triangle[0], triangle[1]);
          break;
        case 2:
          surface.nodes.push_back(surface.nodes[triangle[0]]);
          triangle[0] = static_cast<int>(surface.nodes.size()) - 1;
          break;
        case 3:
          surface = together(surface, cube(0.01, Vec3(2 + 0.1 * static_cast<double>(k), 2, 2)));
          break;
        case 4:
          surface.triangles.push_back(surface.triangles[t]);
          break;
        default:
          triangle[pick(3)] = static_cast<int>(pick(surface.nodes.size()));
      }
    }
    const std::string said = refusal([&] {
      const MendedSurface mended = mend_surface(surface);
      if (!mended.report.unmended.empty()) {
        ++anew;
        if (anew % 8 == 1) CHECK(volume_of(tetrahedralize(mended)) == doctest::Approx(volume).epsilon(0.2));
        return;
      }
      ++closed;
      CHECK(open_edges(mended.surface) == 0);
      CHECK(enclosed_volume(mended.surface) > 0.5 * volume);
      CHECK(enclosed_volume(mended.surface) < 1.2 * volume);
    });
    if (said.empty()) continue;
    ++refused;
    MESSAGE(said);
  }
  MESSAGE(closed, " closed, ", anew, " meshed anew, ", refused, " refused");
  CHECK(closed > 30);
  CHECK(refused < 20);
}

TEST_CASE("soups of triangles are refused, in any number") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-1, 1);
  for (const int count : {1, 2, 10, 300, 3000}) {
    CAPTURE(count);
    TriangleMesh soup{{}, {}, "soup"};
    for (int n = 0; n < count + 2; ++n) soup.nodes.push_back({place(random), place(random), place(random)});
    const auto node = [&] { return static_cast<int>(random() % soup.nodes.size()); };
    for (int t = 0; t < count; ++t) soup.triangles.push_back({node(), node(), node()});
    const std::string said = refusal([&] { tetrahedralize(mend_surface(soup)); });
    CHECK(says(said, "soup: "));
  }
}

}  // namespace heml::mend_test
