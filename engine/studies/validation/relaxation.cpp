// Materials with memory in simple shear, prescribed on the surface of a block.
#include <fmt/format.h>

#include <cmath>
#include <heml/mesh/generate.hpp>
#include <studies/validation/body.hpp>

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
  for (const Integrator integrator : {Integrator::backward_euler, Integrator::bdf2, Integrator::tr_bdf2}) {
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

}  // namespace heml::validation
