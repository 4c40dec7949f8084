// Elements removed from a body that lives.
#include <doctest/doctest.h>

#include <algorithm>
#include <heml/materials/point.hpp>
#include <heml/mesh/surface.hpp>
#include <heml/world/model.hpp>
#include <map>
#include <numeric>

#include "engine/materials/sample_materials.hpp"
#include "support.hpp"
#include "world_support.hpp"

namespace heml::removal_test {

using namespace heml::test;

namespace {

RemoveElements elements(std::vector<int> tets) { return {{std::move(tets), {}, {}, {}}}; }

/// Elements of the box mesh from x = low to x = high.
RemoveElements slab(double low, double high) { return {{{}, {}, std::array{Vec3(low, -1, -1), Vec3(high, 1, 1)}, {}}}; }

/// n of 0 .. count − 1 in an order of their own.
std::vector<int> shuffled(int count, std::mt19937_64& random) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[random() % (i + 1)]);
  return order;
}

struct Parts {
  Energies energy;
  double mass = 0;
};

/// What one element has at the world's state, from W(F) and its lumped mass: nothing of the body's own loops.
Parts parts_of(const World& world, int element, const std::vector<Vec3>& x, const std::vector<Vec3>& v) {
  const WorldSetup& setup = world.setup();
  const Material& material = setup.materials[0].material;
  const Tet& tet = setup.mesh.tets[static_cast<std::size_t>(element)];
  const auto edges = [&](const std::vector<Vec3>& at) {
    Mat3 D;
    const auto p = [&](std::size_t c) { return at[static_cast<std::size_t>(tet[c])]; };
    D << p(1) - p(0), p(2) - p(0), p(3) - p(0);
    return D;
  };
  const Mat3 Dm = edges(setup.mesh.nodes);
  const double volume = Dm.determinant() / 6;
  Parts parts;
  parts.mass = material.density * volume;
  parts.energy.elastic =
      volume * make_material_point(material, setup.solver.continuation)->energy(edges(x) * Dm.inverse());
  for (const int n : tet) {
    const auto k = static_cast<std::size_t>(n);
    parts.energy.kinetic += parts.mass / 8 * v[k].squaredNorm();
    parts.energy.potential -= parts.mass / 4 * setup.gravity.dot(x[k] - setup.mesh.nodes[k]);
  }
  return parts;
}

/// Whether the boundary of what is there closes: every edge of it is run along as often one way as the other, and it
/// encloses the elements' volume.
void check_closed(const World& world) {
  const TetMesh& mesh = world.setup().mesh;
  double volume = 0, enclosed = 0;
  std::map<std::array<int, 3>, std::array<int, 3>> faces;  // sorted, as wound; gone when met twice
  const auto X = [&](int n) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(n)]; };
  for (const int t : world.topology()->elements) {
    const auto& [a, b, c, d] = mesh.tets[static_cast<std::size_t>(t)];
    volume += signed_volume(X(a), X(b), X(c), X(d));
    for (const std::array<int, 3>& face : {std::array{b, c, d}, {a, d, c}, {a, b, d}, {a, c, b}}) {
      std::array<int, 3> sorted = face;
      std::sort(sorted.begin(), sorted.end());
      if (!faces.emplace(sorted, face).second) faces.erase(sorted);
    }
  }
  std::map<std::pair<int, int>, int> balance;
  for (const auto& [sorted, face] : faces) {
    enclosed += X(face[0]).dot(X(face[1]).cross(X(face[2]))) / 6;
    for (std::size_t k = 0; k < 3; ++k) {
      ++balance[{face[k], face[(k + 1) % 3]}];
      --balance[{face[(k + 1) % 3], face[k]}];
    }
  }
  CHECK(std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; }));
  CHECK(enclosed == doctest::Approx(volume).epsilon(1e-12));
}

}  // namespace

TEST_CASE("a removal takes the energy and mass of its elements, and leaves all that moves as it is") {
  for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler}) {
    WorldSetup setup = cantilever();
    setup.solver.integrator = integrator;
    const auto world = make_world(setup);
    run_until(*world, 0.05);
    const auto x = world->positions(), v = world->velocities();
    const std::vector<int> gone = {3, 40, 41, 77, 150};
    Parts theirs;
    for (const int t : gone) {
      const Parts one = parts_of(*world, t, x, v);
      theirs.mass += one.mass;
      theirs.energy.kinetic += one.energy.kinetic;
      theirs.energy.elastic += one.energy.elastic;
      theirs.energy.potential += one.energy.potential;
    }
    REQUIRE(world->apply(elements(gone)).ok());
    CHECK(world->positions() == x);
    CHECK(world->velocities() == v);
    CHECK(world->time() == doctest::Approx(0.05));
    REQUIRE(world->edits().size() == 1);
    const EditReport& report = world->edits()[0];
    CHECK(report.tick == world->ticks());
    CHECK(report.removed == gone.size());
    CHECK(report.mass == doctest::Approx(theirs.mass).epsilon(1e-9));
    CHECK(report.before.kinetic - report.after.kinetic == doctest::Approx(theirs.energy.kinetic).epsilon(1e-9));
    CHECK(report.before.elastic - report.after.elastic == doctest::Approx(theirs.energy.elastic).epsilon(1e-9));
    CHECK(report.before.potential - report.after.potential == doctest::Approx(theirs.energy.potential).epsilon(1e-9));
    CHECK(total(world->energies()) == total(report.after));
    CHECK(world->topology()->elements.size() == setup.mesh.tets.size() - gone.size());
    CHECK(world->volume_ratios().size() == setup.mesh.tets.size() - gone.size());
    run_until(*world, 0.1);
    CHECK_FALSE(world->halt());
  }
}

TEST_CASE("after a removal the body moves like one built without the elements") {
  std::mt19937_64 random(3);
  for (const Integrator integrator : moving_integrators()) {
    CAPTURE(integrator_name(integrator));
    WorldSetup setup = cantilever("stvk");
    setup.solver.integrator = integrator;
    setup.solver.step = is_explicit(integrator) ? 2e-4 : 5e-3;
    setup.solver.tolerance = 1e-11;
    setup.initial_velocity = Vec3(0.1, 0, 0.2);
    for (const Vec3& X : setup.mesh.nodes)
      setup.initial_positions.push_back(Vec3(1.05 * X.x(), X.y() - 2 * X.x() * X.x(), X.z()) +
                                        random_vector(random, 1e-4));
    WorldSetup without = setup;
    MeshEdit edit;
    const RemoveElements command = slab(0.07, 0.08);  // the end falls off
    REQUIRE(make_removal_edit(command.which, setup.mesh, full_topology(setup.mesh), edit).ok());
    without.mesh = with_elements(setup.mesh, apply_edit(full_topology(setup.mesh), edit, 0).elements);
    const auto world = make_world(setup), built = make_world(without);
    REQUIRE(world->apply(command).ok());
    CHECK((world->reactions()[0] - built->reactions()[0]).norm() <= 1e-12 * built->reactions()[0].norm());
    const int ticks = is_explicit(integrator) ? 100 : 10;
    for (int k = 0; k < ticks; ++k) {
      world->tick();
      built->tick();
    }
    REQUIRE_FALSE(world->halt());
    CHECK(rms_difference(world->positions(), built->positions()) <= 1e-10 * 0.1);
    CHECK(rms_difference(world->velocities(), built->velocities()) <= 1e-9);
    CHECK(world->energies().elastic == doctest::Approx(built->energies().elastic).epsilon(1e-9));
  }
}

TEST_CASE("static: after a removal the equilibrium is that of a body built without the elements and their faces") {
  WorldSetup setup = cantilever("neo_hookean", 1e5);
  setup.solver.integrator = Integrator::static_equilibrium;
  setup.gravity.setZero();
  Load load;
  load.kind = Load::Kind::traction;
  load.nodes = nodes_where(setup.mesh, [](const Vec3& X) { return X.y() > 0.0199; });
  load.vector = Vec3(0, -20, 0);
  setup.loads = {load};
  load.kind = Load::Kind::pressure;
  load.nodes = nodes_where(setup.mesh, [](const Vec3& X) { return X.z() > 0.0199; });
  load.pressure = 15;
  setup.loads.push_back(load);
  load.kind = Load::Kind::force;
  load.nodes = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 0.0999 || X.x() < 1e-9; });
  load.vector = Vec3(9e-4, 0, 0);
  setup.loads.push_back(load);
  const auto world = make_world(setup);
  world->load_to(1);
  REQUIRE_FALSE(world->halt());
  REQUIRE(world->apply(slab(0.08, 0.1)).ok());
  world->load_to(1);
  REQUIRE_FALSE(world->halt());
  CHECK(world->solver_stats().load == 1);
  // The upper face is 0.08 m long now; half of the force's nodes, those at the end, are gone; what is laid bare at x =
  // 0.08 takes no load.
  const Vec3 reaction = world->reactions()[0];
  CHECK(reaction.y() == doctest::Approx(20 * 0.08 * 0.02).epsilon(0.05));  // pressure turns with its face
  CHECK(reaction.x() == doctest::Approx(-4.5e-4).epsilon(0.05));

  WorldSetup without = setup;
  MeshEdit edit;
  REQUIRE(make_removal_edit(slab(0.08, 0.1).which, setup.mesh, full_topology(setup.mesh), edit).ok());
  without.mesh = with_elements(setup.mesh, apply_edit(full_topology(setup.mesh), edit, 0).elements);
  const auto built = make_world(without);
  built->load_to(1);
  REQUIRE_FALSE(built->halt());
  CHECK(rms_difference(world->positions(), built->positions()) >
        1e-6);  // nodes of no element stay where they were, in one bent, in the other at rest
  double worst = 0;
  const auto x = world->positions(), y = built->positions();
  for (std::size_t n = 0; n < x.size(); ++n)
    if (setup.mesh.nodes[n].x() < 0.0801) worst = std::max(worst, (x[n] - y[n]).norm());
  CHECK(worst <= 1e-8);
}

TEST_CASE("nodes that lose all elements stay in place, and prescribed ones follow their motion") {
  WorldSetup setup = cantilever();
  Boundary pulled{nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 0.0999; })};
  pulled.translate = Vec3(0.02, 0, 0);
  pulled.ramp_time = 0.2;
  setup.boundary.push_back(pulled);
  const auto world = make_world(setup);
  run_until(*world, 0.05);
  const auto before = world->positions();
  REQUIRE(world->apply(slab(0.07, 0.1)).ok());
  run_until(*world, 0.1);
  const auto after = world->positions(), v = world->velocities();
  for (std::size_t n = 0; n < after.size(); ++n) {
    const double X = setup.mesh.nodes[n].x();
    if (X > 0.0999)
      CHECK(after[n].x() == doctest::Approx(0.11).epsilon(1e-12));
    else if (X > 0.0701) {
      CHECK(after[n] == before[n]);
      CHECK(v[n].isZero(0));
    } else if (X > 1e-9)
      CHECK(after[n] != before[n]);
  }
  CHECK(world->reactions()[1].isZero(0));
}

TEST_CASE("the internal state of the remaining elements is kept in a removal") {
  for (const LawInfo& law : laws()) {
    CAPTURE(std::string(law.name));
    if (!law.is_continuum || law.name.starts_with("paper_")) continue;
    Material material = sample_material(law.name);
    material.viscosity = 2;
    material.relaxation = {{0.5, 0.01}};
    if (!law.has_fibre) material.plasticity = Plasticity{60, 10};
    if (material_problem(material)) continue;
    WorldSetup setup;
    setup.mesh = make_box(Vec3(0.06, 0.03, 0.03), {2, 1, 1});
    const TetMesh other = make_box(Vec3(0.06, 0.03, 0.03), {2, 1, 1}, Vec3(0.2, 0, 0));
    const int nodes = static_cast<int>(setup.mesh.nodes.size());
    std::vector<int> second;
    for (const Tet& tet : other.tets) {
      second.push_back(static_cast<int>(setup.mesh.tets.size()));
      setup.mesh.tets.push_back({tet[0] + nodes, tet[1] + nodes, tet[2] + nodes, tet[3] + nodes});
      setup.mesh.regions.push_back(2);
    }
    setup.mesh.nodes.insert(setup.mesh.nodes.end(), other.nodes.begin(), other.nodes.end());
    setup.materials = {{std::nullopt, material}};
    for (const double at : {0.0, 0.06}) {
      Boundary end{nodes_where(setup.mesh, [at](const Vec3& X) { return std::abs(X.x() - at) < 1e-9; })};
      end.translate = Vec3(at / 2, 0, 0);
      end.ramp_time = 0.02;
      setup.boundary.push_back(end);
    }
    setup.solver.threads = 1;
    setup.solver.continuation = true;
    setup.solver.step = make_world(setup)->stable_step() / 4;
    const auto whole_one = make_world(setup), cut = make_world(setup);
    for (int k = 0; k < 120; ++k) {
      if (k == 60) {  // forces are taken anew at any command
        REQUIRE(cut->apply(elements(second)).ok());
        REQUIRE(whole_one->apply(SetDamping{0}).ok());
      }
      whole_one->tick();
      cut->tick();
    }
    REQUIRE_FALSE(cut->halt());
    const auto x = whole_one->positions(), y = cut->positions();
    double apart = 0;
    for (std::size_t n = 0; n < static_cast<std::size_t>(nodes); ++n) apart = std::max(apart, (x[n] - y[n]).norm());
    CHECK(apart <= 1e-13);  // m; a removal converts the state of elements in fans
  }
}

TEST_CASE("a thousand random tetrahedra are removed one after the other, and none leaves more energy than there was") {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(0.1, 0.1, 0.1), {6, 6, 6});  // 1080 elements
  setup.materials = {{std::nullopt, soft()}};
  setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })});
  setup.gravity = Vec3(0, -9.81, 0);
  setup.solver.threads = 1;
  setup.solver.rate = 2000;
  setup.solver.continuation = true;
  const auto world = make_world(setup);
  run_until(*world, 0.02);
  std::mt19937_64 random(28);
  const std::vector<int> order = shuffled(1080, random);
  double worst = 0;
  for (int k = 0; k < 1000; ++k) {
    const int element = order[static_cast<std::size_t>(k)];
    const auto x = world->positions(), v = world->velocities();
    const Parts theirs = parts_of(*world, element, x, v);
    REQUIRE(world->apply(elements({element})).ok());
    const EditReport& report = world->edits().back();
    const double size = std::abs(total(report.before)) + report.before.kinetic + report.before.elastic;
    worst = std::max(worst, std::abs(total(report.before) - total(report.after) - total(theirs.energy)) / size);
    CHECK(report.after.elastic <= report.before.elastic * (1 + 1e-12));
    CHECK(report.after.kinetic <= report.before.kinetic * (1 + 1e-12));
    if (k % 100 == 0) check_closed(*world);
    world->tick();
    REQUIRE_FALSE(world->halt());
  }
  CHECK(worst <= 1e-11);
  CHECK(world->topology()->elements.size() == 80);
  for (const Vec3& at : world->positions()) CHECK(at.allFinite());
}

TEST_CASE("a grasp takes nodes of the new surface, and none without elements") {
  std::mt19937_64 random(9);
  const WorldSetup setup = cantilever();
  Model<double> model = make_model<double>(setup);
  while (model.mesh.tets.size() > 20) {
    std::vector<int> stay;
    for (std::size_t t = 0; t < model.mesh.tets.size(); ++t)
      if (random() % 6 != 0) stay.push_back(static_cast<int>(t));
    keep_elements(setup, stay, model);
    std::vector<int> nodes;
    for (const Triangle& face : extract_boundary(model.mesh).triangles)
      nodes.insert(nodes.end(), face.begin(), face.end());
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    CHECK(model.surface_nodes == nodes);
    for (std::size_t t = 0; t < stay.size(); ++t)
      CHECK(model.order.new_tet[static_cast<std::size_t>(model.order.file_tet[t])] == static_cast<int>(t));
  }
}

TEST_CASE("a removal that makes no sense is refused in words and changes nothing") {
  const auto world = make_world(cantilever());
  REQUIRE(world->apply(elements({5, 6})).ok());
  const auto hash = world->state_hash();
  const auto topology = world->topology();
  for (const auto& [command, part] : {std::pair{elements({1, 200}), "remove: element 200 does not exist"},
                                      {elements({6}), "remove: element 6 was removed before"},
                                      {elements({}), "remove: names no element"},
                                      {RemoveElements{{{}, 4, {}, {}}}, "remove: no element of region 4"},
                                      {slab(-1, 1), "remove: all 198 elements that are left would go"}}) {
    CHECK(world->apply(command).message().find(part) == 0);
  }
  CHECK(world->state_hash() == hash);
  CHECK(world->topology() == topology);
  CHECK(world->edits().size() == 1);
}

TEST_CASE("a reset brings back all elements, and the same bits as the first time") {
  Material material = sample_material("mooney_rivlin");
  material.relaxation = {{0.5, 0.02}};
  for (const Integrator integrator : {Integrator::verlet, Integrator::bdf2}) {
    WorldSetup setup = cantilever();
    setup.materials[0].material = material;
    setup.solver.integrator = integrator;
    const auto world = make_world(setup);
    run_until(*world, 0.03);
    const auto first = world->state_hash();
    REQUIRE(world->apply(slab(0.05, 0.06)).ok());
    REQUIRE(world->apply(slab(0.06, 0.1)).ok());
    run_until(*world, 0.05);
    const long version = world->topology()->version;
    REQUIRE(world->apply(Reset{}).ok());
    CHECK(world->edits().empty());
    CHECK(world->topology()->elements.size() == setup.mesh.tets.size());
    CHECK(world->topology()->version > version);
    run_until(*world, 0.03);
    CHECK(world->state_hash() == first);
  }
}

TEST_CASE("what is grasped may lose its elements, some or all, and stays stable") {
  WorldSetup setup = cantilever();
  setup.solver.damping = 5;
  const auto world = make_world(setup);
  const int tip = nodes_where(setup.mesh, [](const Vec3& X) { return (X - Vec3(0.1, 0.02, 0.02)).norm() < 1e-9; })[0];
  REQUIRE(world->apply(Grasp{tip, 0.025}).ok());
  REQUIRE(world->apply(MoveTool{Vec3(0.1, 0.04, 0.02)}).ok());
  run_until(*world, 0.1);
  const double pull = tool_of<GraspState>(*world).force.norm();
  CHECK(pull > 0);
  REQUIRE(world->apply(slab(0.09, 0.1)).ok());  // the tip itself; the rest of the patch is still held
  run_until(*world, 0.3);
  REQUIRE_FALSE(world->halt());
  CHECK(has_tool<GraspState>(*world));
  CHECK(tool_of<GraspState>(*world).force.norm() > 0);
  REQUIRE(world->apply(slab(0.06, 0.09)).ok());
  CHECK(tool_of<GraspState>(*world).force.isZero(0));
  REQUIRE(world->apply(MoveTool{Vec3(0.2, 0.04, 0.02)}).ok());
  run_until(*world, 0.4);
  CHECK_FALSE(world->halt());
  REQUIRE(world->apply(Release{}).ok());
  CHECK(world->apply(Grasp{tip, 0}).message().find("belongs to no element") != std::string::npos);
}

TEST_CASE("removals give the same bits for any number of threads, in float and with nodal pressure too") {
  for (const bool single : {false, true})
    for (const bool nodal : {false, true}) {
      std::uint64_t hash = 0;
      for (const int threads : {1, 2, 5}) {
        WorldSetup setup = cantilever();
        setup.materials[0].material = sample_material("neo_hookean_iso");
        setup.solver.single_precision = single;
        setup.solver.nodal_pressure = nodal;
        setup.solver.continuation = true;
        setup.solver.threads = threads;
        const auto world = make_world(setup);
        run_until(*world, 0.01);
        REQUIRE(world->apply(elements({7, 60, 61, 62, 130})).ok());
        run_until(*world, 0.02);
        REQUIRE_FALSE(world->halt());
        if (threads == 1)
          hash = world->state_hash();
        else
          CHECK(world->state_hash() == hash);
      }
    }
}

}  // namespace heml::removal_test
