// Cases that change a body while it moves.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/materials/point.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/schedule.hpp>
#include <studies/stability/measures.hpp>

namespace heml::stability {
namespace {

Scene scene_named(const std::string& name) {
  return read_scene(assets_folder() / "scenes" / "extreme" / (name + ".json"));
}

/// Elastic and kinetic energy of given elements, J, from the law's formula at their deformation gradients.
double energy_of(const TetMesh& mesh, const std::vector<int>& elements, const Material& material,
                 const std::vector<Vec3>& x, const std::vector<Vec3>& v) {
  const auto point = make_material_point(material, true);
  double sum = 0;
  for (const int t : elements) {
    const Tet& tet = mesh.tets[static_cast<std::size_t>(t)];
    const auto node = [&](std::size_t c) { return static_cast<std::size_t>(tet[c]); };
    Mat3 Dm, Ds;
    for (std::size_t c = 1; c < 4; ++c) {
      Dm.col(static_cast<int>(c) - 1) = mesh.nodes[node(c)] - mesh.nodes[node(0)];
      Ds.col(static_cast<int>(c) - 1) = x[node(c)] - x[node(0)];
    }
    const double volume = Dm.determinant() / 6;
    sum += volume * point->energy(Ds * Dm.inverse());
    for (std::size_t c = 0; c < 4; ++c) sum += material.density * volume / 8 * v[node(c)].squaredNorm();
  }
  return sum;
}

double moving_and_stored(const Energies& energies) { return energies.kinetic + energies.elastic; }

/// A run of scene 29. Rises are of the total energy above that right after the last switch, or before the first; J.
struct SwitchedRun {
  Outcome outcome;  ///< value: largest |jump − difference of the laws| / energy
  double rise_before = 0, rise_after = 0, swing = 0;
};

SwitchedRun run_switched(const Trial& trial, const WorldSetup& setup) {
  const Scene scene = scene_named("29_law_switched");
  const auto world = trial.world(setup);
  const TetMesh& mesh = world->setup().mesh;
  Schedule schedule(scene, mesh);
  const std::vector<int> all = full_topology(mesh).elements;
  const std::vector<Vec3> still(mesh.nodes.size(), Vec3::Zero());
  double worst = 0, after_switch = 0;
  int switches = 0;
  bool jumps = false;
  SwitchedRun run;
  while (!world->halt() && world->time() < scene.solver.duration - 1e-9) {
    const Material old = world->setup().materials[0].material;
    const std::uint64_t hash = world->state_hash();
    const double before = world->energies().elastic;
    schedule.apply(*world);
    const Material& now = world->setup().materials[0].material;
    if (now.law != old.law || now.parameters != old.parameters) {
      const double after = world->energies().elastic;
      const auto x = world->positions();
      const double change = energy_of(mesh, all, now, x, still) - energy_of(mesh, all, old, x, still);
      worst = std::max(worst, std::abs(after - before - change) / std::max(after, before));
      jumps = jumps || world->state_hash() != hash;
      after_switch = total(synchronous_energies(*world));
      ++switches;
    }
    world->tick();
    const Energies energies = synchronous_energies(*world);
    run.swing = std::max(run.swing, std::abs(energies.potential));
    double& rise = switches == 0 ? run.rise_before : run.rise_after;
    rise = std::max(rise, total(energies) - after_switch);
  }
  run.outcome = world->halt() ? stopped(*world) : ended(*world, worst);
  if (jumps) run.outcome.broken = "positions or velocities jump";
  if (switches != 2) run.outcome.broken = "the law was not switched twice";
  return run;
}

}  // namespace

Outcome cut_away(const Trial& trial) {
  const Scene scene = scene_named("28_cut_away");
  const auto world = trial.world(trial.setup("28_cut_away"));
  const TetMesh& mesh = world->setup().mesh;
  Schedule schedule(scene, mesh);
  double worst = 0;
  std::size_t removed = 0;
  while (!world->halt() && world->time() < scene.solver.duration - 1e-9) {
    const auto x = world->positions(), v = world->velocities();
    const auto before = world->topology();
    const std::size_t edits = world->edits().size();
    schedule.apply(*world);
    world->tick();
    if (world->edits().size() == edits) continue;
    const EditReport& edit = world->edits().back();
    std::vector<int> gone;
    std::set_difference(before->elements.begin(), before->elements.end(), world->topology()->elements.begin(),
                        world->topology()->elements.end(), std::back_inserter(gone));
    removed += gone.size();
    const double jump = moving_and_stored(edit.before) - moving_and_stored(edit.after);
    const double theirs = energy_of(mesh, gone, world->setup().materials[0].material, x, v);
    worst = std::max(worst, std::abs(jump - theirs) / moving_and_stored(edit.before));
  }
  if (world->halt()) return stopped(*world);
  Outcome outcome = ended(*world, worst, fmt::format("{} cut away", removed));
  if (removed != 1000) outcome.broken = fmt::format("{} of 1000 were cut away", removed);
  return outcome;
}

Outcome law_switched(const Trial& trial) {
  WorldSetup setup = trial.setup("29_law_switched");
  const bool first_order = setup.solver.integrator == Integrator::symplectic_euler;
  if (first_order) setup.solver.rate = 2000;  // one step a tick under every law
  const SwitchedRun run = run_switched(trial, setup);
  double rise = run.rise_after - run.rise_before;  // without what the method does by itself
  std::string note = fmt::format("energy rises by {:.1e} of what swings afterwards", run.rise_after / run.swing);
  if (first_order && run.outcome.stopped.empty()) {
    // Its energy is off by a multiple of the step, of another size under each law: what half the step leaves of the
    // rise, extrapolated to none, is the switch's.
    setup.solver.rate *= 2;
    const SwitchedRun finer = run_switched(trial, setup);
    rise = 2 * finer.rise_after - run.rise_after;
    note += fmt::format(", {:.1e} in steps half as long", finer.rise_after / finer.swing);
  }
  Outcome outcome = run.outcome;
  outcome.note = note;
  if (!outcome.stopped.empty() || !outcome.broken.empty()) return outcome;
  if (rise > 0.01 * run.swing) outcome.broken = "energy rises after the switch";
  return outcome;
}

}  // namespace heml::stability
