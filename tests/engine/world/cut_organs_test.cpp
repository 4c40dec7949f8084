// Random cuts through organs that hang and move meanwhile.
#include <doctest/doctest.h>

#include <cmath>
#include <engine/mesh/files.hpp>
#include <heml/mesh/read.hpp>
#include <heml/mesh/surface.hpp>
#include <map>
#include <numeric>
#include <places.hpp>
#include <random>

#include "support.hpp"
#include "world_support.hpp"

namespace heml::cut_organs_test {

using namespace heml::test;

namespace {

WorldSetup hanging(const std::filesystem::path& file, int threads) {
  WorldSetup setup;
  setup.mesh = read_tet_mesh(file);
  const auto [low, high] = std::minmax_element(setup.mesh.nodes.begin(), setup.mesh.nodes.end(),
                                               [](const Vec3& a, const Vec3& b) { return a.y() < b.y(); });
  const double top = high->y() - 0.1 * (high->y() - low->y());
  // Organs of 12 cm, whatever the file's unit: a tenth of each is held.
  setup.boundary.push_back({nodes_where(setup.mesh, [&](const Vec3& X) { return X.y() >= top; })});
  const double size = 0.12 / (high->y() - low->y());
  for (Vec3& X : setup.mesh.nodes) X *= size;
  setup.materials = {{std::nullopt, soft("neo_hookean")}};
  setup.gravity = Vec3(0, -9.81, 0);
  setup.solver.continuation = true;
  setup.solver.rate = 4000;  // little motion between cuts: it is the cuts that are asked for
  setup.solver.threads = threads;
  return setup;
}

struct Rest {
  double volume = 0, least = 1;  ///< m³; smallest element relative to the mean
};

Rest rest_of(const World& world) {
  const TetMesh& mesh = world.setup().mesh;
  Rest rest;
  double least = 1e300;
  for (const int t : world.topology()->elements) {
    const Tet& tet = mesh.tets[static_cast<std::size_t>(t)];
    const auto X = [&](std::size_t c) { return mesh.nodes[static_cast<std::size_t>(tet[c])]; };
    const double volume = signed_volume(X(0), X(1), X(2), X(3));
    rest.volume += volume;
    least = std::min(least, volume);
  }
  rest.least = least * static_cast<double>(world.topology()->elements.size()) / rest.volume;
  return rest;
}

/// Every edge of the surface is passed as often one way as the other.
bool is_closed(const World& world) {
  std::map<std::pair<int, int>, int> passes;
  for (const Triangle& f : extract_boundary(with_elements(world.setup().mesh, world.topology()->elements)).triangles)
    for (std::size_t c = 0; c < 3; ++c) {
      const int a = f[c], b = f[(c + 1) % 3];
      passes[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  return std::all_of(passes.begin(), passes.end(), [](const auto& edge) { return edge.second == 0; });
}

/// Number of parts that share no node and have at least a tenth of the elements.
int large_parts(const TetMesh& mesh) {
  std::vector<int> root(mesh.nodes.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int n) {
    while (root[static_cast<std::size_t>(n)] != n) n = root[static_cast<std::size_t>(n)];
    return n;
  };
  for (const Tet& tet : mesh.tets)
    for (const int n : tet) {
      const int a = find(tet[0]), b = find(n);
      root[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  std::map<int, std::size_t> elements;
  for (const Tet& tet : mesh.tets) ++elements[find(tet[0])];
  return static_cast<int>(std::count_if(elements.begin(), elements.end(),
                                        [&](const auto& part) { return 10 * part.second >= mesh.tets.size(); }));
}

/// The same cuts for the same seed, each seen from where the tissue is at rest.
std::vector<CutTissue> random_cuts(const TetMesh& mesh, int count) {
  std::mt19937 random(11);
  std::uniform_int_distribution<std::size_t> node(0, mesh.nodes.size() - 1);
  std::uniform_real_distribution<double> offset(-0.03, 0.03);
  const auto near_tissue = [&] {
    return Vec3(mesh.nodes[node(random)] + Vec3(offset(random), offset(random), offset(random)));
  };
  std::vector<CutTissue> cuts;
  for (int k = 0; k < count; ++k) {
    const Vec3 start = near_tissue(), way = (near_tissue() - start) / 2,
               blade = (near_tissue() - start).normalized() * 0.03;
    cuts.push_back({{{{start, start + blade}, {start + way, start + way + blade}}}, false});
  }
  return cuts;
}

void check_cuts(const std::filesystem::path& file, int count) {
  const auto one = make_world(hanging(file, 1)), two = make_world(hanging(file, 2));
  const double volume = rest_of(*one).volume;
  int made = 0;
  for (const CutTissue& cut : random_cuts(one->setup().mesh, count)) {
    CAPTURE(made);
    const Status status = one->apply(cut);
    CHECK(status == two->apply(cut));
    made += status.ok();
    one->tick();
    two->tick();
    CAPTURE((one->halt() ? one->halt()->message : ""));
    REQUIRE_FALSE(one->halt());
    const Rest rest = rest_of(*one);
    REQUIRE(std::abs(rest.volume / volume - 1) <= 1e-12);
    REQUIRE(rest.least > 0);
  }
  CHECK(made > count / 2);
  CHECK(is_closed(*one));
  CHECK(one->state_hash() == two->state_hash());
  MESSAGE(made << " cuts, " << one->topology()->elements.size() << " elements, the smallest " << rest_of(*one).least
               << " of the mean");
}

}  // namespace

TEST_CASE("sixty random cuts through the kidney lose nothing, leave it closed and play the same again") {
  check_cuts(test::source_folder() / "assets/meshes/kidney.mesh", 60);
}

TEST_CASE("two hundred random cuts through a liver lose nothing, leave it closed and play the same again") {
  const auto liver = shared_data("liver2.msh");
  if (liver.empty()) {
    MESSAGE("no liver beside the source tree");
    return;
  }
  check_cuts(liver, 200);
}

TEST_CASE("a stroke of sixty sweeps severs a hanging liver, which moves meanwhile") {
  const auto parts_after = [](int sweeps, int ticks) {
    const auto world = make_world(hanging(test::source_folder() / "assets/meshes/liver.mesh", 1));
    Eigen::AlignedBox3d box;
    for (const Vec3& X : world->setup().mesh.nodes) box.extend(X);
    const Vec3 size = box.sizes();
    const auto blade = [&](double way) {
      const Vec3 at = box.center() + Vec3(0.05 * size.x() * std::sin(3 * way), (0.7 - 1.6 * way) * size.y(), 0);
      return std::array<Vec3, 2>{at - Vec3(0, 0, size.z()), at + Vec3(0, 0, size.z())};
    };
    for (int k = 0; k < sweeps; ++k) {
      CutTissue cut{{}, k > 0};
      for (int m = 0; m <= 60 / sweeps; ++m) cut.sweep.blades.push_back(blade((k * 60.0 / sweeps + m) / 60));
      REQUIRE(world->apply(cut).ok());
      for (int tick = 0; tick < ticks; ++tick) world->tick();
    }
    CHECK(world->edits().size() == 1);
    CHECK(is_closed(*world));
    return large_parts(with_elements(world->setup().mesh, world->topology()->elements));
  };
  const int parts = parts_after(1, 0);
  CHECK(parts >= 2);
  CHECK(parts_after(60, 10) == parts);
}

}  // namespace heml::cut_organs_test
