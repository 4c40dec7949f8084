// Bodies of quadratic elements that are cut and lose elements while they live.
#include <doctest/doctest.h>

#include <cmath>
#include <heml/materials/point.hpp>
#include <heml/mesh/quadratic.hpp>
#include <numeric>
#include <set>

#include "engine/materials/sample_materials.hpp"
#include "support.hpp"
#include "world_support.hpp"

namespace heml::quadratic_edits_test {

using namespace heml::test;

namespace {

constexpr double density = 1000;

void make_quadratic(WorldSetup& setup, bool mean_dilatation) {
  setup.midedges = add_midedge_nodes(setup.mesh);
  setup.solver.quadratic = true;
  setup.solver.nodal_pressure = mean_dilatation;
}

/// A bar of 0.1 × 0.02 × 0.02 m, cells of its length / `cells`, held at x = 0.
WorldSetup bar(bool mean_dilatation, Integrator integrator = Integrator::verlet, int cells = 5) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(0.1, 0.02, 0.02), {cells, cells / 5, cells / 5});
  make_quadratic(setup, mean_dilatation);
  setup.materials = {{std::nullopt, sample_material("neo_hookean_iso")}};
  setup.materials[0].material.density = density;
  setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })});
  setup.gravity = Vec3(0, -9.81, 0);
  setup.solver.integrator = integrator;
  if (!is_explicit(integrator)) setup.solver.rate = 200;
  setup.solver.continuation = true;
  setup.solver.threads = 1;
  return setup;
}

template <class Visit>
void each_element(const Visit& visit) {
  for (const bool mean_dilatation : {false, true}) {
    CAPTURE(mean_dilatation);
    visit(mean_dilatation);
  }
}

CutTissue along(const Vec3& from, const Vec3& to, bool continues_stroke = false) {
  const Vec3 below(0, 0, -1), above(0, 0, 1);
  return {{{{from + below, from + above}, {to + below, to + above}}}, continues_stroke};
}
const CutTissue across = along(Vec3(0.034, -0.01, 0), Vec3(0.064, 0.03, 0));  // aslant, so that it splits elements
constexpr double half_way = 0.0505;
const CutTissue upright = along(Vec3(half_way, -1, 0), Vec3(half_way, 1, 0));

std::array<int, 10> nodes_of(const World& world, int t) {
  return quadratic_nodes(world.setup().mesh.tets[static_cast<std::size_t>(t)],
                         world.setup().midedges[static_cast<std::size_t>(t)]);
}

std::set<int> used_nodes(const World& world) {
  std::set<int> used;
  for (const int t : world.topology()->elements)
    for (const int n : nodes_of(world, t)) used.insert(n);
  return used;
}

double volume_of(const World& world, int t) {
  const Tet& tet = world.setup().mesh.tets[static_cast<std::size_t>(t)];
  const auto X = [&](std::size_t c) { return world.setup().mesh.nodes[static_cast<std::size_t>(tet[c])]; };
  return signed_volume(X(0), X(1), X(2), X(3));
}

/// Σ m a with lumped masses: 1/36 of an element's on a corner, 4/27 on a mid-edge node.
template <class Value>
Value weighted(const World& world, const std::vector<Value>& a, Value sum) {
  for (const int t : world.topology()->elements) {
    const auto nodes = nodes_of(world, t);
    for (std::size_t k = 0; k < 10; ++k)
      sum += density * volume_of(world, t) * (k < 4 ? 1.0 / 36 : 4.0 / 27) * a[static_cast<std::size_t>(nodes[k])];
  }
  return sum;
}
Vec3 momentum_of(const World& world) { return weighted(world, world.velocities(), Vec3(Vec3::Zero())); }

/// Energy of one straight element by its four points, from W(F) and shape functions.
Energies energies_of(const World& world, int t, const std::vector<Vec3>& x, const std::vector<Vec3>& v) {
  const auto nodes = nodes_of(world, t);
  const auto& X = world.setup().mesh.nodes;
  const auto at = [&](const std::vector<Vec3>& list, std::size_t a) {
    return list[static_cast<std::size_t>(nodes[a])];
  };
  Mat3 Dm;
  Dm << at(X, 1) - at(X, 0), at(X, 2) - at(X, 0), at(X, 3) - at(X, 0);
  Eigen::Matrix<double, 4, 3> gradient;
  gradient.bottomRows<3>() = Dm.inverse();
  gradient.row(0) = -gradient.bottomRows<3>().colwise().sum();
  const double volume = Dm.determinant() / 6;
  const auto law = make_material_point(world.setup().materials[0].material, world.setup().solver.continuation);
  Energies e;
  for (std::size_t q = 0; q < 4; ++q) {
    Mat3 F = Mat3::Zero();
    const auto L = [&](std::size_t i) { return q == i ? 0.58541019662496845446 : 0.13819660112501051518; };
    for (std::size_t i = 0; i < 4; ++i)
      F += (4 * L(i) - 1) * at(x, i) * gradient.row(static_cast<Eigen::Index>(i));
    for (std::size_t k = 0; k < 6; ++k) {
      const auto [i, j] = tet_edges[k];
      F += 4 * at(x, 4 + k) * (L(i) * gradient.row(static_cast<Eigen::Index>(j)) +
                               L(j) * gradient.row(static_cast<Eigen::Index>(i)));
    }
    e.elastic += volume / 4 * law->energy(F);
  }
  for (std::size_t a = 0; a < 10; ++a) {
    e.kinetic += density * volume * (a < 4 ? 1.0 / 72 : 2.0 / 27) * at(v, a).squaredNorm();
    e.potential -= density * volume * (a < 4 ? -0.05 : 0.2) * world.setup().gravity.dot(at(x, a) - at(X, a));
  }
  return e;
}

/// Parts that share no node.
int components(const World& world) {
  std::vector<int> root(world.setup().mesh.nodes.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int n) {
    while (root[static_cast<std::size_t>(n)] != n) n = root[static_cast<std::size_t>(n)];
    return n;
  };
  std::set<int> used, parts;
  for (const int t : world.topology()->elements)
    for (const int n : nodes_of(world, t)) {
      used.insert(n);
      root[static_cast<std::size_t>(find(n))] = find(nodes_of(world, t)[0]);
    }
  for (const int n : used) parts.insert(find(n));
  return static_cast<int>(parts.size());
}

Load on_end(const WorldSetup& setup, Load::Kind kind, const Vec3& vector, double pressure = 0) {
  Load load;
  load.kind = kind;
  load.nodes = nodes_where(setup.mesh, [](const Vec3& X) { return X.x() > 0.1 - 1e-9; });
  load.vector = vector;
  load.pressure = pressure;
  return load;
}

/// The force of the support once a static world bears its loads.
Vec3 borne(const WorldSetup& setup, const std::optional<Command>& edit) {
  WorldSetup still = setup;
  still.solver.integrator = Integrator::static_equilibrium;
  const auto world = make_world(still);
  if (edit) REQUIRE(world->apply(*edit).ok());
  world->load_to(1);
  REQUIRE_FALSE(world->halt());
  return world->reactions()[0];
}

}  // namespace

TEST_CASE("quadratic elements: a removal takes energy and mass of its elements, and leaves all that moves as it is") {
  for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler}) {
    CAPTURE(integrator_name(integrator));
    const auto world = make_world(bar(false, integrator));
    run_until(*world, 0.05);
    const auto x = world->positions(), v = world->velocities();
    const std::vector<int> gone = {3, 11, 12, 20};
    Energies theirs;
    double mass = 0;
    for (const int t : gone) {
      const Energies e = energies_of(*world, t, x, v);
      theirs.kinetic += e.kinetic, theirs.elastic += e.elastic, theirs.potential += e.potential;
      mass += density * volume_of(*world, t);
    }
    const std::size_t before = world->topology()->elements.size();
    REQUIRE(world->apply(RemoveElements{{gone, {}, {}, {}}}).ok());
    CHECK(world->positions() == x);
    // Nodes between elements that are gone come to rest; there is no other change.
    const auto left = used_nodes(*world);
    const auto after = world->velocities();
    for (std::size_t n = 0; n < v.size(); ++n)
      CHECK(after[n] == (left.contains(static_cast<int>(n)) ? v[n] : Vec3(Vec3::Zero())));
    CHECK(left.size() < v.size());
    const EditReport& report = world->edits().at(0);
    CHECK(report.removed == gone.size());
    CHECK(report.mass == doctest::Approx(mass).epsilon(1e-12));
    CHECK(report.before.kinetic - report.after.kinetic == doctest::Approx(theirs.kinetic).epsilon(1e-9));
    CHECK(report.before.elastic - report.after.elastic == doctest::Approx(theirs.elastic).epsilon(1e-9));
    CHECK(report.before.potential - report.after.potential == doctest::Approx(theirs.potential).epsilon(1e-9));
    CHECK(world->topology()->elements.size() == before - gone.size());
    CHECK(world->volume_ratios().size() == before - gone.size());
    CHECK(world->point_volume_ratios().size() == 4 * (before - gone.size()));
    run_until(*world, 0.1);
    CHECK_FALSE(world->halt());
  }
}

TEST_CASE("quadratic elements: after a removal the body moves like one built without the elements") {
  each_element([](bool mean_dilatation) {
    for (const Integrator integrator : moving_integrators()) {
      CAPTURE(integrator_name(integrator));
      WorldSetup setup = bar(mean_dilatation, integrator);
      setup.solver.step = is_explicit(integrator) ? 1e-4 : 2e-3;
      setup.solver.tolerance = 1e-11;
      setup.initial_velocity = Vec3(0.1, 0, 0.2);
      const ElementSelection end{{}, {}, std::array{Vec3(0.08, -1, -1), Vec3(1, 1, 1)}, {}};
      MeshEdit edit;
      REQUIRE(make_removal_edit(end, setup.mesh, full_topology(setup.mesh), edit).ok());
      WorldSetup without = setup;
      const auto left = apply_edit(full_topology(setup.mesh), edit, 0).elements;
      without.mesh = with_elements(setup.mesh, left);
      without.midedges = with_elements(setup.midedges, left);
      const auto world = make_world(setup), built = make_world(without);
      REQUIRE(world->apply(RemoveElements{end}).ok());
      for (int k = 0; k < 10; ++k) world->tick(), built->tick();
      REQUIRE_FALSE(world->halt());
      const auto x = world->positions(), expected = built->positions();
      for (const int n : used_nodes(*world))
        CHECK((x[static_cast<std::size_t>(n)] - expected[static_cast<std::size_t>(n)]).norm() <= 1e-9);
    }
  });
}

TEST_CASE("quadratic elements: what is removed takes its share of loads along, and cuts keep their sum") {
  WorldSetup setup = bar(true, Integrator::verlet, 10);
  setup.gravity.setZero();
  const double area = 4e-4;
  const Vec3 force(0.02, 0.01, 0);
  // The upper half of the loaded face, and a cut through the middle of it, along the bar.
  const RemoveElements half{{{}, {}, std::array{Vec3(0.05, 0.01, -1), Vec3(1, 1, 1)}, {}}};
  const CutTissue lengthwise{{{{Vec3(0.055, -1, 0.0093), Vec3(0.055, 1, 0.0093)},
                               {Vec3(1, -1, 0.0093), Vec3(1, 1, 0.0093)}}}, false};
  const auto close = [](const Vec3& a, const Vec3& b, double within = 1e-6) {
    return (a - b).norm() <= within * b.norm();
  };
  for (const auto kind : {Load::Kind::force, Load::Kind::traction}) {
    setup.loads = {on_end(setup, kind, kind == Load::Kind::force ? force : Vec3(force / area))};
    CHECK(close(borne(setup, {}), -force));
    CHECK(close(borne(setup, half), -force / 2));
    CHECK(close(borne(setup, lengthwise), -force));
  }
  const double pressure = 0.1;  // so little that the face keeps its area and direction
  setup.loads = {on_end(setup, Load::Kind::pressure, Vec3::Zero(), pressure)};
  const Vec3 whole(pressure * area, 0, 0);
  CHECK(close(borne(setup, {}), whole, 1e-3));
  CHECK(close(borne(setup, half), whole / 2, 1e-3));
  CHECK(close(borne(setup, lengthwise), whole, 1e-3));
  // Shared by nodes, where a selection is no set of faces: a corner that goes takes its part.
  Load corners = on_end(setup, Load::Kind::force, force);
  corners.nodes = {nodes_where(setup.mesh, [](const Vec3& X) { return (X - Vec3(0.1, 0, 0)).norm() < 1e-9; })[0],
                   nodes_where(setup.mesh, [](const Vec3& X) { return (X - Vec3(0.1, 0.02, 0)).norm() < 1e-9; })[0]};
  setup.loads = {corners};
  CHECK(close(borne(setup, half), -force / 2));
}

TEST_CASE("quadratic elements: a cut of an affine motion keeps mass, momentum and every energy to round-off") {
  each_element([](bool mean_dilatation) {
    for (const bool single : {false, true}) {
      WorldSetup setup = bar(mean_dilatation);
      setup.boundary.clear();
      setup.solver.single_precision = single;
      Mat3 F;
      F << 1.1, 0.1, 0, -0.05, 0.95, 0.1, 0, 0.02, 0.9;
      for (const Vec3& X : setup.mesh.nodes) setup.initial_positions.push_back(F * X);
      setup.initial_velocity = Vec3(0.1, 0.3, -0.2);
      const auto world = make_world(setup);
      const Energies before = world->energies();
      const Vec3 momentum = momentum_of(*world);
      const double noise = single ? 1e-5 : 1e-11;
      REQUIRE(world->apply(across).ok());
      const Energies after = world->energies();
      CHECK((momentum_of(*world) - momentum).norm() <= noise * momentum.norm());
      CHECK(after.elastic == doctest::Approx(before.elastic).epsilon(noise));
      CHECK(after.kinetic == doctest::Approx(before.kinetic).epsilon(noise));
      CHECK(after.potential == doctest::Approx(before.potential).epsilon(noise));
      const EditReport& report = world->edits().at(0);
      CHECK(report.removed == 0);
      CHECK(report.mass == 0);
      CHECK(report.pieces > report.split);
      CHECK(report.area == doctest::Approx(1.25 * 0.02 * 0.02).epsilon(0.3));
      CHECK(report.min_angle >= 8);
      CHECK(report.after.elastic == after.elastic);
      CHECK(components(*world) == 2);
      run_until(*world, 0.05);
      CHECK_FALSE(world->halt());
    }
  });
}

TEST_CASE("quadratic elements: a cut changes the energy of a bent body by quadrature alone, less in finer meshes") {
  each_element([](bool mean_dilatation) {
    std::vector<double> errors;
    for (const int cells : {5, 10, 20}) {
      WorldSetup setup = bar(mean_dilatation, Integrator::verlet, cells);
      for (const Vec3& X : setup.mesh.nodes)
        setup.initial_positions.push_back(
            Vec3(X.x() + 3 * X.x() * (X.y() - 0.01), X.y() - 1.5 * X.x() * X.x(), X.z() + X.x() * X.y()));
      const auto world = make_world(setup);
      const double before = world->energies().elastic;
      REQUIRE(world->apply(across).ok());
      errors.push_back(std::abs(world->energies().elastic / before - 1));
    }
    MESSAGE("relative errors: " << errors[0] << ", " << errors[1] << ", " << errors[2]);
    CHECK(errors[0] <= 1e-2);
    CHECK(errors[2] <= errors[0] / 30);
  });
}

TEST_CASE("quadratic elements: a severed part falls freely and the held part stays, whatever the method") {
  each_element([](bool mean_dilatation) {
    for (const Integrator integrator : moving_integrators()) {
      CAPTURE(integrator_name(integrator));
      const auto world = make_world(bar(mean_dilatation, integrator));
      run_until(*world, 0.02);
      const double cut_at = world->time();
      REQUIRE(world->apply(upright).ok());
      CHECK(components(*world) == 2);
      const auto falling = [&](const std::vector<Vec3>& values) {  // mean of the severed part
        double sum = 0, mass = 0;
        for (const int t : world->topology()->elements) {
          Vec3 middle = Vec3::Zero();
          const auto nodes = nodes_of(*world, t);
          for (std::size_t c = 0; c < 4; ++c)
            middle += world->setup().mesh.nodes[static_cast<std::size_t>(nodes[c])] / 4;
          if (middle.x() < half_way) continue;
          for (std::size_t k = 0; k < 10; ++k) {
            const double share = volume_of(*world, t) * (k < 4 ? 1.0 / 36 : 4.0 / 27);
            sum += share * values[static_cast<std::size_t>(nodes[k])].y(), mass += share;
          }
        }
        return sum / mass;
      };
      const double speed = falling(world->velocities());
      run_until(*world, 0.12);
      REQUIRE_FALSE(world->halt());
      const double gained = falling(world->velocities()) - speed, expected = -9.81 * (world->time() - cut_at);
      CHECK(gained == doctest::Approx(expected).epsilon(0.02));
      CHECK(world->positions()[0] == world->setup().mesh.nodes[0]);
    }
  });
}

TEST_CASE("quadratic elements: a stroke of many sweeps through a moving body is one edit, and severs") {
  each_element([](bool mean_dilatation) {
    for (const Integrator integrator : {Integrator::verlet, Integrator::bdf2}) {
      CAPTURE(integrator_name(integrator));
      const WorldSetup setup = bar(mean_dilatation, integrator);
      const auto world = make_world(setup), plain = make_world(setup);
      for (int k = 0; k < 4; ++k) world->tick(), plain->tick();
      for (int k = 0; k < 8; ++k) {
        const auto at = [](int m) { return Vec3(0.052, 0.03 - 0.06 * m / 8, 0); };
        REQUIRE(world->apply(along(at(k), at(k + 1), k > 0)).ok());
        if (!world->edits().empty()) world->tick();
      }
      REQUIRE_FALSE(world->halt());
      CHECK(world->edits().size() == 1);
      CHECK(components(*world) == 2);
      REQUIRE(world->apply(Undo{}).ok());
      CHECK(world->positions() == plain->positions());
      CHECK(world->setup().mesh.nodes.size() == plain->setup().mesh.nodes.size());
      CHECK(world->setup().midedges == plain->setup().midedges);
      CHECK(world->energies().elastic == plain->energies().elastic);
      for (int k = 0; k < 3; ++k) world->tick();
      CHECK_FALSE(world->halt());
    }
  });
}

TEST_CASE("quadratic elements: edits are undone to the bit, for every kind of internal state") {
  each_element([](bool mean_dilatation) {
    for (const Material& material : with_internal_state(sample_material("mooney_rivlin")))
      for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler, Integrator::bdf2})
        for (const Command& edit : std::vector<Command>{across, RemoveElements{{{3, 12}, {}, {}, {}}}}) {
          CAPTURE(integrator_name(integrator));
          CAPTURE(edit.index());
          WorldSetup setup = bar(mean_dilatation, integrator);
          setup.solver.single_precision = integrator == Integrator::verlet && mean_dilatation;
          setup.materials[0].material = material;
          const auto plain = make_world(setup), edited = make_world(setup);
          for (int k = 0; k < 4; ++k) plain->tick(), edited->tick();
          for (const Command& once : std::vector<Command>{edit, RemoveElements{{{20}, {}, {}, {}}}, Undo{}, Undo{}})
            REQUIRE(edited->apply(once).ok());
          for (int k = 0; k < 5; ++k) {
            REQUIRE(edited->state_hash() == plain->state_hash());
            plain->tick(), edited->tick();
          }
          CHECK_FALSE(plain->halt());
          CHECK(edited->state_hash() == plain->state_hash());
        }
  });
}

TEST_CASE("quadratic elements: history steps over edits are to the bit, with tools in the tissue") {
  each_element([](bool mean_dilatation) {
    for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler}) {
      CAPTURE(integrator_name(integrator));
      WorldSetup setup = bar(mean_dilatation, integrator);
      setup.tables = {{Vec3(0, -0.004, 0), Vec3::UnitY(), 0.4}};
      const auto world = make_world(setup), plain = make_world(setup);
      const auto middle = static_cast<int>(setup.mesh.nodes.size()) - 1;  // of an edge
      for (World* each : {world.get(), plain.get()}) {
        for (const Command& once : std::vector<Command>{
                 PinTissue{5, 0.012}, Grasp{middle, 0.015}, MoveTool{setup.mesh.nodes.back() + Vec3(0, 0.002, 0)}})
          REQUIRE(each->apply(once).ok());
        for (int k = 0; k < 4; ++k) each->tick();
      }
      for (const Command& edit : std::vector<Command>{across, RemoveElements{{{3, 12}, {}, {}, {}}}}) {
        CAPTURE(edit.index());
        const std::uint64_t hash = world->state_hash();
        REQUIRE(hash == plain->state_hash());
        REQUIRE(world->apply(edit).ok());
        for (int k = 0; k < 4; ++k) world->tick();
        REQUIRE_FALSE(world->halt());
        const std::uint64_t after = world->state_hash();
        const auto elements = world->topology()->elements;
        REQUIRE(world->apply(StepHistory{-1}).ok());
        CHECK(world->state_hash() == hash);
        REQUIRE(world->apply(StepHistory{1}).ok());
        CHECK(world->state_hash() == after);
        CHECK(world->topology()->elements == elements);
        REQUIRE(world->apply(StepHistory{-1}).ok());
        for (int k = 0; k < 3; ++k) world->tick(), plain->tick();
        CHECK(world->state_hash() == plain->state_hash());
      }
    }
  });
}

TEST_CASE("quadratic elements: held and pinned nodes stay so on both sides of a cut") {
  WorldSetup setup = bar(false, Integrator::backward_euler, 10);
  const auto world = make_world(setup);
  const auto end = nodes_where(setup.mesh, [](const Vec3& X) { return (X - Vec3(0.1, 0.02, 0.01)).norm() < 1e-9; });
  REQUIRE(world->apply(PinTissue{end[0], 0.011}).ok());
  const std::size_t held = world->setup().boundary[0].nodes.size(), pinned = tool_of<PinState>(*world).nodes.size();
  const CutTissue lengthwise{
      {{{Vec3(-1, -1, 0.0093), Vec3(-1, 1, 0.0093)}, {Vec3(1, -1, 0.0093), Vec3(1, 1, 0.0093)}}}, false};
  REQUIRE(world->apply(lengthwise).ok());
  CHECK(components(*world) == 2);
  CHECK(world->setup().boundary[0].nodes.size() > held);
  CHECK(tool_of<PinState>(*world).nodes.size() > pinned);
  run_until(*world, 0.1);
  REQUIRE_FALSE(world->halt());
  const auto x = world->positions();
  const auto& X = world->setup().mesh.nodes;
  for (std::size_t n = 0; n < X.size(); ++n)
    if (X[n].x() < 1e-9) CHECK((x[n] - X[n]).norm() <= 1e-12);
}

TEST_CASE("quadratic elements: what a cut has laid bare rests on a table") {
  each_element([](bool mean_dilatation) {
    for (const Integrator integrator : {Integrator::verlet, Integrator::backward_euler}) {
      CAPTURE(integrator_name(integrator));
      WorldSetup setup = bar(mean_dilatation, integrator);
      setup.gravity = Vec3(-9.81, 0, 0);
      setup.boundary.clear();
      setup.tables = {{Vec3(0.045, 0, 0), Vec3::UnitX(), 0.4}};
      setup.solver.damping = 20;
      const auto world = make_world(setup);
      REQUIRE(world->apply(upright).ok());
      REQUIRE(world->apply(RemoveElements{{{}, {}, std::array{Vec3(-1, -1, -1), Vec3(half_way, 1, 1)}, {}}}).ok());
      run_until(*world, 0.2);
      REQUIRE_FALSE(world->halt());
      const auto x = world->positions();
      double lowest = 1;
      for (const int n : used_nodes(*world)) lowest = std::min(lowest, x[static_cast<std::size_t>(n)].x());
      CHECK(lowest >= 0.045 - (is_explicit(integrator) ? 1e-12 : 1e-5));
      CHECK(lowest <= 0.046);
      CHECK(tool_of<TableState>(*world).contact_count >= 3);
    }
  });
}

TEST_CASE("quadratic elements: a cut of curved elements that would turn a piece inside out is refused, with a remedy") {
  WorldSetup setup = bar(false, Integrator::verlet, 5);
  // A middle far beside its edge: four points of the whole are upright, but those of some piece are not.
  const auto corners = static_cast<int>(make_box(Vec3(0.1, 0.02, 0.02), {5, 1, 1}).nodes.size());
  bool refused = false;
  for (int n = corners; n < static_cast<int>(setup.mesh.nodes.size()) && !refused; ++n)
    for (const double by : {0.004, 0.006, 0.008}) {
      WorldSetup curved = setup;
      curved.mesh.nodes[static_cast<std::size_t>(n)] += Vec3(by, by / 2, 0);
      if (count_inverted_points(curved.mesh.tets, curved.midedges, [&](int k) -> const Vec3& {
            return curved.mesh.nodes[static_cast<std::size_t>(k)];
          }) > 0)
        continue;
      const auto world = make_world(curved);
      const std::uint64_t hash = world->state_hash();
      const Status status = world->apply(along(Vec3(0.05 + by / 3, -1, 0), Vec3(0.05 + by / 3, 1, 0)));
      if (status.ok()) continue;
      refused = true;
      CHECK(status.message().find("cut: ") == 0);
      CHECK(status.message().find("take a mesh with straight edges") != std::string::npos);
      CHECK(world->state_hash() == hash);
      CHECK(world->edits().empty());
      break;
    }
  CHECK(refused);
}

}  // namespace heml::quadratic_edits_test
