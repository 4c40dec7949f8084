// Elements that become a region while a world runs: as if the mesh had had it, and taken back.
#include <algorithm>
#include <heml/mesh/region_tag.hpp>

#include "messages.hpp"
#include "state_support.hpp"

namespace heml::region_test {

using namespace heml::test;

namespace {

void tick(World& world, int times) {
  for (int k = 0; k < times; ++k) world.tick();
}

void expect(const Status& status) { REQUIRE_MESSAGE(status.ok(), status.message()); }

const std::vector<int> lesion{3, 4, 5, 17, 30};

TagRegion tag_of(std::vector<int> tets, std::optional<Material> material = {}, std::string name = "lesion") {
  return {{{}, {std::move(tets), {}, {}, {}}, std::move(name), {}}, std::move(material)};
}

Material stiff(const char* law = "mooney_rivlin") { return sample_material(law); }

/// The same body, of a mesh that has the region already.
WorldSetup with_region(WorldSetup setup, const Material& material) {
  tag_region({1, "lesion", lesion}, setup.mesh);
  setup.materials.push_back({1, material});
  return setup;
}

}  // namespace

TEST_CASE("region: made before the first tick it gives the bits of a world made with it") {
  for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler, Integrator::static_equilibrium})
    for (const bool quadratic : {false, true})
      for (const Material& material : with_internal_state(stiff())) {
        if (quadratic && is_explicit(integrator)) continue;
        if (integrator == Integrator::static_equilibrium && material.plasticity) continue;
        CAPTURE(integrator_name(integrator));
        CAPTURE(quadratic);
        WorldSetup setup = bar(sample_material("neo_hookean"), integrator, false);
        setup.solver.quadratic = quadratic;
        if (quadratic) setup.midedges = add_midedge_nodes(setup.mesh);
        const auto made = make_world(with_region(setup, material)), set = make_world(setup);
        expect(set->apply(tag_of(lesion, material)));
        tick(*made, 6);
        tick(*set, 6);
        CHECK_FALSE(made->halt());
        CHECK(set->setup().mesh.regions == made->setup().mesh.regions);
        CHECK(set->positions() == made->positions());
        CHECK(set->velocities() == made->velocities());
        CHECK(set->stable_step() == made->stable_step());
      }
}

TEST_CASE("region: any number of threads gives the same bits") {
  std::vector<std::vector<Vec3>> ends;
  for (const int threads : {1, 3}) {
    WorldSetup setup = bar(sample_material("neo_hookean"), Integrator::backward_euler, true);
    setup.solver.threads = threads;
    const auto world = make_world(setup);
    tick(*world, 2);
    expect(world->apply(tag_of(lesion, stiff())));
    tick(*world, 4);
    ends.push_back(world->positions());
  }
  CHECK(ends[0] == ends[1]);
}

TEST_CASE("region: without a material nothing moves otherwise, and the region can be given one later") {
  const auto world = make_world(bar(sample_material("neo_hookean"), Integrator::backward_euler, false));
  tick(*world, 3);
  const double elastic = world->energies().elastic;
  const auto positions = world->positions();
  const long version = world->topology()->version;
  expect(world->apply(tag_of(lesion)));
  CHECK(world->positions() == positions);
  const auto change = [&] { return std::abs(world->energies().elastic / elastic - 1); };
  CHECK(change() < 1e-12);
  CHECK(world->topology()->version > version);
  CHECK(world->setup().mesh.region_names.at(1) == "lesion");
  REQUIRE(world->setup().materials.size() == 2);
  CHECK(world->setup().materials[1].region == 1);
  CHECK(world->setup().materials[1].material == world->setup().materials[0].material);
  CHECK(world->setup().tagged == std::vector{TaggedRegion{1, "lesion", lesion}});
  expect(world->apply(SetMaterial{1, stiff()}));
  CHECK(change() > 0.01);
}

TEST_CASE("region: what keeps its material remembers, what gets another begins relaxed") {
  Material soft = sample_material("mooney_rivlin");
  soft.relaxation = {{2, 10}};  // forgets nothing within the test
  const auto world = make_world(bar(soft, Integrator::backward_euler, false)),
             same = make_world(bar(soft, Integrator::backward_euler, false));
  tick(*world, 5);
  tick(*same, 5);
  Material other = soft;
  other.density += 1e-9;
  expect(world->apply(tag_of({7}, other)));
  tick(*world, 1);
  tick(*same, 1);
  const auto distance = [&] { return rms_difference(world->positions(), same->positions()); };
  const double one = distance();
  std::vector<int> all(same->setup().mesh.tets.size());
  for (std::size_t t = 0; t < all.size(); ++t) all[t] = static_cast<int>(t);
  const auto forgets = make_world(bar(soft, Integrator::backward_euler, false));
  tick(*forgets, 5);
  expect(forgets->apply(tag_of(all, other)));
  tick(*forgets, 1);
  CHECK(one > 0);
  CHECK(one < 0.2 * rms_difference(forgets->positions(), same->positions()));
}

TEST_CASE("region: undo and redo go back and forth to the bit") {
  const auto world = make_world(bar(sample_material("neo_hookean"), Integrator::verlet, false)),
             same = make_world(bar(sample_material("neo_hookean"), Integrator::verlet, false));
  tick(*world, 3);
  tick(*same, 3);
  expect(world->apply(tag_of(lesion, stiff())));
  tick(*world, 2);
  const auto changed = world->positions();
  const auto plain = make_world(bar(sample_material("neo_hookean"), Integrator::verlet, false));
  tick(*plain, 5);
  CHECK(changed != plain->positions());
  expect(world->apply(StepHistory{-1}));
  CHECK(world->setup().mesh.regions == same->setup().mesh.regions);
  CHECK(world->setup().materials.size() == 1);
  CHECK(world->setup().tagged.empty());
  tick(*world, 4);
  tick(*same, 4);
  CHECK(world->positions() == same->positions());
  expect(world->apply(StepHistory{-1}).ok() ? Status("there was more to undo") : Status());
  const auto again = make_world(bar(sample_material("neo_hookean"), Integrator::verlet, false));
  tick(*again, 3);
  expect(again->apply(tag_of(lesion, stiff())));
  tick(*again, 2);
  CHECK(again->positions() == changed);
  expect(again->apply(StepHistory{-1}));
  expect(again->apply(StepHistory{1}));
  CHECK(again->setup().tagged.size() == 1);
  CHECK(again->positions() == changed);
}

TEST_CASE("region: it outlasts a reset, and a cut or removal that is taken back or reset") {
  for (const Command& edit : {example(CutTissue{}), example(RemoveElements{})})
    for (const Command& end : {Command(Reset{}), Command(Undo{})}) {
      const auto world = make_world(bar(sample_material("neo_hookean"), Integrator::verlet, false));
      const std::size_t tets = world->setup().mesh.tets.size();
      expect(world->apply(edit));
      std::vector<int> chosen{0, 1};
      if (world->setup().mesh.tets.size() > tets) chosen.push_back(static_cast<int>(tets));  // a piece
      expect(world->apply(tag_of(chosen, stiff())));
      tick(*world, 2);
      expect(world->apply(end));
      const WorldSetup& now = world->setup();
      CHECK(now.mesh.tets.size() == tets);
      CHECK(now.tagged == std::vector{TaggedRegion{1, "lesion", {0, 1}}});
      WorldSetup expected = bar(sample_material("neo_hookean"), Integrator::verlet, false);
      tag_region({1, "lesion", {0, 1}}, expected.mesh);
      CHECK(now.mesh.regions == expected.mesh.regions);
      if (!std::holds_alternative<Reset>(end)) continue;
      expected.materials.push_back({1, stiff()});
      const auto made = make_world(expected);
      tick(*made, 5);
      tick(*world, 5);
      CHECK(rms_difference(world->positions(), made->positions()) < 1e-12);
    }
}

TEST_CASE("region: elements join one that is there, whose material may be changed with it") {
  const auto world = make_world(bar(sample_material("neo_hookean"), Integrator::verlet, false));
  expect(world->apply(tag_of({3, 4}, stiff())));
  expect(world->apply(tag_of({5, 17, 30})));
  CHECK(world->setup().materials.size() == 2);
  const auto made = make_world(with_region(bar(sample_material("neo_hookean"), Integrator::verlet, false), stiff()));
  tick(*world, 4);
  tick(*made, 4);
  CHECK(world->positions() == made->positions());
  expect(world->apply(tag_of({3}, sample_material("yeoh"))));
  CHECK(world->setup().materials[1].material == sample_material("yeoh"));
}

TEST_CASE("region: wrong ones are refused and change nothing") {
  WorldSetup setup = bar(sample_material("neo_hookean"), Integrator::verlet, false);
  setup.solver.nodal_pressure = true;
  setup.materials[0].material = sample_material("mooney_rivlin");
  const auto world = make_world(setup);
  const auto hash = world->state_hash();
  TagRegion few;
  few.tag = {{0, 1}, {}, "few", {}};
  for (const Command& wrong :
       {Command(tag_of({})), Command(tag_of({5000})), Command(tag_of({1}, {}, "")), Command(few),
        Command(tag_of({1}, sample_material("neo_hookean")))}) {  // has no volume term
    const Status status = world->apply(wrong);
    CHECK_FALSE(status.ok());
    CHECK(status.message().starts_with("region: "));
  }
  CHECK(world->setup().materials.size() == 1);
  CHECK(world->setup().tagged.empty());
  CHECK(world->state_hash() == hash);
}

}  // namespace heml::region_test
