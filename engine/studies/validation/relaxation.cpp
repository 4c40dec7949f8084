// Materials with memory: a block in simple shear, prescribed on its surface, and one that is drawn.
#include <fmt/format.h>

#include <cmath>
#include <heml/mesh/generate.hpp>
#include <studies/validation/body.hpp>
#include <studies/validation/references.hpp>

namespace heml::validation {
namespace {

constexpr double edge = 0.01, block_shear = 4e3;                        // m, Pa
constexpr double gamma_1 = 0.5, tau_1 = 0.1, gamma_2 = 1, tau_2 = 0.5;  // branches of relaxation

/// Moves every node of the surface by the motion of its height.
template <class Motion>
WorldSetup block(const Material& material, Integrator integrator, double step, const Motion& motion) {
  WorldSetup setup = make_body(make_box(Vec3(edge, edge, edge), {2, 2, 2}), "p1", material);
  for (const int n :
       nodes_where(setup, [](const Vec3& X) { return (X.array() < 1e-9 || X.array() > edge - 1e-9).any(); })) {
    Boundary boundary = motion(setup.mesh.nodes[static_cast<std::size_t>(n)]);
    boundary.nodes = {n};
    setup.boundary.push_back(boundary);
  }
  setup.solver.integrator = integrator;
  setup.solver.step = step;
  setup.solver.tolerance = 1e-9;
  return setup;
}

/// Nominal shear stress along x on planes of constant y: Σ R_x Y / V of the reactions R.
double shear_stress(World& world) {
  double stress = 0;
  const auto reactions = world.reactions();
  for (std::size_t b = 0; b < reactions.size(); ++b) {
    const double height = world.setup().mesh.nodes[static_cast<std::size_t>(world.setup().boundary[b].nodes[0])].y();
    stress += reactions[b].x() * height / (edge * edge * edge);
  }
  return stress;
}

/// The nodes of the surface at the places that a shear takes them to.
std::vector<Boundary> sheared_by(const World& world, double shear) {
  std::vector<Boundary> entries = world.setup().boundary;
  for (Boundary& entry : entries)
    entry.translate.x() = shear * world.setup().mesh.nodes[static_cast<std::size_t>(entry.nodes[0])].y();
  return entries;
}

/// Shear that goes to `amplitude`, to −amplitude, and back again, at constant speed.
double zigzag(double quarters, double amplitude) {
  const double turn = std::fmod(quarters, 4);
  return amplitude * (turn < 1 ? turn : turn < 3 ? 2 - turn : turn - 4);
}

struct Cycle {
  double amplitude;
  int steps, quarters;  ///< of a quarter of a cycle; in all
  double step;          ///< s
};

/// Runs cycles of shear; after each step hands the shear, the stress and the number of steps to `seen`.
template <class Seen>
Solved run_cycles(const Trial& trial, WorldSetup setup, const Cycle& cycle, const Seen& seen) {
  Solved solved;
  const auto world = trial.make(std::move(setup));
  for (int k = 1; k <= cycle.steps * cycle.quarters && solved.failed.empty(); ++k) {
    const double shear = zigzag(k / static_cast<double>(cycle.steps), cycle.amplitude);
    world->apply(SetBoundary{sheared_by(*world, shear)});
    world->tick();
    if (world->halt()) solved.failed = world->halt()->message;
    seen(shear, shear_stress(*world), k);
  }
  return solved;
}

constexpr Integrator implicit_methods[] = {Integrator::backward_euler, Integrator::bdf2, Integrator::tr_bdf2};

}  // namespace

Finding relaxation(const Trial& trial) {
  constexpr double sheared = 0.3;
  Finding finding;
  Material material = rubber(block_shear, bulk_of(block_shear, 0.45));
  material.density = 1;
  material.relaxation = {{gamma_1, tau_1}, {gamma_2, tau_2}};
  // Neo-Hookean shear stress is μ γ, and isochoric: relaxation multiplies it.
  const auto exact = [&](double t) {
    return block_shear * sheared * (1 + gamma_1 * std::exp(-t / tau_1) + gamma_2 * std::exp(-t / tau_2));
  };
  Curve line{"step strain", true};
  for (int k = 0; k <= 100; ++k) line.points.push_back({0.01 * k, exact(0.01 * k)});
  finding.curves.push_back(line);
  for (const Integrator integrator : implicit_methods) {
    constexpr double step = 0.001;
    auto setup =
        block(material, integrator, step, [&](const Vec3& X) { return moved(0, Vec3(sheared * X.y(), 0, 0)); });
    Solved solved;
    const auto world = trial.make(std::move(setup));
    Curve ours{std::string(integrator_name(integrator))};
    for (const double until : {0.05, 0.1, 0.2, 0.5, 1.0}) {
      while (world->time() < until - step / 2 && !world->halt()) world->tick();
      if (world->halt()) solved.failed = world->halt()->message;
      ours.points.push_back({world->time(), shear_stress(*world)});
      finding.rows.push_back(row_of(solved, fmt::format("shear stress at {} s", until), "Pa", ours.points.back()[1],
                                    exact(until), "Prony series", 0.01,
                                    fmt::format("{}, steps of {} ms", integrator_name(integrator), 1e3 * step)));
    }
    finding.curves.push_back(ours);
  }
  return finding;
}

Finding creep(const Trial& trial) {
  constexpr double stress = 10;  // Pa: a strain of about 1/1000, where the law is linear
  const Rubber at_last{block_shear, bulk_of(block_shear, 0.45)};
  const Branch branch{gamma_2, tau_1};
  Material material = rubber(at_last.shear, at_last.bulk);
  material.density = 1;
  material.relaxation = {{branch.strength, branch.time}};
  Finding finding;
  Curve line{"creep", true};
  for (int k = 0; k <= 100; ++k) line.points.push_back({0.01 * k, creep_strain(stress, at_last, branch, 0.01 * k)});
  finding.curves.push_back(line);
  for (const Integrator integrator : implicit_methods) {
    constexpr double step = 0.001;
    WorldSetup setup = make_body(make_box(Vec3(edge, edge, edge), {2, 2, 2}), "p1", material);
    for (int axis = 0; axis < 3; ++axis) {  // rollers
      Boundary rollers;
      rollers.nodes = nodes_where(setup, [&](const Vec3& X) { return X[axis] < 1e-9; });
      rollers.axes = AxisSet::none();
      rollers.axes.has[static_cast<std::size_t>(axis)] = true;
      setup.boundary.push_back(rollers);
    }
    const auto end = nodes_where(setup, [](const Vec3& X) { return X.x() > edge - 1e-9; });
    setup.loads.push_back({Load::Kind::traction, end, Vec3(stress, 0, 0)});
    setup.solver.integrator = integrator;
    setup.solver.step = step;
    setup.solver.tolerance = 1e-9;
    Solved solved;
    const auto world = trial.make(std::move(setup));
    Curve ours{std::string(integrator_name(integrator))};
    for (const double until : {0.02, 0.1, 0.2, 0.5, 1.0}) {
      while (world->time() < until - step / 2 && !world->halt()) world->tick();
      if (world->halt()) solved.failed = world->halt()->message;
      const double strain = world->positions()[static_cast<std::size_t>(end[0])].x() / edge - 1;
      ours.points.push_back({world->time(), strain});
      finding.rows.push_back(row_of(solved, fmt::format("strain at {} s", until), "m/m", strain,
                                    creep_strain(stress, at_last, branch, until), "closed form", 0.005,
                                    fmt::format("{}, steps of {} ms", integrator_name(integrator), 1e3 * step)));
    }
    finding.curves.push_back(ours);
  }
  return finding;
}

Finding viscous_loop(const Trial& trial) {
  const Cycle cycle{0.02, 100, 12, 0.001};  // small: relaxation of finite strains is not that of shear alone
  Material material = rubber(block_shear, bulk_of(block_shear, 0.45));
  material.density = 1;
  material.relaxation = {{gamma_1, tau_1}, {gamma_2, tau_2}};
  Finding finding;
  LinearSolid exact(block_shear, {{gamma_1, tau_1}, {gamma_2, tau_2}});
  Curve line{"last cycle", true};
  std::vector<double> stresses{0};
  double exact_work = 0, before = 0;
  const int last = cycle.steps * (cycle.quarters - 4);
  for (int k = 1; k <= cycle.steps * cycle.quarters; ++k) {
    const double shear = zigzag(k / static_cast<double>(cycle.steps), cycle.amplitude);
    stresses.push_back(exact.stress_after(shear - before, cycle.step));
    if (k > last) exact_work += (stresses[stresses.size() - 2] + stresses.back()) / 2 * (shear - before);
    if (k >= last) line.points.push_back({shear, stresses.back()});
    before = shear;
  }
  finding.curves.push_back(line);
  for (const Integrator integrator : implicit_methods) {
    Curve ours{std::string(integrator_name(integrator))};
    const std::string method = fmt::format("{}, steps of {} ms", integrator_name(integrator), 1e3 * cycle.step);
    double work = 0, shear_before = 0, stress_before = 0, peak = 0;
    const Solved solved =
        run_cycles(trial, block(material, integrator, cycle.step, [](const Vec3&) { return moved(0, Vec3::Zero()); }),
                   cycle, [&](double shear, double stress, int k) {
                     if (k > last) work += (stress + stress_before) / 2 * (shear - shear_before);
                     if (k >= last && k % 20 == 0) ours.points.push_back({shear, stress});
                     if (k == last + cycle.steps) peak = stress;
                     shear_before = shear, stress_before = stress;
                   });
    finding.rows.push_back(row_of(solved, "largest shear stress of the third cycle", "Pa", peak,
                                  stresses[static_cast<std::size_t>(last + cycle.steps)], "Prony series", 0.005,
                                  method));
    finding.rows.push_back(
        row_of(solved, "work lost in the third cycle", "J/m³", work, exact_work, "Prony series", 0.005, method));
    finding.curves.push_back(ours);
  }
  return finding;
}

Finding plastic_cycle(const Trial& trial) {
  const Cycle cycle{0.02, 200, 8, 0.001};
  constexpr double yield = 35, hardening = 4e3;  // Pa: flow begins at a shear of 0.005
  Material material = rubber(block_shear, bulk_of(block_shear, 0.45));
  material.density = 1;
  material.plasticity = Plasticity{yield, hardening};
  Finding finding;
  PlasticShear exact(block_shear, yield, hardening);
  Curve line{"two cycles", true, {{0, 0}}};
  std::vector<double> stresses{0};
  double before = 0;
  for (int k = 1; k <= cycle.steps * cycle.quarters; ++k) {
    const double shear = zigzag(k / static_cast<double>(cycle.steps), cycle.amplitude);
    stresses.push_back(exact.stress_after(shear - before));
    line.points.push_back({shear, stresses.back()});
    before = shear;
  }
  finding.curves.push_back(line);
  for (const Integrator integrator : implicit_methods) {
    Curve ours{std::string(integrator_name(integrator))};
    const std::string method = fmt::format("{}, {} steps a quarter", integrator_name(integrator), cycle.steps);
    std::vector<double> found{0};
    double work = 0, shear_before = 0;
    const Solved solved =
        run_cycles(trial, block(material, integrator, cycle.step, [](const Vec3&) { return moved(0, Vec3::Zero()); }),
                   cycle, [&](double shear, double stress, int k) {
                     work += (stress + found.back()) / 2 * (shear - shear_before);
                     if (k % 25 == 0) ours.points.push_back({shear, stress});
                     found.push_back(stress), shear_before = shear;
                   });
    for (const int quarter : {1, 3, 5, 7}) {
      const auto k = static_cast<std::size_t>(quarter * cycle.steps);
      if (k >= found.size()) break;
      finding.rows.push_back(row_of(solved, fmt::format("shear stress at turn {}", (quarter + 1) / 2), "Pa", found[k],
                                    stresses[k], "return mapping in one dimension", 0.002, method));
    }
    finding.rows.push_back(row_of(solved, "work lost in two cycles, and stored", "J/m³", work,
                                  exact.plastic_work() + stresses.back() * stresses.back() / (2 * block_shear),
                                  "return mapping in one dimension", 0.002, method));
    finding.curves.push_back(ours);
  }
  return finding;
}

}  // namespace heml::validation
