// Worlds of quadratic elements: loads, statics, steps, determinism, snapshots.
#include <doctest/doctest.h>

#include <heml/mesh/quadratic.hpp>
#include <numeric>

#include "support.hpp"
#include "world_support.hpp"

namespace heml::quadratic_world_test {

using namespace heml::test;

namespace {

std::vector<int> end_at(const TetMesh& mesh, double x) {
  return nodes_where(mesh, [x](const Vec3& X) { return std::abs(X.x() - x) < 1e-9; });
}

/// A bar along x of quadratic elements, without gravity; its end x = 0 is fixed.
WorldSetup quadratic_bar(const Vec3& size, const std::array<int, 3>& cells, const Material& material) {
  WorldSetup setup;
  setup.mesh = make_box(size, cells);
  setup.midedges = add_midedge_nodes(setup.mesh);
  setup.solver.quadratic = true;
  setup.materials.push_back({std::nullopt, material});
  setup.boundary.push_back({end_at(setup.mesh, 0)});
  return setup;
}

WorldSetup small_bar(const char* law = "neo_hookean") {
  return quadratic_bar(Vec3(0.1, 0.02, 0.02), {5, 1, 1}, soft(law));
}

Load on_end(const WorldSetup& setup, Load::Kind kind, const Vec3& vector, double pressure = 0) {
  Load load;
  load.kind = kind;
  load.nodes = end_at(setup.mesh, 0.1);
  load.vector = vector;
  load.pressure = pressure;
  return load;
}

std::unique_ptr<World> solved(WorldSetup setup, double tolerance = 1e-10) {
  setup.solver.integrator = Integrator::static_equilibrium;
  setup.solver.tolerance = tolerance;
  auto world = make_world(std::move(setup));
  world->load_to(1);
  REQUIRE_FALSE(world->halt());
  return world;
}

Vec3 sum(const std::vector<Vec3>& list) { return std::accumulate(list.begin(), list.end(), Vec3(Vec3::Zero())); }

double largest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0;
  for (std::size_t n = 0; n < a.size(); ++n) largest = std::max(largest, (a[n] - b[n]).norm());
  return largest;
}

}  // namespace

/// Deflection of the end of a 20:1 cantilever of one cell across, over that of beam theory.
double cantilever(int cells, const Material& material, double young, bool mean_dilatation) {
  const double L = 1, h = 0.05, force = -1e-3;
  WorldSetup setup = quadratic_bar(Vec3(L, h, h), {cells, 1, 1}, material);
  setup.solver.nodal_pressure = mean_dilatation;
  Load load;
  load.kind = Load::Kind::force;
  load.nodes = end_at(setup.mesh, L);
  load.vector = Vec3(0, force, 0);
  setup.loads.push_back(load);
  const auto world = solved(setup, 1e-7);  // round-off of a slender beam
  const double beam = force * L * L * L / (3 * young * h * h * h * h / 12);
  double sag = 0;
  for (const int n : load.nodes)
    sag += (world->positions()[static_cast<std::size_t>(n)].y() - setup.mesh.nodes[static_cast<std::size_t>(n)].y()) /
           static_cast<double>(load.nodes.size());
  return sag / beam;
}

TEST_CASE("quadratic elements: a cantilever of few elements bends as beam theory says") {
  // 20:1, one cell across: linear ones are off by half
  CHECK(cantilever(20, soft("neo_hookean", 1e6, 0.3), 1e6, false) == doctest::Approx(1).epsilon(0.03));
}

TEST_CASE("quadratic elements: with mean dilatation a nearly incompressible cantilever does not lock") {
  const double shear = 1e6 / (2 * 1.499), bulk = 1e6 / (3 * 0.002);  // of Poisson's ratio 0.499
  const Material material = sample_material(*find_law("neo_hookean_iso"), {shear, bulk});
  CHECK(cantilever(10, material, 1e6, true) == doctest::Approx(1).epsilon(0.05));
  CHECK(cantilever(10, material, 1e6, false) < 0.87);
}

TEST_CASE("quadratic elements: a homogeneous stretch is exact, and all loads reach the support") {
  for (const auto kind : {Load::Kind::force, Load::Kind::traction, Load::Kind::pressure}) {
    CAPTURE(static_cast<int>(kind));
    WorldSetup setup = small_bar();
    const double area = 0.02 * 0.02;
    const Vec3 traction(100, -20, 30);
    setup.loads.push_back(kind == Load::Kind::pressure
                              ? on_end(setup, kind, Vec3::Zero(), 100)
                              : on_end(setup, kind, kind == Load::Kind::force ? Vec3(area * traction) : traction));
    setup.gravity = Vec3(0, 0, -9.81);
    const auto world = solved(setup);
    const double weight = 1000 * 0.1 * area * 9.81;
    const Vec3 reaction = sum(world->reactions());
    if (kind == Load::Kind::pressure)
      CHECK(reaction.x() == doctest::Approx(100 * area).epsilon(0.1));  // the end turns and widens
    else
      CHECK((reaction - (Vec3(0, 0, weight) - area * traction)).norm() <= 1e-9 * reaction.norm());
  }
  // An even force and the traction of the same sum are the same load.
  WorldSetup forced = small_bar(), pulled = small_bar();
  forced.loads.push_back(on_end(forced, Load::Kind::force, Vec3(0.04, 0, 0)));
  pulled.loads.push_back(on_end(pulled, Load::Kind::traction, Vec3(100, 0, 0)));
  CHECK(largest_difference(solved(forced)->positions(), solved(pulled)->positions()) <= 1e-12);
  // Uniaxial stress, ends free to narrow: x is stretched evenly.
  pulled.boundary.clear();
  const auto on = [&](int axis) {
    return nodes_where(pulled.mesh, [axis](const Vec3& X) { return std::abs(X[axis]) < 1e-9; });
  };
  pulled.loads.push_back(pulled.loads.front());
  pulled.loads.back().nodes = on(0);
  pulled.loads.back().vector *= -1;
  Boundary corner{nodes_where(pulled.mesh, [](const Vec3& X) { return X.norm() < 1e-9; })};
  pulled.boundary.push_back(corner);
  const auto world = solved(pulled);
  for (const double J : world->point_volume_ratios())
    CHECK(J == doctest::Approx(world->point_volume_ratios().front()).epsilon(1e-9));
}

TEST_CASE("quadratic elements: pressure that follows the surface converges as Newton's method does") {
  WorldSetup setup = small_bar();
  Load load = on_end(setup, Load::Kind::pressure, Vec3::Zero(), 3);
  load.nodes = nodes_where(setup.mesh, [](const Vec3& X) { return std::abs(X.y() - 0.02) < 1e-9; });
  setup.loads.push_back(load);
  const auto world = solved(setup);
  CHECK(world->solver_stats().iterations <= 40);
}

TEST_CASE("quadratic elements: implicit and explicit steps agree, whatever the threads") {
  const auto at_end = [](Integrator integrator, double step, int threads) {
    WorldSetup setup = small_bar();
    setup.gravity = Vec3(0, -9.81, 0);
    setup.solver.integrator = integrator;
    if (step > 0) setup.solver.step = step;
    setup.solver.threads = threads;
    auto world = make_world(std::move(setup));
    while (world->time() < 0.05 - 1e-9) {
      world->tick();
      REQUIRE_FALSE(world->halt());
    }
    return world;
  };
  const auto reference = at_end(Integrator::verlet, 0, 1);
  const auto implicit = at_end(Integrator::tr_bdf2, 1e-3, 1);
  const double motion = largest_difference(reference->positions(), small_bar().mesh.nodes);
  CHECK(motion > 1e-3);
  CHECK(largest_difference(reference->positions(), implicit->positions()) <= 0.01 * motion);
  CHECK(at_end(Integrator::verlet, 0, 3)->state_hash() == reference->state_hash());
  CHECK(at_end(Integrator::tr_bdf2, 1e-3, 3)->state_hash() == implicit->state_hash());
}

TEST_CASE("quadratic elements: the live stable step holds in motion, and twice that does not") {
  const auto run = [](double factor) {
    WorldSetup setup = small_bar();
    setup.gravity = Vec3(0, -9.81, 0);
    if (factor > 0) setup.solver.step = factor * make_world(setup)->stable_step();
    auto world = make_world(std::move(setup));
    while (world->time() < 0.3 && !world->halt()) world->tick();
    return world->halt().has_value();
  };
  CHECK_FALSE(run(0));
  CHECK(run(2));
}

TEST_CASE("quadratic elements: energy of free motion is kept, and of a snapshot every bit") {
  WorldSetup setup = small_bar();
  setup.solver.step = 0.5 * make_world(setup)->stable_step();
  setup.gravity = Vec3(0, -9.81, 0);
  auto world = make_world(setup);
  const auto total = [&] {
    const Energies e = world->energies();
    return e.kinetic + e.elastic + e.potential;
  };
  double scale = 0, worst = 0;
  for (int k = 0; k < 400; ++k) {
    world->tick();
    scale = std::max(scale, std::abs(world->energies().potential));
    worst = std::max(worst, std::abs(total()));
  }
  CHECK(worst <= 2e-3 * scale);
  const auto snapshot = world->snapshot();
  for (int k = 0; k < 10; ++k) world->tick();
  const auto hash = world->state_hash();
  CHECK(world->restore(*snapshot).ok());
  for (int k = 0; k < 10; ++k) world->tick();
  CHECK(world->state_hash() == hash);
}

TEST_CASE("quadratic elements: a world's estimate of its mesh is near the error that energies show, and falls") {
  const auto total_of = [](const std::array<int, 3>& cells, const char* law, bool mean_dilatation, double* relative) {
    WorldSetup setup = quadratic_bar(Vec3(0.1, 0.02, 0.02), cells, soft(law));
    setup.solver.nodal_pressure = mean_dilatation;
    setup.gravity = Vec3(0, -1e-3, 0);  // so little that the law is linear
    const auto world = solved(setup, 1e-9);
    const auto estimate = world->error_estimate();
    REQUIRE(estimate);
    CHECK(estimate->of_element.size() == setup.mesh.tets.size());
    *relative = estimate->relative();
    return total(world->energies());
  };
  for (const bool mean_dilatation : {false, true}) {
    const char* law = mean_dilatation ? "neo_hookean_iso" : "neo_hookean";
    double estimated[2], finest;
    const double coarse = total_of({5, 1, 1}, law, mean_dilatation, &estimated[0]),
                 fine = total_of({10, 2, 2}, law, mean_dilatation, &estimated[1]),
                 reference = total_of({25, 5, 5}, law, mean_dilatation, &finest);
    // Relative errors in the energy norm: the stored energy of the solution is minus its total.
    const double errors[2] = {std::sqrt((coarse - reference) / -reference), std::sqrt((fine - reference) / -reference)};
    MESSAGE("estimated " << estimated[0] << ", " << estimated[1] << "; energies show " << errors[0] << ", "
                         << errors[1]);
    for (int k = 0; k < 2; ++k) CHECK(estimated[k] / errors[k] > 0.5);
    for (int k = 0; k < 2; ++k) CHECK(estimated[k] / errors[k] < 1.5);
    CHECK(estimated[1] < 0.7 * estimated[0]);
  }
}

}  // namespace heml::quadratic_world_test
