#include <algorithm>
#include <chrono>
#include <cmath>
#include <heml/scenario/measure_features.hpp>
#include <heml/scenario/schedule.hpp>
#include <limits>
#include <thread>

namespace heml {
namespace {

constexpr int turns = 5;
constexpr double wanted = 0.2;  // s of wall time per run of the unchanged scene
constexpr long min_ticks = 2, max_measured_ticks = 2000;
constexpr double static_stretch = 0.1;  // of the load
constexpr double frames_a_second = 60;  // of a viewer that shows stretches

/// A change of one feature.
struct Change {
  std::string feature, from, to;
  std::function<void(WorldSetup&)> make = [](WorldSetup&) {};
  bool watched = false;  ///< whether stretches are computed for a viewer
};

bool any_material(const WorldSetup& setup, bool (*has)(const Material&)) {
  return std::any_of(setup.materials.begin(), setup.materials.end(),
                     [&](const RegionMaterial& entry) { return has(entry.material); });
}

/// Removes materials without elements, since every world made would warn of them again.
void drop_unused_materials(WorldSetup& setup) {
  std::erase_if(setup.materials, [&](const RegionMaterial& entry) {
    const auto& regions = setup.mesh.regions;
    return entry.region && std::find(regions.begin(), regions.end(), *entry.region) == regions.end();
  });
}

template <class Make>
std::function<void(WorldSetup&)> in_materials(const Make& make) {
  return [make](WorldSetup& setup) {
    for (RegionMaterial& entry : setup.materials) make(entry.material);
  };
}

/// Whether events change materials: the new law may not support nodal pressure, so the element is not changed then.
bool switches_material(const Scene& scene) {
  return std::any_of(scene.events.begin(), scene.events.end(),
                     [](const Event& event) { return std::holds_alternative<SetMaterial>(event.command); });
}

std::vector<Change> changes_of(const Scene& scene, const WorldSetup& setup) {
  const SolverSettings& solver = setup.solver;
  std::vector<Change> changes{{"as it is", "", ""}};
  const auto flag = [&](const char* feature, bool on, bool SolverSettings::*member) {
    changes.push_back({feature, on ? "on" : "off", on ? "off" : "on", [=](WorldSetup& s) { s.solver.*member = !on; }});
  };
  if (any_material(setup, [](const Material& m) { return m.viscosity > 0 || m.bulk_viscosity > 0; }))
    changes.push_back(
        {"viscosity", "on", "off", in_materials([](Material& m) { m.viscosity = m.bulk_viscosity = 0; })});
  if (any_material(setup, [](const Material& m) { return m.active_stress > 0; }))
    changes.push_back({"active_stress", "on", "off", in_materials([](Material& m) { m.active_stress = 0; })});
  if (any_material(setup, [](const Material& m) { return !m.relaxation.empty(); }))
    changes.push_back({"relaxation", "on", "off", in_materials([](Material& m) { m.relaxation.clear(); })});
  if (any_material(setup, [](const Material& m) { return m.plasticity.has_value(); }))
    changes.push_back({"plasticity", "on", "off", in_materials([](Material& m) { m.plasticity.reset(); })});
  flag("continuation", solver.continuation, &SolverSettings::continuation);
  if (!solver.is_static()) flag("recovery", solver.recovery, &SolverSettings::recovery);
  changes.push_back(
      {"self-contact", setup.self_contact ? "on" : "off", setup.self_contact ? "off" : "on", [](WorldSetup& s) {
         if (s.self_contact)
           s.self_contact.reset();
         else
           s.self_contact.emplace();
       }});
  const bool splits = std::all_of(setup.materials.begin(), setup.materials.end(), [&](const RegionMaterial& entry) {
    return find_law(entry.material.law)->has_volume_term &&
           entry.material.volume_term == setup.materials.front().material.volume_term;
  });
  if (splits && !switches_material(scene)) {
    SolverSettings other = solver;
    other.nodal_pressure = !solver.nodal_pressure;
    changes.push_back({"element", std::string(solver.element()), std::string(other.element()),
                       [](WorldSetup& s) { s.solver.nodal_pressure = !s.solver.nodal_pressure; }});
  }
  changes.push_back({"precision", solver.single_precision ? "float" : "double",
                     solver.single_precision ? "double" : "float",
                     [](WorldSetup& s) { s.solver.single_precision = !s.solver.single_precision; }});
  const bool alone = solver.threads == 1;
  if (std::thread::hardware_concurrency() > 1)
    changes.push_back({"threads", alone ? "1" : "all", alone ? "all" : "1",
                       [=](WorldSetup& s) { s.solver.threads = alone ? 0 : 1; }});
  changes.push_back({"watch of stretches", "off", "on", [](WorldSetup&) {}, true});
  return changes;
}

struct Run {
  double seconds = 0;
  long ticks = 0, steps = 0;
  std::vector<Vec3> positions;
  std::string halted;
};

Run run(const Scene& scene, const WorldSetup& setup, const Change& change, long ticks) {
  WorldSetup changed = setup;
  change.make(changed);
  const std::unique_ptr<World> world = make_world(std::move(changed));
  Schedule schedule(scene, setup.mesh);
  std::vector<int> nodes(setup.mesh.nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) nodes[n] = static_cast<int>(n);
  std::vector<float> stretches;
  Run result;
  double next_frame = 0;
  const auto begin = std::chrono::steady_clock::now();
  if (setup.solver.is_static()) {
    schedule.apply(*world);
    world->load_to(static_stretch);
    result.ticks = 1;
  }
  while (!setup.solver.is_static() && result.ticks < ticks && !world->halt()) {
    schedule.apply(*world);
    world->tick();
    ++result.ticks;
    if (!change.watched || world->time() < next_frame) continue;
    world->write_field(Field::stretch, nodes, stretches);
    next_frame += 1 / frames_a_second;
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.steps = world->steps();
  result.positions = world->positions();
  if (world->halt()) result.halted = world->halt()->message;
  return result;
}

double rms_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0;
  for (std::size_t n = 0; n < a.size(); ++n) sum += (a[n] - b[n]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

double max_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0;
  for (std::size_t n = 0; n < a.size(); ++n) largest = std::max(largest, (a[n] - b[n]).norm());
  return largest;
}

/// Number of ticks that take about `wanted` seconds, at most those of the scene.
long ticks_for(const Scene& scene, const WorldSetup& setup) {
  if (setup.solver.is_static()) return 1;
  const long of_scene = std::max(std::lround(setup.solver.duration / setup.solver.tick()), 1L);
  const Run trial = run(scene, setup, {}, std::min(min_ticks, of_scene));
  const double fitting = wanted * static_cast<double>(trial.ticks) / std::max(trial.seconds, 1e-6);
  return std::min({std::max(std::lround(fitting), min_ticks), of_scene, max_measured_ticks});
}

}  // namespace

Measurement measure_features(const Scene& scene, WorldSetup setup, const std::function<void(double)>& progress) {
  if (!switches_material(scene)) drop_unused_materials(setup);
  const std::vector<Change> changes = changes_of(scene, setup);
  const long ticks = ticks_for(scene, setup);
  Measurement measured;
  measured.turns = turns;
  measured.stretch = setup.solver.is_static() ? static_stretch : static_cast<double>(ticks) * setup.solver.tick();
  for (const Change& change : changes) {
    measured.changes.push_back({change.feature, change.from, change.to});
    measured.changes.back().milliseconds = std::numeric_limits<double>::infinity();
  }
  std::vector<Vec3> as_it_is;
  for (int round = 0; round < turns; ++round)
    for (std::size_t k = 0; k < changes.size(); ++k) {
      const Run done = run(scene, setup, changes[k], ticks);
      MeasuredChange& change = measured.changes[k];
      const double of_ticks = static_cast<double>(std::max(done.ticks, 1L));
      change.milliseconds = std::min(change.milliseconds, 1e3 * done.seconds / of_ticks);
      change.steps = static_cast<double>(done.steps) / of_ticks;
      change.halted = done.halted;
      if (k == 0) as_it_is = done.positions;
      change.error = rms_distance(done.positions, as_it_is);
      if (progress)
        progress(static_cast<double>(round * static_cast<int>(changes.size()) + static_cast<int>(k) + 1) /
                 static_cast<double>(turns * static_cast<int>(changes.size())));
    }
  measured.max_motion = max_distance(setup.mesh.nodes, as_it_is);
  return measured;
}

}  // namespace heml
