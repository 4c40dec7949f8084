#include <doctest/doctest.h>

#include <algorithm>
#include <heml/materials/material.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/session/surface_mesh.hpp>
#include <heml/world/world.hpp>
#include <map>

namespace heml::surface_mesh_test {
namespace {

/// Two cubes of 1 cm side by side: region 1 at x below 1 cm, region 2 beyond.
std::unique_ptr<World> two_cubes() {
  WorldSetup setup;
  setup.mesh = make_box({0.02, 0.01, 0.01}, {4, 2, 2});
  for (std::size_t t = 0; t < setup.mesh.tets.size(); ++t) {
    double x = 0;
    for (const int n : setup.mesh.tets[t]) x += setup.mesh.nodes[static_cast<std::size_t>(n)].x() / 4;
    setup.mesh.regions[t] = x < 0.01 ? 1 : 2;
  }
  const LameParameters lame = lame_parameters(1e4, 0.3);
  setup.materials = {{std::nullopt, {"neo_hookean", {lame.lambda, lame.mu}, 1000}}};
  return make_world(setup);
}

double volume(const SurfaceMesh& surface) {
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const auto at = [&](int n) -> Vec3 { return surface.rest[static_cast<std::size_t>(n)].cast<double>(); };
    sum += at(a).dot(at(b).cross(at(c))) / 6;
  }
  return sum;
}

bool is_closed(const SurfaceMesh& surface) {
  std::map<std::pair<int, int>, int> edges;
  for (const Triangle& triangle : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{triangle[k], triangle[(k + 1) % 3]}];
  return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    const auto back = edges.find({edge.first.second, edge.first.first});
    return back != edges.end() && back->second == edge.second;
  });
}

}  // namespace

TEST_CASE("without a region the surface is that of the others, closed at their interface") {
  const auto world = two_cubes();
  const auto all = make_surface_mesh(*world);
  const auto one = make_surface_mesh(*world, all, {2});
  CHECK(volume(*all) == doctest::Approx(2e-6));
  CHECK(volume(*one) == doctest::Approx(1e-6));
  CHECK(is_closed(*one));
  CHECK(std::all_of(one->regions.begin(), one->regions.end(), [](int region) { return region == 1; }));
  CHECK(one->hidden == std::vector<int>{2});
  CHECK(make_surface_mesh(*world, one, {2}) == one);
  const auto again = make_surface_mesh(*world, one);
  CHECK(again->triangles == all->triangles);
  CHECK(make_surface_mesh(*world, one, {1, 2})->triangles.empty());
}

TEST_CASE("a frame's solid leaves out the regions that its surface does") {
  const auto world = two_cubes();
  Frame frame;
  std::shared_ptr<const Solid> solid;
  for (const std::vector<int>& hidden : {std::vector<int>{}, {1}, {}}) {
    fill_frame(*world, make_surface_mesh(*world, nullptr, hidden), Field::none, 0, frame);
    fill_solid(*world, 0, solid, frame);
    const std::size_t every = world->setup().mesh.tets.size();
    CHECK(frame.solid->tets.size() == (hidden.empty() ? every : every / 2));
    CHECK(frame.solid->rest.size() == world->setup().mesh.nodes.size());
  }
}

TEST_CASE("a frame has the regions and materials that there are, shared until they change") {
  const auto world = two_cubes();
  Frame frame;
  const auto fill = [&] {
    fill_frame(*world, make_surface_mesh(*world), Field::none, 0, frame);
    return frame.regions;
  };
  const auto first = fill();
  CHECK(first->numbers == std::vector{1, 2});
  CHECK(first->tagged.empty());
  world->tick();
  CHECK(fill() == first);
  REQUIRE(world->apply(TagRegion{{{}, {{0, 1}, {}, {}, {}}, "lesion", {}}, {}}).ok());
  const auto tagged = fill();
  CHECK(tagged->numbers == std::vector{1, 2, 3});
  CHECK(tagged->names.at(3) == "lesion");
  CHECK(tagged->tagged == std::vector{TaggedRegion{3, "lesion", {0, 1}}});
  CHECK(tagged->materials.size() == 2);
  CHECK(frame.surface_mesh->version > 0);
  Material other = tagged->materials[1].material;
  other.density = 1200;
  REQUIRE(world->apply(SetMaterial{3, other}).ok());
  const auto changed = fill();
  CHECK(changed->version == tagged->version);
  CHECK(changed->materials[1].material == other);
  REQUIRE(world->apply(Reset{true}).ok());
  CHECK(fill()->numbers == first->numbers);
}

TEST_CASE("hiding a region of a cut body leaves the others cut, and knows their skin from before") {
  const auto world = two_cubes();
  const auto before = make_surface_mesh(*world);
  CutTissue cut;
  cut.sweep.blades = {{Vec3(0.005, -0.01, -0.01), Vec3(0.005, -0.01, 0.02)},
                      {Vec3(0.005, 0.02, -0.01), Vec3(0.005, 0.02, 0.02)}};
  REQUIRE(world->apply(cut).ok());
  world->tick();
  const auto cut_all = make_surface_mesh(*world, before);
  const auto cut_one = make_surface_mesh(*world, cut_all, {2});
  REQUIRE(cut_all->whole);
  REQUIRE(cut_one->whole);
  CHECK(volume(*cut_one) == doctest::Approx(1e-6));
  CHECK(volume(*cut_one->whole) == doctest::Approx(1e-6));  // of the uncut elements alone
  CHECK(is_closed(*cut_one->whole));
  CHECK(cut_one->nodes.size() > cut_one->whole->nodes.size());
  CHECK(make_surface_mesh(*world, cut_one)->whole->triangles == before->triangles);
}

TEST_CASE("a burn makes another surface, which has the mean level of the elements behind the triangles at a node") {
  const auto world = two_cubes();
  const auto before = make_surface_mesh(*world);
  CHECK(before->burnt.empty());
  REQUIRE(world->apply(CauterizeTissue{{{{Vec3(0.005, 0.01, 0.005), Vec3(0.005, 0.01, 0.005)}}}, {0.006, 0.2}}).ok());
  const auto after = make_surface_mesh(*world, before);
  CHECK(after->version > before->version);
  CHECK(after->triangles == before->triangles);
  CHECK_FALSE(after->whole);
  const std::vector<Burn>& burns = world->setup().mesh.burns;
  REQUIRE(after->burnt.size() == after->nodes.size());
  for (std::size_t n = 0; n < after->nodes.size(); ++n) {
    double sum = 0, count = 0;
    for (std::size_t t = 0; t < after->triangles.size(); ++t)
      for (const int corner : after->triangles[t])
        if (corner == static_cast<int>(n)) sum += burns[static_cast<std::size_t>(after->elements[t])].level, ++count;
    CHECK(after->burnt[n] == doctest::Approx(sum / count).epsilon(1e-6));
  }
  CHECK(*std::max_element(after->burnt.begin(), after->burnt.end()) > 0.9f);
  CHECK(*std::min_element(after->burnt.begin(), after->burnt.end()) == 0);
  Frame frame;
  std::shared_ptr<const Solid> solid;
  fill_frame(*world, after, Field::none, 0, frame);
  fill_solid(*world, 0, solid, frame);
  REQUIRE(solid->burnt.size() == solid->rest.size());
  CHECK(*std::max_element(solid->burnt.begin(), solid->burnt.end()) > 0.5f);
  REQUIRE(world->apply(Undo{}).ok());
  CHECK(make_surface_mesh(*world, after)->burnt.empty());
}

}  // namespace heml::surface_mesh_test
