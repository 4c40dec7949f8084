#include <doctest/doctest.h>
#include <fmt/format.h>
#include <messages.hpp>
#include <sys/resource.h>

#include <algorithm>
#include <heml/mesh/from_surface.hpp>
#include <heml/mesh/intersections.hpp>
#include <heml/mesh/quality.hpp>
#include <set>

#include "engine/mesh/files.hpp"
#include "engine/mesh/helpers.hpp"
#include "engine/mesh/solids.hpp"

namespace heml::from_surface_test {

namespace {

// Whether this build has the helper with both libraries; prints a message if not.
bool can_mesh() {
  const TemporaryFolder folder;
  const std::string said = refusal([&] { read_surface(folder.file("a.obj", "")); }) + refusal([] {
                             tetrahedralize(cube(1, {0, 0, 0}));
                           });
  const bool missing = says(said, "HEML_ASSIMP") || says(said, "HEML_TETGEN");
  if (missing) MESSAGE("skipped: ", said);
  return !missing;
}

// CPU time of all ended helpers so far, s.
double helpers_seconds() {
  rusage used;
  getrusage(RUSAGE_CHILDREN, &used);
  return static_cast<double>(used.ru_utime.tv_sec) + 1e-6 * static_cast<double>(used.ru_utime.tv_usec);
}

std::string as_obj(const TriangleMesh& surface) {
  std::string text;
  for (const Vec3& x : surface.nodes) text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", x[0], x[1], x[2]);
  for (const auto& [a, b, c] : surface.triangles) text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
  return text;
}

TetgenOptions with_ratio(double ratio) {
  TetgenOptions options;
  options.radius_edge_ratio = ratio;
  return options;
}

TetgenOptions with_volume(double volume, double seconds = 60) {
  TetgenOptions options;
  options.max_volume = volume;
  options.time_limit = seconds;
  return options;
}

TetgenOptions with_time(double seconds) {
  TetgenOptions options;
  options.time_limit = seconds;
  return options;
}

std::set<Triangle> sorted_set(std::vector<Triangle> triangles) {
  for (Triangle& triangle : triangles) std::sort(triangle.begin(), triangle.end());
  return {triangles.begin(), triangles.end()};
}

}  // namespace

TEST_CASE("fills a box at any scale: nodes kept to the bit, same boundary, same volume") {
  if (!can_mesh()) return;
  for (double scale : {1e-4, 0.1, 1e3}) {
    CAPTURE(scale);
    const TriangleMesh surface = box_surface(scale * Vec3(1, 0.7, 0.4), 4, scale * Vec3(3, -2, 1.0 / 3));
    TetMesh mesh = tetrahedralize(surface);
    REQUIRE(mesh.nodes.size() >= surface.nodes.size());
    CHECK(std::equal(surface.nodes.begin(), surface.nodes.end(), mesh.nodes.begin()));
    CHECK(sorted_set(extract_boundary(mesh).triangles) == sorted_set(surface.triangles));
    const QualityReport report = check_tets(mesh);
    CHECK(report.flipped == 0);
    CHECK(report.volume == doctest::Approx(0.28 * scale * scale * scale).epsilon(1e-11));
    CHECK(mesh.regions == std::vector<int>(mesh.tets.size(), 0));
  }
}

TEST_CASE("keeps cavities empty, fills bodies in cavities and bodies beside each other") {
  if (!can_mesh()) return;
  const Vec3 centre(0.1, 0.2, 0.3);
  TetMesh hollow = tetrahedralize(together(cube(3, centre), cube(2, centre)));
  CHECK(check_tets(hollow).volume == doctest::Approx(27 - 8).epsilon(1e-11));
  TetMesh nested = tetrahedralize(together(together(cube(1, centre), cube(3, centre)), cube(2, centre)));
  CHECK(check_tets(nested).volume == doctest::Approx(27 - 8 + 1).epsilon(1e-11));
  TetMesh beside = tetrahedralize(together(cube(1, centre), cube(2, centre + Vec3(2, 0, 0))));
  const QualityReport report = check_tets(beside);
  CHECK(report.volume == doctest::Approx(1 + 8).epsilon(1e-11));
  CHECK(report.components == 2);
}

TEST_CASE("obeys the requested max. volume away from the surface, whose triangles are kept") {
  if (!can_mesh()) return;
  const TriangleMesh surface = box_surface(Vec3(1, 1, 1), 6);
  const TetMesh coarse = tetrahedralize(surface), fine = tetrahedralize(surface, with_volume(1e-3));
  CHECK(fine.tets.size() > 1.2 * static_cast<double>(coarse.tets.size()));
  int inside = 0;
  for (const Tet& tet : fine.tets) {
    if (*std::min_element(tet.begin(), tet.end()) < static_cast<int>(surface.nodes.size())) continue;
    ++inside;
    const auto& [a, b, c, d] = tet;
    CHECK(signed_volume(fine.nodes[a], fine.nodes[b], fine.nodes[c], fine.nodes[d]) <= 1e-3);
  }
  CHECK(inside > 100);
}

TEST_CASE("refuses options without sense") {
  const TriangleMesh surface = cube(1, {0, 0, 0});
  for (double ratio : {0.5, -1.0, std::nan("")})
    CHECK(says(refusal([&] { tetrahedralize(surface, with_ratio(ratio)); }), "radius_edge_ratio"));
  for (double volume : {0.0, -1.0, std::nan("")})
    CHECK(says(refusal([&] { tetrahedralize(surface, with_volume(volume)); }), "max_volume"));
}

TEST_CASE("reads surfaces with joined nodes: OBJ of several parts and quadrilaterals, STL, PLY, OFF") {
  if (!can_mesh()) return;
  const TemporaryFolder folder;
  const std::string quads =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
      "g a\nf 4 3 2 1\nf 5 6 7 8\ng b\nf 1 2 6 5\nf 2 3 7 6\ng c\nf 3 4 8 7\nf 4 1 5 8\n";
  TriangleMesh box = read_surface(folder.file("quads.obj", quads));
  CHECK(box.nodes.size() == 8);
  CHECK(box.triangles.size() == 12);
  check_surface(box);
  CHECK(enclosed_volume(box) == doctest::Approx(1));

  const TriangleMesh surface = cube(1, {0, 0, 0});
  std::string stl = "solid a\n";
  std::string ply = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      surface.nodes.size(), surface.triangles.size());
  std::string off = fmt::format("OFF\n{} {} 0\n", surface.nodes.size(), surface.triangles.size());
  for (const Vec3& x : surface.nodes) {
    ply += fmt::format("{} {} {}\n", x[0], x[1], x[2]);
    off += fmt::format("{} {} {}\n", x[0], x[1], x[2]);
  }
  for (const Triangle& t : surface.triangles) {
    stl += "facet normal 0 0 0\nouter loop\n";
    for (int node : t) {
      const Vec3& x = surface.nodes[node];
      stl += fmt::format("vertex {} {} {}\n", x[0], x[1], x[2]);
    }
    stl += "endloop\nendfacet\n";
    ply += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    off += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  }
  for (const auto& file : {std::pair{"a.stl", stl + "endsolid a\n"}, {"a.ply", ply}, {"a.off", off}}) {
    const auto& [name, text] = file;
    CAPTURE(file.first);
    TriangleMesh read = read_surface(folder.file(name, text));
    CHECK(read.nodes.size() == surface.nodes.size());
    CHECK(read.triangles.size() == surface.triangles.size());
    check_surface(read);
    CHECK(enclosed_volume(read) == doctest::Approx(1));
  }
}

TEST_CASE("reads a surface of tiny triangles whole") {
  if (!can_mesh()) return;
  const TemporaryFolder folder;
  const TriangleMesh surface = box_surface(Vec3(1e-4, 1e-4, 1e-4), 8);
  const TriangleMesh read = read_surface(folder.file("tiny.obj", as_obj(surface)));
  CHECK(read.nodes.size() == surface.nodes.size());
  CHECK(read.triangles.size() == surface.triangles.size());
}

TEST_CASE("refuses files that hold no surface") {
  if (!can_mesh()) return;
  const TemporaryFolder folder;
  CHECK(says(refusal([&] { read_surface(folder / "none.obj"); }), "no such file"));
  CHECK(says(refusal([&] { read_surface(folder.file("a.obj", "v 0 0 0\nv 1 0 0\n")); }), "a.obj"));
  CHECK(says(refusal([&] { read_surface(folder.file("a.stl", std::string(84, '\1'))); }), "a.stl"));
  CHECK(says(refusal([&] { read_surface(folder.file("a.xyz", "1 2 3")); }), "assimp"));
  CHECK(says(refusal([&] { read_surface(folder.file("points.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n")); }), "points.obj"));
}

TEST_CASE("refuses surfaces of sizes that the file cannot hold, at once") {
  if (!can_mesh()) return;
  const TemporaryFolder folder;
  const auto said_of = [&](const char* name, const std::string& text) {
    const double start = helpers_seconds();
    const std::string said = refusal([&] { read_surface(folder.file(name, text)); });
    CHECK(helpers_seconds() - start < 1);
    return said;
  };
  const std::string end = "property list uint int vertex_indices\nend_header\n", huge = "2147483648";
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nelement face 1\n";
  CHECK(says(said_of("list.ply", ply + end + "0\n" + huge + " 0 1 2\n"), "list of 2147483648 values"));
  CHECK(says(said_of("cut.ply", ply + "property float zchar int vertex_indices\nen 3\n3 1 " + huge + " 3\n"), "line 6"));
  if (helpers_have_memory_limits)
    CHECK(says(said_of("a.off", "OFF\n4000000000 4000000000 0\n0 0 0\n"), "reading it takes more than 256 MB"));
  CHECK(says(said_of("a.stl", std::string(80, '\0') + std::string(4, '\xff') + std::string(100, '\0')), "a.stl"));
  CHECK(says(said_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2147483647\n"), "a.obj"));
}

TEST_CASE("reading that takes too long or too much memory is said of reading, not of filling") {
  const TemporaryFolder folder;
  const auto surface = folder.file("a.obj", "v 0 0 0\n");
  const Environment helper("HEML_MESHER", helper_of(folder, "exit 2"));
  const std::string said = refusal([&] { read_surface(surface); });
  CHECK(says(said, "reading it takes more than 256 MB of memory (is a size that the file declares damaged?)"));
}

TEST_CASE("says which option adds the helper when it is not there") {
  const Environment none("HEML_MESHER", "/nonexistent");
  const std::string said = refusal([] { tetrahedralize(cube(1, {0, 0, 0})); });
  CHECK(says(said, "tetrahedral meshes only"));
  CHECK(says(said, "HEML_TETGEN"));
}

TEST_CASE("survives a helper that hangs, crashes, complains or answers nonsense, and leaves no files") {
  const TemporaryFolder folder, scratch;
  const Environment temporary("TMPDIR", (scratch / "").string());
  const TriangleMesh surface = cube(1, {0, 0, 0});
  const auto told = [&](const std::string& script) {
    const Environment helper("HEML_MESHER", helper_of(folder, script));
    return refusal([&] { tetrahedralize(surface, with_time(0.5)); });
  };
  CHECK(says(told("exec sleep 60"), "longer than 0.5 s"));
  CHECK(says(told("while :; do echo x; done"), "longer than 0.5 s"));
  CHECK(says(told("kill -SEGV $$"), "signal 11"));
  CHECK(says(told("exit 2"), "filling it takes more than 4000 MB"));
  CHECK(says(told("echo first >&2; echo 'too small' >&2; exit 1"), "box: too small"));
  CHECK(says(told("exit 0"), "box"));
  CHECK(says(told("echo '8 4000000' >&3"), "is 8, more than"));
  CHECK(says(told("echo '1 1 0 0 0 0 0 0 7' >&3"), "'7'"));
  CHECK(says(told("echo '1 0 0 0 0' >&3"), "filled nothing"));
  CHECK(std::filesystem::is_empty(scratch / ""));
}

TEST_CASE("a fine mesh that takes too long is stopped") {
  if (!can_mesh()) return;
  const TriangleMesh surface = box_surface(Vec3(1, 1, 1), 4);
  const std::string said = refusal([&] { tetrahedralize(surface, with_volume(1e-8, 0.3)); });
  CHECK(says(said, "longer than 0.3 s"));
}

TEST_CASE("suspects bodies of no organ's size") {
  const auto suspicion = [](double length) {
    return unit_warning(Vec3(0, 0, 0), Vec3(length / 2, length, length / 3));
  };
  for (double length : {0.005, 0.15, 0.5, 1.9}) CHECK(suspicion(length).empty());
  CHECK(says(suspicion(18), "18 m long: is the file in centimetres? \"scale\": 0.01 would make it 0.18 m"));
  CHECK(says(suspicion(180), "millimetres? \"scale\": 0.001 would make it 0.18 m"));
  CHECK(says(suspicion(1e6), "is the scale right"));
  CHECK(says(suspicion(2e-4), "is the scale right"));
}

TEST_CASE("fills surfaces made by others and refuses those that cannot be filled") {
  if (shared_data("liver2.obj").empty()) {
    MESSAGE("skipped: no surfaces by others here");
    return;
  }
  if (!can_mesh()) return;
  const TriangleMesh liver = read_surface(shared_data("liver2.obj"));
  CHECK(liver.nodes.size() == 1170);
  CHECK(liver.triangles.size() == 2336);
  TetMesh mesh = tetrahedralize(liver);
  const QualityReport report = check_tets(mesh);
  CHECK(report.components == 1);
  CHECK(report.volume == doctest::Approx(enclosed_volume(liver)).epsilon(1e-10));
  const auto refusal_of = [](const char* name) {
    TriangleMesh surface = read_surface(shared_data(name));
    return refusal([&] { check_surface(surface); });
  };
  CHECK(says(refusal_of("bunny.obj"), "open: 42 edges"));
}

TEST_CASE("fills a surface by others that runs through itself in a crease, once smoothed there") {
  if (shared_data("liver-smooth.obj").empty()) {
    MESSAGE("skipped: no surfaces by others here");
    return;
  }
  if (!can_mesh()) return;
  TriangleMesh liver = read_surface(shared_data("liver-smooth.obj"));
  CHECK(self_intersections(liver).pairs == 7);  // agrees with exact arithmetic and with TetGen's detection (-d)
  TetMesh mesh = tetrahedralize(liver);
  check_surface(liver);
  CHECK(self_intersections(liver).pairs == 0);
  CHECK(std::equal(liver.nodes.begin(), liver.nodes.end(), mesh.nodes.begin()));
  const QualityReport report = check_tets(mesh);
  CHECK(report.flipped == 0);
  CHECK(report.volume == doctest::Approx(enclosed_volume(liver)).epsilon(1e-10));
}

}  // namespace heml::from_surface_test
