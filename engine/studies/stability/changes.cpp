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
  const Scene scene = scene_named("29_law_switched");
  const auto world = trial.world(trial.setup("29_law_switched"));
  const TetMesh& mesh = world->setup().mesh;
  Schedule schedule(scene, mesh);
  const std::vector<int> all = full_topology(mesh).elements;
  const std::vector<Vec3> still(mesh.nodes.size(), Vec3::Zero());
  double worst = 0, after_switch = 0, swing = 0, ripple = 0, spike = 0;
  int switches = 0;
  Outcome outcome;
  while (!world->halt() && world->time() < scene.solver.duration - 1e-9) {
    const Material old = world->setup().materials[0].material;
    const std::uint64_t hash = world->state_hash();
    const double before = world->energies().elastic;
    schedule.apply(*world);
    const Material& now = world->setup().materials[0].material;
    if (now.law != old.law || now.parameters != old.parameters) {
      const double after = world->energies().elastic;
      const auto x = world->positions();
      const double laws = energy_of(mesh, all, now, x, still) - energy_of(mesh, all, old, x, still);
      worst = std::max(worst, std::abs(after - before - laws) / std::max(after, before));
      if (world->state_hash() != hash) outcome.broken = "positions or velocities jump";
      after_switch = total(synchronous_energies(*world));
      ++switches;
    }
    world->tick();
    const Energies energies = synchronous_energies(*world);
    swing = std::max(swing, std::abs(energies.potential));
    double& rise = switches == 0 ? ripple : spike;  // ripple: energy change by the method itself
    rise = std::max(rise, total(energies) - after_switch);
  }
  if (world->halt()) return stopped(*world);
  const std::string broken = outcome.broken;
  outcome = ended(*world, worst, fmt::format("energy rises by {:.1e} of what swings afterwards", spike / swing));
  outcome.broken = broken;
  if (switches != 2) outcome.broken = "the law was not switched twice";
  if (spike > ripple + 0.01 * swing) outcome.broken = "energy rises after the switch";
  return outcome;
}

}  // namespace heml::stability
