// Whole-state snapshots: restored, a world goes on to the bits of one that never stopped. The cases come from the
// registries of laws, integrators and commands, so that a new one is tested without being named here.
#include <doctest/doctest.h>

#include <heml/materials/material.hpp>
#include <heml/mesh/quadratic.hpp>
#include <utility>

#include "state_support.hpp"
#include "support.hpp"
#include "world_support.hpp"

namespace heml::snapshot_test {

using namespace heml::test;

namespace {

struct Script {
  WorldSetup setup;
  std::vector<Event> events;
  long snapshot_at = 5, end = 10;
};

/// Plays ticks [world.ticks(), end) and appends what is read after each.
std::vector<std::vector<double>> play(World& world, const Script& script, long end) {
  std::vector<std::vector<double>> all;
  for (long tick = world.ticks(); tick < end && !world.halt(); ++tick) {
    for (const Event& event : script.events)
      if (event.tick == tick) {
        const Status status = world.apply(event.command);
        REQUIRE_MESSAGE(status.ok(), status.message());
      }
    world.tick();
    all.push_back(readings_of(world));
  }
  if (world.halt()) all.push_back({double(world.ticks()), double(world.halt()->element), double(world.halt()->node)});
  return all;
}

bool same_bits(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
  const auto bits = [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  };
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [&](const auto& x, const auto& y) {
           return x.size() == y.size() && std::equal(x.begin(), x.end(), y.begin(), bits);
         });
}

void check_restored(const Script& script) {
  const auto never_stopped = make_world(script.setup), world = make_world(script.setup);
  play(*never_stopped, script, script.snapshot_at);
  const auto expected = play(*never_stopped, script, script.end);
  play(*world, script, script.snapshot_at);
  const auto snapshot = world->snapshot();
  CHECK(snapshot->ticks() == world->ticks());
  CHECK(snapshot->time() == world->time());
  CHECK(snapshot->bytes() > 0);
  CHECK(same_bits(play(*world, script, script.end), expected));  // the snapshot has changed nothing
  const long version = world->topology()->version;
  const auto unused = make_world(script.setup);
  for (World* restored : {world.get(), unused.get(), world.get()}) {
    REQUIRE(restored->restore(*snapshot).ok());
    CHECK(restored->ticks() == snapshot->ticks());
    CHECK(same_bits(play(*restored, script, script.end), expected));
  }
  CHECK(world->topology()->version > version);
  // Worlds that share, in step: none changes what another has.
  const auto another = make_world_from(*snapshot), third = make_world_from(*snapshot);
  CHECK(&another->setup().mesh == &third->setup().mesh);
  REQUIRE(world->restore(*snapshot).ok());
  std::vector<std::vector<double>> of_another, of_world;
  for (long tick = snapshot->ticks() + 1; tick <= script.end; ++tick) {
    for (auto [played, all] : {std::pair(another.get(), &of_another), std::pair(world.get(), &of_world)})
      for (auto& readings : play(*played, script, tick)) all->push_back(std::move(readings));
  }
  CHECK(same_bits(of_another, expected));
  CHECK(same_bits(of_world, expected));
  CHECK(same_bits(play(*third, script, script.end), expected));
}

const std::vector<Integrator> of_each_kind = {Integrator::verlet, Integrator::backward_euler, Integrator::bdf2,
                                              Integrator::automatic};

}  // namespace

TEST_CASE("snapshot: every law with all that its material may remember, before and after edits") {
  for (const LawInfo& law : laws()) {
    CAPTURE(std::string(law.name));
    if (law.name.starts_with("paper_")) continue;
    bool single = false;  // in turn
    const Material sample = sample_material(law.name);
    for (const Material& material : law.is_continuum ? with_internal_state(sample) : std::vector{sample})
      for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler}) {
        single = integrator == Integrator::verlet ? !single : single;
        CAPTURE(single);
        CAPTURE(integrator_name(integrator));
        const WorldSetup setup = bar(material, integrator, single);
        check_restored({setup, {{2, blade_at(0.034)}, {6, RemoveElements{{{1, 3}, {}, {}, {}}}}, {7, Undo{}}}, 4, 9});
      }
  }
}

TEST_CASE("snapshot: every integrator, statics and the automatic choice too") {
  Material material = sample_material("mooney_rivlin");
  material.viscosity = 2;
  material.relaxation = {{0.5, 0.01}};
  material.plasticity = Plasticity{60, 10};
  for (const IntegratorInfo& info : all_integrators())
    for (const Material& of_two : {material, sample_material("neo_hookean")})
      for (const bool single : {false, true})
        for (const long at : {0L, 5L}) {
          CAPTURE(info.name);
          CAPTURE(single);
          CAPTURE(at);
          check_restored({bar(of_two, info.id, single), {{1, example(Grasp{})}, {6, example(MoveTool{})}}, at, 10});
        }
}

TEST_CASE("snapshot: implicit and static solvers, whatever preconditions them, also where elements are gone") {
  for (const Integrator integrator : {Integrator::bdf2, Integrator::static_equilibrium})
    for (const Minimiser minimiser : {Minimiser::newton, Minimiser::lbfgs})
      for (const Preconditioner preconditioner : {Preconditioner::cholesky, Preconditioner::block_jacobi,
                                                  Preconditioner::scalar, Preconditioner::multilevel}) {
        WorldSetup setup = bar(sample_material("neo_hookean"), integrator, false);
        setup.solver.minimiser = minimiser;
        setup.solver.preconditioner = preconditioner;
        CAPTURE(integrator_name(integrator));
        CAPTURE(static_cast<int>(minimiser));
        CAPTURE(static_cast<int>(preconditioner));
        check_restored({setup, {{2, example(RemoveElements{})}, {7, blade_at(0.05)}}, 4, 10});
        setup.solver.nodal_pressure = true;
        check_restored({setup, {{2, example(RemoveElements{})}}, 4, 8});
      }
}

TEST_CASE("snapshot: every command, before the snapshot and after it, in and out of contact") {
  for (const Command& command : examples())
    for (const Integrator integrator : of_each_kind)
      for (const bool single : {false, true}) {
        CAPTURE(command.index());
        CAPTURE(integrator_name(integrator));
        CAPTURE(single);
        std::vector<Event> first, later;
        for (const Command& earlier : before(command)) first.push_back({1, earlier}), later.push_back({6, earlier});
        first.push_back({2, command}), later.push_back({7, command});
        WorldSetup setup = bar_in_contact(integrator, single);
        setup.solver.mass_scaling = single ? 0.1 : 0;
        for (const std::vector<Event>& events : {first, later}) check_restored({setup, events, 5, 10});
      }
}

TEST_CASE("snapshot: quadratic elements, every command, before the snapshot and after it") {
  bool mean_dilatation = false;  // in turn
  for (const Command& command : examples()) {
    mean_dilatation = !mean_dilatation;
    for (const Integrator integrator : {Integrator::verlet, Integrator::bdf2, Integrator::static_equilibrium}) {
      const bool is_implicit = integrator != Integrator::verlet;
      if (is_implicit && !std::holds_alternative<Grasp>(command) && !std::holds_alternative<MoveProbe>(command) &&
          !is_edit(command))
        continue;
      CAPTURE(command.index());
      CAPTURE(integrator_name(integrator));
      CAPTURE(mean_dilatation);
      WorldSetup setup = bar_in_contact(integrator, integrator == Integrator::verlet && mean_dilatation);
      setup.mesh = make_box(Vec3(0.06, 0.02, 0.02), {4, 1, 1});
      setup.self_contact.reset();
      setup.boundary[0].nodes = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; });
      setup.midedges = add_midedge_nodes(setup.mesh);
      setup.solver.quadratic = true;
      setup.solver.nodal_pressure = mean_dilatation;
      setup.solver.mass_scaling = mean_dilatation ? 0.1 : 0;
      Command accepted = command;
      if (auto* change = std::get_if<SetMaterial>(&accepted)) change->material = sample_material("neo_hookean_iso");
      if (auto* removal = std::get_if<RemoveElements>(&accepted)) removal->which.tets = {3, 17};
      if (auto* tag = std::get_if<TagRegion>(&accepted)) {
        tag->tag.which.tets = {3, 17};
        tag->material = sample_material("neo_hookean_iso");
      }
      std::vector<Event> events;
      for (const Command& earlier : before(command)) events.push_back({is_implicit ? 3 : 1, earlier});
      events.push_back({1, accepted});
      if (is_implicit) events.back().tick = 4;
      check_restored({setup, events, 2, 5});
    }
  }
}

TEST_CASE("snapshot: scripts of random commands, restored to random moments in any order") {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    Script script{bar_in_contact(of_each_kind[seed % of_each_kind.size()], seed % 3 == 0), {}, 0, 16};
    for (long tick = 1; tick < 14; ++tick) {
      const std::vector<Command> all = examples();
      const Command& command = all[random() % all.size()];
      for (const Command& earlier : before(command)) script.events.push_back({tick, earlier});
      script.events.push_back({tick, command});
    }
    // What the state makes of a command is not asked here: one that is refused changes nothing.
    const auto play_to = [&](World& world, long end) {
      for (long tick = world.ticks(); tick < end && !world.halt(); ++tick) {
        for (const Event& event : script.events)
          if (event.tick == tick) static_cast<void>(world.apply(event.command));
        world.tick();
      }
      return readings_of(world);
    };
    const auto plain = make_world(script.setup), world = make_world(script.setup);
    std::vector<std::shared_ptr<const WorldSnapshot>> snapshots = {world->snapshot()};
    std::vector<std::vector<double>> expected = {readings_of(*plain)};
    for (long tick = 1; tick <= script.end; ++tick) {
      expected.push_back(play_to(*plain, tick));
      play_to(*world, tick);
      snapshots.push_back(world->snapshot());
    }
    for (int k = 0; k < 8; ++k) {
      const std::size_t from = random() % snapshots.size();
      const std::size_t to = from + random() % (snapshots.size() - from);
      CAPTURE(from);
      CAPTURE(to);
      REQUIRE(world->restore(*snapshots[from]).ok());
      play_to(*world, static_cast<long>(to));
      CHECK(same_bits({readings_of(*world)}, {expected[to]}));
    }
  }
}

TEST_CASE("snapshot: during a recovery, before it and after it") {
  for (const bool single : {false, true})
    for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler})
      for (const long at : {0L, 1L, 3L, 30L}) {
        CAPTURE(integrator_name(integrator));
        CAPTURE(at);
        WorldSetup setup = bar(sample_material("neo_hookean"), integrator, single);
        setup.solver.continuation = false;
        setup.solver.recovery = true;
        setup.solver.rate = 60;
        for (const Vec3& X : setup.mesh.nodes)
          setup.initial_positions.push_back(X.x() < 1e-9 ? X : Vec3(X.x() * 0.1, X.y(), 0.02 - X.z()));
        check_restored({setup, {{2, example(Grasp{})}, {5, example(CutTissue{})}}, at, at + 12});
      }
}

TEST_CASE("snapshot: tissue that tears") {
  for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler}) {
    WorldSetup setup = bar(soft(), integrator, false);
    setup.tearing = TearingSettings{1.5};
    Boundary right{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 0.06 - 1e-9; })};
    right.translate = Vec3(0.06, 0, 0);
    right.ramp_time = 0.08;
    setup.boundary.push_back(right);
    const auto world = make_world(setup);
    for (int k = 0; k < 16; ++k) world->tick();
    REQUIRE_FALSE(world->edits().empty());
    for (const long at : {4L, 12L, 15L}) check_restored({setup, {}, at, 20});
  }
}

TEST_CASE("snapshot: outlives its world, and shares the mesh with others of the same elements") {
  const WorldSetup setup = bar(sample_material("neo_hookean"), Integrator::verlet, false);
  std::shared_ptr<const WorldSnapshot> snapshot;
  std::uint64_t expected = 0;
  {
    const auto world = make_world(setup);
    for (int k = 0; k < 3; ++k) world->tick();
    snapshot = world->snapshot();
    world->tick();
    expected = world->state_hash();
  }
  const auto world = make_world(setup);
  REQUIRE(world->restore(*snapshot).ok());
  world->tick();
  CHECK(world->state_hash() == expected);
}

TEST_CASE("snapshot: refused by a world of another body or precision, which is left as it was") {
  const WorldSetup setup = bar(sample_material("neo_hookean"), Integrator::verlet, false);
  const auto snapshot = make_world(setup)->snapshot();
  WorldSetup in_float = setup, other_mesh = setup, other_options = setup;
  in_float.solver.single_precision = true;
  other_mesh.mesh.nodes.back().x() += 1e-6;
  other_options.solver.nodal_pressure = true;
  for (const WorldSetup& other : {in_float, other_mesh, other_options}) {
    const auto world = make_world(other);
    world->tick();
    const std::uint64_t before = world->state_hash();
    CHECK_FALSE(world->restore(*snapshot).ok());
    CHECK(world->state_hash() == before);
    CHECK(world->ticks() == 1);
  }
}

}  // namespace heml::snapshot_test
