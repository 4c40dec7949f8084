// Times of removals of one element and of a hundred, of the step after one, of a later step, and of the surface update.
// Milliseconds: median and minimum of 15 interleaved samples.
//
//   ninja -C build/release bench_removal && build/release/tests/bench_removal
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <heml/mesh/generate.hpp>
#include <heml/session/surface_mesh.hpp>

using namespace heml;

namespace {

template <class Work>
double milliseconds(const Work& work) {
  const auto began = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
}

struct Times {
  std::vector<double> all;
  std::string text() {
    std::sort(all.begin(), all.end());
    return fmt::format("{:8.2f} {:8.2f}", all[all.size() / 2], all.front());
  }
};

void measure(const char* law, Integrator integrator, bool nodal_pressure, int cells, int batch) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(0.1, 0.1, 0.1), {cells, cells, cells});
  Material material{law, {4e3, 3e3}, 1000};
  if (material.law == "neo_hookean_iso") material.parameters = {500, 5e4};
  if (material.law == "mass_spring") material.parameters = {10};
  setup.materials = {{std::nullopt, material}};
  Boundary constrained;
  for (std::size_t n = 0; n < setup.mesh.nodes.size(); ++n)
    if (setup.mesh.nodes[n].x() < 1e-9) constrained.nodes.push_back(static_cast<int>(n));
  setup.boundary = {constrained};
  setup.gravity = Vec3(0, -9.81, 0);
  setup.solver.integrator = integrator;
  setup.solver.step = is_explicit(integrator) ? 1e-5 : 1.0 / 60;
  setup.solver.nodal_pressure = nodal_pressure;
  setup.solver.continuation = true;
  setup.solver.threads = 1;
  const auto world = make_world(setup);
  world->tick();
  auto surface_mesh = make_surface_mesh(*world);
  const int count = static_cast<int>(setup.mesh.tets.size());
  Times removal, first_step, step, surface;
  for (int k = 0; k < 15; ++k) {
    RemoveElements command;
    for (int i = 0; i < batch; ++i) command.which.tets.push_back((k * batch + i) * 7919 % count);
    removal.all.push_back(milliseconds([&] { world->apply(command); }));
    first_step.all.push_back(milliseconds([&] { world->tick(); }));
    step.all.push_back(milliseconds([&] { world->tick(); }));
    surface.all.push_back(milliseconds([&] { surface_mesh = make_surface_mesh(*world, surface_mesh); }));
  }
  fmt::print("{:16} {:15} {:6} {:7} {:5} | {} | {} | {} | {}{}\n", law, integrator_name(integrator),
             nodal_pressure ? "nodal" : "p1", count, batch, removal.text(), first_step.text(), step.text(),
             surface.text(), world->halt() ? "  halted: " + world->halt()->message : "");
}

}  // namespace

int main() {
  fmt::print("{:16} {:15} {:6} {:>7} {:>5} | {:17} | {:17} | {:17} | {:17}\n", "law", "integrator", "", "tets", "batch",
             "removal", "step after", "later step", "surface");
  for (const int cells : {13, 27}) {
    measure("neo_hookean", Integrator::verlet, false, cells, 1);
    measure("neo_hookean", Integrator::verlet, false, cells, 100);
    measure("neo_hookean_iso", Integrator::verlet, true, cells, 1);
    measure("mass_spring", Integrator::verlet, false, cells, 1);
  }
  measure("neo_hookean", Integrator::backward_euler, false, 13, 1);
  measure("neo_hookean", Integrator::backward_euler, false, 13, 100);
}
