// Burns of a running world: what shrinks comes to rest smaller, is kept by later edits and taken back with the stroke.
#include <algorithm>
#include <cmath>
#include <heml/materials/point.hpp>
#include <heml/mesh/quadratic.hpp>
#include <limits>

#include "messages.hpp"
#include "state_support.hpp"

namespace heml::cautery_test {

using namespace heml::test;

namespace {

void tick(World& world, int times) {
  for (int k = 0; k < times; ++k) world.tick();
}

void expect(const Status& status) { REQUIRE_MESSAGE(status.ok(), status.message()); }

/// Heat that reaches all of a body.
CauterizeTissue all_of(const WorldSetup& setup, double shrink) {
  const Vec3 middle = setup.mesh.nodes[setup.mesh.nodes.size() / 2];
  return {{{{middle, middle}}}, {10, shrink}};
}

/// On the upper side of a block, across it.
CauterizeTissue stroke(double x, bool continues = false) {
  return {{{{Vec3(x, 0.02, -0.01), Vec3(x, 0.02, -0.01)}, {Vec3(x, 0.02, 0.03), Vec3(x, 0.02, 0.03)}}},
          {0.008, usual_shrink},
          continues};
}

/// A block that may slide on three planes through its lowest corner: free to shrink.
WorldSetup free_block(const Material& material, Integrator integrator) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(0.04, 0.03, 0.02), {2, 2, 1});
  setup.materials = {{std::nullopt, material}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Boundary plane{nodes_where(setup.mesh, [&](const Vec3& X) { return X[static_cast<int>(axis)] < 1e-9; })};
    plane.axes = AxisSet::none();
    plane.axes.has[axis] = true;
    setup.boundary.push_back(plane);
  }
  setup.solver.integrator = integrator;
  setup.solver.threads = 1;
  setup.solver.damping = 60;
  setup.solver.continuation = true;
  if (!is_explicit(integrator)) setup.solver.rate = 100;
  return setup;
}

double max_error(const World& world, double scale) {
  const auto x = world.positions();
  double worst = 0;
  for (std::size_t n = 0; n < x.size(); ++n)
    worst = std::max(worst, (x[n] - scale * world.setup().mesh.nodes[n]).norm());
  return worst;
}

void make_quadratic(WorldSetup& setup) {
  setup.solver.quadratic = true;
  setup.midedges = add_midedge_nodes(setup.mesh);
  for (std::size_t axis = 0; axis < setup.boundary.size(); ++axis)
    setup.boundary[axis].nodes =
        nodes_where(setup.mesh, [&](const Vec3& X) { return X[static_cast<int>(axis)] < 1e-9; });
}

}  // namespace

TEST_CASE("cautery: a free block burnt all through rests at its size times the shrink, without stress, any law") {
  constexpr double shrink = 0.2;
  for (const LawInfo& law : laws())
    for (const Integrator integrator :
         {Integrator::verlet, Integrator::backward_euler, Integrator::static_equilibrium})
      for (const bool quadratic : {false, true})
        for (const bool single : {false, true}) {
          if (quadratic && !law.is_continuum) continue;
          if (!law.is_stress_free) continue;
          CAPTURE(std::string(law.name));
          CAPTURE(integrator_name(integrator));
          CAPTURE(quadratic);
          CAPTURE(single);
          WorldSetup setup = free_block(sample_material(law.name), integrator);
          setup.solver.single_precision = single;
          if (quadratic) make_quadratic(setup);
          const auto world = make_world(setup);
          expect(world->apply(all_of(setup, shrink)));
          double elastic = 0;  // the most there was
          if (integrator == Integrator::static_equilibrium)
            world->load_to(1);
          else
            while (world->time() < 0.8 && !world->halt()) {
              world->tick();
              elastic = std::max(elastic, world->energies().elastic);
            }
          REQUIRE_MESSAGE(!world->halt(), world->halt()->message);
          CHECK(max_error(*world, 1 - shrink) <= (single ? 1e-5 : 1e-6) * 0.05);
          if (elastic > 0) CHECK(std::abs(world->energies().elastic) <= (single ? 1e-3 : 1e-4) * elastic);
          for (const double J : world->volume_ratios()) CHECK(J == doctest::Approx(1).epsilon(1e-4));
        }
}

TEST_CASE("cautery: a bar held at both ends pulls by the stress of its law at the inverse stretch") {
  // Held in full at all nodes, so that every element keeps its shape: P of the law at F = I/s, over the area of an end.
  constexpr double shrink = 0.15, scale = 1 - shrink, h = 1e-5;
  for (const auto law : {"neo_hookean", "mooney_rivlin", "ogden", "hgo", "gent"}) {
    CAPTURE(std::string(law));
    WorldSetup setup = free_block(sample_material(law), Integrator::backward_euler);
    setup.boundary = {{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })},
                      {nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 1e-9; })}};
    const auto world = make_world(setup);
    expect(world->apply(all_of(setup, shrink)));
    tick(*world, 12);
    const auto point = make_material_point(setup.materials[0].material, true);
    Vec3 expected;
    for (int i = 0; i < 3; ++i) {
      const auto W = [&](double by) {
        Mat3 F = Mat3::Identity() / scale;
        F(i, 0) += by;
        return point->energy(F);
      };
      expected[i] = (8 * (W(h) - W(-h)) - (W(2 * h) - W(-2 * h))) / (12 * h) * scale * scale * 0.03 * 0.02;
    }
    // The support pulls the wall at x = 0 outwards, against what contracts.
    CHECK((world->reactions()[0] + expected).norm() <= 1e-6 * expected.norm());
  }
}

TEST_CASE("cautery: strokes shrink the tissue, and no element is inverted at once, explicit and implicit") {
  for (const double poisson : {0.3, 0.45, 0.49})
    for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler, Integrator::bdf2})
      for (const double shrink : {usual_shrink, max_shrink}) {
        CAPTURE(poisson);
        CAPTURE(integrator_name(integrator));
        CAPTURE(shrink);
        WorldSetup setup = cantilever();
        setup.materials[0].material = soft("neo_hookean", 1e4, poisson);
        setup.solver.integrator = integrator;
        if (!is_explicit(integrator)) setup.solver.rate = 200;
        const auto world = make_world(setup);
        double min_J = 1;
        for (int k = 0; k < 8; ++k) {
          CauterizeTissue burn = stroke(0.03 + 0.005 * k, k > 0);
          for (auto& blade : burn.sweep.blades)
            for (Vec3& end : blade) end.y() = 0.02 + 0.5 * (world->positions()[32 + 2].y() - 0.02);
          burn.heat.shrink = shrink;
          expect(world->apply(burn));
          for (int step = 0; step < (is_explicit(integrator) ? 20 : 4); ++step) {
            world->tick();
            const auto J = world->volume_ratios();
            min_J = std::min(min_J, *std::min_element(J.begin(), J.end()));
          }
        }
        REQUIRE_MESSAGE(!world->halt(), world->halt()->message);
        CHECK(min_J > 0.2);
        CHECK(world->edits().size() == 1);
        CHECK(world->edits()[0].burnt > 0);
      }
}

TEST_CASE("cautery: an electrode with depth parts the tissue, and both sides of the wound are burnt") {
  const auto world = make_world(cantilever());
  CauterizeTissue through = stroke(0.05);
  for (auto& blade : through.sweep.blades) blade[0].y() = 0.03, blade[1].y() = 0.008;
  expect(world->apply(through));
  REQUIRE(world->edits().size() == 1);
  const EditReport& edit = world->edits()[0];
  CHECK(edit.split > 0);
  CHECK(edit.burnt > 0);
  CHECK(edit.area == doctest::Approx(0.02 * 0.012).epsilon(0.2));
  const TetMesh& mesh = world->setup().mesh;
  REQUIRE(mesh.burns.size() == mesh.tets.size());
  // Nodes that lie together are those of the wound.
  std::size_t in_wound = 0;
  for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      if (mesh.nodes[a] != mesh.nodes[b]) continue;
      ++in_wound;
      for (const int t : world->topology()->elements)
        for (const int n : mesh.tets[static_cast<std::size_t>(t)])
          if (n == static_cast<int>(a) || n == static_cast<int>(b))
            CHECK(mesh.burns[static_cast<std::size_t>(t)].level == doctest::Approx(1));
    }
  CHECK(in_wound >= 3);
  tick(*world, 130);
  CHECK_FALSE(world->halt());
}

TEST_CASE("cautery: an electrode parts tissue with nodal pressure, at once and later") {
  // A burn that contracts nothing yet has copied the layout, to which averaged pressure refers.
  for (const bool undone : {false, true}) {
    WorldSetup setup = cantilever();
    setup.solver.nodal_pressure = true;
    const auto world = make_world(setup);
    tick(*world, 3);
    CauterizeTissue through = stroke(0.05);
    for (auto& blade : through.sweep.blades) blade[0].y() = 0.1, blade[1].y() = -0.1;
    expect(world->apply(through));
    REQUIRE(world->edits().size() == 1);
    CHECK(world->edits()[0].split > 0);
    if (undone) expect(world->apply(StepHistory{-1}));
    tick(*world, 60);
    CHECK_FALSE(world->halt());
  }
}

TEST_CASE("cautery: a stroke twice burns as once, and what is cut from burnt tissue inherits") {
  const WorldSetup setup = cantilever();
  const auto once = make_world(setup), twice = make_world(setup);
  expect(once->apply(stroke(0.05)));
  expect(twice->apply(stroke(0.05)));
  expect(twice->apply(stroke(0.05, true)));
  expect(twice->apply(stroke(0.05)));
  CHECK(twice->edits().size() == 1);
  CHECK(twice->edits()[0].burnt == once->edits()[0].burnt);
  tick(*once, 120);
  tick(*twice, 120);
  for (const Burn& burn : once->setup().mesh.burns) CHECK(burn.scale == 1 - burn.shrink);
  CHECK(once->state_hash() == twice->state_hash());
  const double elastic = once->energies().elastic;
  expect(once->apply(blade_at(0.049)));
  const TetMesh& mesh = once->setup().mesh;
  REQUIRE(mesh.burns.size() == mesh.tets.size());
  const auto is_burnt = [](const Burn& burn) { return burn.level > 0; };
  const auto of_pieces = mesh.burns.begin() + static_cast<std::ptrdiff_t>(setup.mesh.tets.size());
  CHECK(std::any_of(of_pieces, mesh.burns.end(), is_burnt));
  // Pieces store the energy of the whole: their rest shapes have shrunk as it has.
  CHECK(once->energies().elastic == doctest::Approx(elastic).epsilon(1e-9));
}

TEST_CASE("cautery: undo gives back the bits of before, of a whole stroke, and reset the unburnt body") {
  for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler}) {
    CAPTURE(integrator_name(integrator));
    WorldSetup setup = cantilever();
    setup.solver.integrator = integrator;
    const auto world = make_world(setup), never = make_world(setup);
    tick(*world, 10);
    tick(*never, 10);
    expect(world->apply(stroke(0.04)));
    expect(world->apply(stroke(0.045, true)));
    expect(world->apply(Undo{}));
    CHECK(world->edits().empty());
    CHECK(world->setup().mesh.burns.empty());
    tick(*world, 10);
    tick(*never, 10);
    CHECK(readings_of(*world) == readings_of(*never));

    expect(world->apply(stroke(0.04)));
    expect(world->apply(stroke(0.045, true)));
    tick(*world, 30);
    const auto burnt = readings_of(*world);
    const double then = world->time();
    expect(world->apply(StepHistory{-1}));
    CHECK(world->setup().mesh.burns.empty());
    CHECK(world->state_hash() == never->state_hash());
    expect(world->apply(StepHistory{1}));
    CHECK(world->setup().mesh.burns.size() == setup.mesh.tets.size());
    CHECK(world->time() == then);
    CHECK(readings_of(*world) == burnt);

    expect(world->apply(Reset{}));
    CHECK(world->setup().mesh.burns.empty());
    tick(*world, 10);
    const auto fresh = make_world(setup);
    tick(*fresh, 10);
    CHECK(world->positions() == fresh->positions());
  }
}

TEST_CASE("cautery: any number of threads gives the same bits") {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 3}) {
    WorldSetup setup = cantilever();
    setup.mesh = make_box(Vec3(0.1, 0.02, 0.02), {30, 8, 8});
    setup.boundary = {{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })}};
    setup.solver.threads = threads;
    const auto world = make_world(setup);
    tick(*world, 2);
    CauterizeTissue deep = stroke(0.05);
    for (auto& blade : deep.sweep.blades) blade[0].y() = 0.03, blade[1].y() = 0.012;
    expect(world->apply(deep));
    tick(*world, 25);
    hashes.push_back(world->state_hash());
  }
  CHECK(hashes[0] == hashes[1]);
}

TEST_CASE("cautery: mass stays, to the bit, and so does momentum in free fall") {
  WorldSetup setup = cantilever();
  setup.boundary.clear();
  setup.gravity.setZero();
  const auto world = make_world(setup);
  expect(world->apply(stroke(0.05)));
  tick(*world, 50);
  CHECK_FALSE(world->halt());
  Vec3 centre = Vec3::Zero(), at_rest = Vec3::Zero();
  double mass = 0;
  for (const Tet& tet : setup.mesh.tets) {
    const auto X = [&](std::size_t c) { return setup.mesh.nodes[static_cast<std::size_t>(tet[c])]; };
    const double share = signed_volume(X(0), X(1), X(2), X(3)) / 4;
    for (const int n : tet) {
      centre += share * world->positions()[static_cast<std::size_t>(n)];
      at_rest += share * setup.mesh.nodes[static_cast<std::size_t>(n)];
    }
    mass += 4 * share;
  }
  CHECK((centre - at_rest).norm() / mass < 1e-12);
}

TEST_CASE("cautery: what cannot be meant is refused and changes nothing") {
  const auto world = make_world(cantilever());
  const auto refused = [&](const CauterizeTissue& command) {
    const std::uint64_t before = world->state_hash();
    const std::string message = world->apply(command).message();
    CHECK(world->edits().empty());
    CHECK(world->setup().mesh.burns.empty());
    CHECK(world->state_hash() == before);
    return message;
  };
  CauterizeTissue bad = stroke(0.05);
  bad.sweep.blades.clear();
  CHECK(says(refused(bad), "the electrode is nowhere"));
  bad = stroke(std::nan(""));
  CHECK(says(refused(bad), "not finite"));
  for (const double radius : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    bad = stroke(0.05);
    bad.heat.radius = radius;
    CHECK(says(refused(bad), "radius must be more than 0 m"));
  }
  for (const double shrink : {-0.1, 0.51, 1.0, std::nan("")}) {
    bad = stroke(0.05);
    bad.heat.shrink = shrink;
    CHECK(says(refused(bad), "shrink must be 0 to 0.5"));
  }
  expect(world->apply(stroke(5)));  // through the air
  CHECK(world->edits().empty());
  CHECK(says(world->apply(Undo{}).message(), "the electrode of step 0 burnt nothing"));
}

}  // namespace heml::cautery_test
