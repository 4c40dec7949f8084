// The committed meshes and scenes are what assets/README.md says of them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <heml/mesh/quality.hpp>
#include <heml/mesh/read.hpp>
#include <heml/mesh/surface.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/schedule.hpp>
#include <map>
#include <numbers>
#include <numeric>
#include <places.hpp>
#include <set>
#include <string>

namespace heml::assets_test {
namespace {

const std::filesystem::path assets = test::source_folder() / "assets";

TetMesh asset(const std::string& name) { return read_tet_mesh(assets / "meshes" / (name + ".mesh")); }

/// V − E + F of the boundary; every edge must have one face on either side.
int euler_characteristic(const TetMesh& mesh) {
  const BoundaryFaces boundary = extract_boundary(mesh);
  std::map<std::pair<int, int>, int> sides;
  std::set<int> nodes;
  for (const Triangle& t : boundary.triangles)
    for (int i = 0; i < 3; ++i) {
      nodes.insert(t[i]);
      ++sides[{t[i], t[(i + 1) % 3]}];
    }
  int unpaired = 0;
  for (const auto& [edge, count] : sides) {
    const auto other = sides.find({edge.second, edge.first});
    if (count != 1 || other == sides.end() || other->second != 1) ++unpaired;
  }
  CHECK(unpaired == 0);
  return int(nodes.size()) - int(sides.size()) / 2 + int(boundary.triangles.size());
}

/// What holds for every mesh; `dihedral`: degrees that the README promises.
QualityReport check_sound(TetMesh mesh, double dihedral) {
  const QualityReport report = check_tets(mesh);
  CHECK(report.flipped == 0);
  CHECK(report.orphans == 0);
  CHECK(report.duplicates == 0);
  CHECK(report.components == 1);
  CHECK(report.nonmanifold_edges == 0);
  CHECK(report.worst_dihedral >= dihedral);
  CHECK(euler_characteristic(mesh) == 2);
  return report;
}

std::set<int> regions_of(const TetMesh& mesh) { return {mesh.regions.begin(), mesh.regions.end()}; }

bool inside(const TetMesh& mesh, const Vec3& p) {
  for (const auto& [a, b, c, d] : mesh.tets) {
    const Vec3 &x0 = mesh.nodes[a], &x1 = mesh.nodes[b], &x2 = mesh.nodes[c], &x3 = mesh.nodes[d];
    if (signed_volume(p, x1, x2, x3) >= 0 && signed_volume(x0, p, x2, x3) >= 0 && signed_volume(x0, x1, p, x3) >= 0 &&
        signed_volume(x0, x1, x2, p) >= 0)
      return true;
  }
  return false;
}

// The paper's meshes are not public; ours are of the same size within 3 %.
void check_size(const TetMesh& mesh, int nodes, int tets) {
  CHECK(double(mesh.nodes.size()) == doctest::Approx(nodes).epsilon(0.03));
  CHECK(double(mesh.tets.size()) == doctest::Approx(tets).epsilon(0.03));
}

}  // namespace

TEST_CASE("the kidney has the paper's size, two regions and no slivers") {
  const TetMesh mesh = asset("kidney");
  check_size(mesh, 829, 2053);
  const QualityReport report = check_sound(mesh, 14);
  CHECK(regions_of(mesh) == std::set{1, 2});
  CHECK(report.volume > 130e-6);
  CHECK(report.volume < 160e-6);
  CHECK((report.high - report.low).maxCoeff() == doctest::Approx(0.108).epsilon(0.02));
}

TEST_CASE("the uterus has the paper's size, three regions, a cavity and no slivers") {
  const TetMesh mesh = asset("uterus");
  check_size(mesh, 4362, 11445);
  check_sound(mesh, 9);
  CHECK(regions_of(mesh) == std::set{1, 2, 3});
  CHECK_FALSE(inside(mesh, {0, 0.026, 0.0078}));   // in the cavity
  CHECK_FALSE(inside(mesh, {0, -0.018, 0.0004}));  // in the canal
  CHECK(inside(mesh, {0, 0.026, 0.0200}));         // in the front wall
}

TEST_CASE("the liver weighs what livers do, has two regions and no slivers") {
  const TetMesh mesh = asset("liver");
  const QualityReport report = check_sound(mesh, 17);
  CHECK(regions_of(mesh) == std::set{1, 2});
  CHECK(report.volume == doctest::Approx(1.2e-3).epsilon(0.1));
}

TEST_CASE("the irregular cube has exactly the paper's size and fills a decimetre") {
  const TetMesh mesh = asset("irregular_cube");
  CHECK(mesh.nodes.size() == 151);
  CHECK(mesh.tets.size() == 407);
  const QualityReport report = check_sound(mesh, 20);
  CHECK(report.volume == doctest::Approx(1e-3).epsilon(1e-6));
}

TEST_CASE("the ventricle is a truncated ellipsoid whose fibres lie in the wall, and shortens as it contracts") {
  const TetMesh mesh = read_tet_mesh(assets / "meshes/ventricle.vtu");
  CHECK(mesh.tets.size() == 3024);
  const QualityReport report = check_sound(mesh, 23);
  const auto cup = [](double across, double along) {
    const double top = 0.0175;
    return std::numbers::pi * across * across * (2 * along / 3 + top - top * top * top / (3 * along * along));
  };
  CHECK(report.volume == doctest::Approx(cup(0.035, 0.07) - cup(0.0245, 0.0595)).epsilon(0.02));  // flat faces
  REQUIRE(mesh.fields.size() == 1);
  REQUIRE(mesh.fields[0].values.size() == 3 * mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    Vec3 middle = Vec3::Zero();
    for (const int n : mesh.tets[t]) middle += mesh.nodes[static_cast<std::size_t>(n)] / 4;
    const double across = middle.x() * middle.x() + middle.z() * middle.z(), along = middle.y() * middle.y();
    double in = 0, out = 0.0105;  // m, from the inner ellipsoid
    while (out - in > 1e-9) {
      const double half = (in + out) / 2, a = 0.0245 + half, c = 0.0595 + half;
      (across / (a * a) + along / (c * c) > 1 ? in : out) = half;
    }
    const double a = 0.0245 + in, c = 0.0595 + in;
    const Vec3 outward = Vec3(middle.x() / (a * a), middle.y() / (c * c), middle.z() / (a * a)).normalized();
    const Vec3 fibre(&mesh.fields[0].values[3 * t]);
    CHECK(fibre.norm() == doctest::Approx(1).epsilon(1e-5));
    CHECK(std::abs(fibre.dot(outward)) < 1e-4);
  }
  const auto world = load_world(read_scene(assets / "scenes/ventricle.json"));
  const auto lowest = [&] {
    std::vector<Vec3f> positions;
    std::vector<int> nodes(mesh.nodes.size());
    std::iota(nodes.begin(), nodes.end(), 0);
    world->write_positions(nodes, 0, positions);
    float low = 1;
    for (const Vec3f& x : positions) low = std::min(low, x.y());
    return low;
  };
  CHECK(lowest() == doctest::Approx(-0.07));
  Schedule schedule(read_scene(assets / "scenes/ventricle.json"), world->setup().mesh);
  float highest = -1;
  while (world->time() < 0.8) {
    for (const Event& event : schedule.due(world->ticks())) CHECK(world->apply(event.command).ok());
    world->tick();
    highest = std::max(highest, lowest());
  }
  CHECK(highest > -0.062f);
  CHECK(lowest() == doctest::Approx(-0.07).epsilon(0.02));
}

TEST_CASE("every scene can be read, and runs for a while") {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(assets / "scenes")) {
    if (entry.is_directory()) continue;  // extreme: tests/engine/studies/stability
    CAPTURE(entry.path().filename().string());
    const Scene scene = read_scene(entry.path());
    CHECK_FALSE(scene.title.empty());
    CHECK_FALSE(scene.description.empty());
    CHECK(scene.name == entry.path().stem().string());
    const auto world = load_world(scene);
    const double until = scene.name == "large_cube" ? 0.02 : 0.25;
    while (world->time() < until && !world->halt()) world->tick();
    CHECK_FALSE(world->halt().has_value());
    CHECK(std::filesystem::exists(assets / "pictures/scenes" / (scene.name + ".png")));
    ++scenes;
  }
  CHECK(scenes == 19);
}

TEST_CASE("every scene of the accuracy study can be read") {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(assets / "studies" / "accuracy")) {
    CAPTURE(entry.path().filename().string());
    const Scene scene = read_scene(entry.path());
    CHECK_FALSE(scene.title.empty());
    CHECK_NOTHROW(load_setup(scene));
    ++scenes;
  }
  CHECK(scenes == 7);
}

}  // namespace heml::assets_test
