#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/materials/energy_law.hpp>
#include <heml/materials/material.hpp>
#include <heml/mesh/region_tag.hpp>
#include <heml/world/command_executor.hpp>
#include <heml/world/conditions.hpp>
#include <heml/world/stable_step.hpp>

namespace heml {
namespace {
bool finite(const Vec3& v) { return v.allFinite(); }

}  // namespace

/// replaced: the entry that the material is to take the place of; null: it is one more.
template <class Real>
Status CommandExecutor<Real>::refused(const Material& material, const RegionMaterial* replaced) const {
  const LawInfo* law = find_law(material.law);
  const SolverSettings& solver = s_.setup->solver;
  if (solver.nodal_pressure && law && !law->has_volume_term)
    return fmt::format("material.law: '{}' has no separate volume term, which element {} needs", law->name,
                       solver.element());
  if (solver.quadratic && law && !law->is_continuum)
    return fmt::format("material.law: '{}' has no quadratic elements", law->name);
  for (const RegionMaterial& other : s_.setup->materials)
    if (solver.nodal_pressure && !solver.quadratic && &other != replaced &&
        other.material.volume_term != material.volume_term)
      return "material.volume_term: with nodal pressure it must be that of the other materials";
  if (!material.fields.empty()) return "material: a switched material takes numbers, not fields";
  if (!material.fibre_field.empty() && (!replaced || replaced->material.fibre_field != material.fibre_field))
    return "material.fibre: a switched material takes the field of the one before, or a direction";
  if (const auto problem = material_problem(material))
    return fmt::format("material.{}: {}", problem->first, problem->second);
  if (solver.continuation && find_energy_law(material.law))
    return "material.law: a law by expression has no continuation, which solver.continuation asks for";
  return {};
}

/// Updates what depends on the materials of elements.
template <class Real>
void CommandExecutor<Real>::follow_materials() {
  s_.update_masses();
  s_.implicit.reset();
  s_.lowest_frequency.reset();
  recovery_.follow_change();
  find_stable_step(s_);
  method_.choose();
}

/// The entry of `materials` of a region. what: the command, for messages.
template <class Real>
Status CommandExecutor<Real>::find_entry(const char* what, std::optional<int> region, std::size_t& index) const {
  const auto entry = std::find_if(s_.setup->materials.begin(), s_.setup->materials.end(),
                                  [&](const RegionMaterial& m) { return m.region == region; });
  index = static_cast<std::size_t>(entry - s_.setup->materials.begin());
  if (entry != s_.setup->materials.end()) return {};
  return region ? fmt::format("{}: no entry for region {}", what, *region)
                : fmt::format("{}: there is no default entry; name a region", what);
}

template <class Real>
Status CommandExecutor<Real>::execute(const SetActiveStress& command) {
  std::size_t index = 0;
  if (const Status status = find_entry("active_stress", command.region, index); !status.ok()) return status;
  Material material = s_.setup->materials[index].material;
  if (!material.gives_fibre()) return "active_stress: the material has no fibre, along which it would act";
  material.active_stress = command.stress;
  if (const auto problem = material_problem(material))
    return fmt::format("active_stress: {} {}", problem->first, problem->second);
  s_.setup.write().materials[index].material = material;
  s_.body.set_active_stress(index, command.stress);
  follow_materials();
  return {};
}

template <class Real>
Status CommandExecutor<Real>::execute(const SetMaterial& command) {
  std::size_t index = 0;
  if (const Status status = find_entry("material", command.region, index); !status.ok()) return status;
  if (const Status status = refused(command.material, &s_.setup->materials[index]); !status.ok()) return status;
  s_.setup.write().materials[index].material = command.material;
  s_.body.set_material(index, command.material, s_.state.x.data());
  follow_materials();
  return {};
}

/// Of a region without an entry: of elements that it has already, else of the first that it is to have.
template <class Real>
RegionMaterial CommandExecutor<Real>::copied_material(const TaggedRegion& region) const {
  const WorldSetup& setup = *s_.setup;
  const auto in_region = [&](int t) { return setup.mesh.regions[static_cast<std::size_t>(t)] == region.number; };
  const std::vector<int>& elements = s_.topology->elements;
  const bool is_there = std::any_of(elements.begin(), elements.end(), in_region);
  const int from = is_there ? region.number : setup.mesh.regions[static_cast<std::size_t>(region.tets.front())];
  const int entry = material_of_region(from, setup.materials);
  return {region.number, setup.materials[static_cast<std::size_t>(entry)].material};
}

template <class Real>
Status CommandExecutor<Real>::execute(const TagRegion& command) {
  TaggedRegion region;
  if (const Status status = resolve_region(command.tag, s_.setup->mesh, *s_.topology, region); !status.ok())
    return "region: " + status.message();
  const auto& materials = s_.setup->materials;
  const auto entry = std::find_if(materials.begin(), materials.end(),
                                  [&](const RegionMaterial& m) { return m.region == region.number; });
  const bool is_new = entry == materials.end();
  RegionMaterial material = is_new ? copied_material(region) : *entry;
  if (command.material) material.material = *command.material;
  const bool copies_fields = !material.material.fields.empty() || !material.material.fibre_field.empty();
  if (is_new && copies_fields) return "region: its material would vary by a field of the mesh: give it one of numbers";
  if (command.material || is_new)
    if (const Status status = refused(material.material, is_new ? nullptr : &*entry); !status.ok())
      return "region: " + status.message();
  const auto index = static_cast<std::size_t>(entry - materials.begin());
  WorldSetup& setup = s_.setup.write();
  if (is_new)
    setup.materials.push_back(material);
  else
    setup.materials[index] = material;
  if (!is_new && command.material) s_.body.set_material(index, material.material, s_.state.x.data());
  tag_region(region, setup.mesh);
  setup.tagged.push_back(std::move(region));
  s_.topology = std::make_shared<const Topology>(Topology{s_.topology->version + 1, s_.topology->elements});
  ++s_.region_changes;
  s_.update_regions();
  follow_materials();
  return {};
}

template <class Real>
Status CommandExecutor<Real>::execute(const SetDamping& command) {
  if (!(command.damping >= 0) || !std::isfinite(command.damping))
    return fmt::format("damping: must be 0 1/s or more, is {}", command.damping);
  s_.setup.write().solver.damping = command.damping;
  return {};
}

template <class Real>
Status CommandExecutor<Real>::execute(const SetGravity& command) {
  if (!finite(command.gravity)) return "gravity: not finite";
  s_.setup.write().gravity = command.gravity;
  return {};
}

template <class Real>
Status CommandExecutor<Real>::execute(const SetIntegrator& command) {
  if ((command.integrator == Integrator::static_equilibrium) != s_.setup->solver.is_static())
    return "integrator: a scene is static from its start or not at all";
  s_.setup.write().solver.integrator = command.integrator;
  s_.implicit.reset();
  method_.choose();
  return {};
}

template <class Real>
Status CommandExecutor<Real>::execute(const SetBudget& command) {
  if (command.iterations < 1) return "budget: needs one iteration or more";
  std::optional<Budget>& budget = s_.setup.write().solver.budget;
  if (!budget) budget.emplace();
  budget->iterations = command.iterations;
  return {};
}

template <class Real>
Status CommandExecutor<Real>::execute(const SetRate& command) {
  if (!(command.rate >= 1 && command.rate <= 1e6)) return "rate: must be 1 to 1e6 Hz";
  if (s_.setup->solver.is_static()) return "rate: a static scene has no ticks of time";
  s_.elapsed_before_rate = s_.elapsed();
  s_.rate_tick = s_.origin_tick = s_.ticks;
  s_.origin_time = s_.state.time;
  s_.setup.write().solver.step.reset();
  s_.setup.write().solver.rate = command.rate;
  method_.choose();
  return {};
}

template <class Real>
Status CommandExecutor<Real>::execute(const SetStepCost& command) {
  if (!(command.nanoseconds > 0) || !std::isfinite(command.nanoseconds))
    return "step_cost: must be more than 0 ns an element";
  method_.set_step_cost(1e-9 * command.nanoseconds);
  return {};
}

template <class Real>
Status CommandExecutor<Real>::execute(const AdoptPreconditioner&) {
  implicit_.adopt_preconditioner();
  return {};
}

template <class Real>
Status CommandExecutor<Real>::execute(const SetBoundary& command) {
  if (Status status = replace_boundary(s_, command.entries); !status.ok()) return status;
  update_constraints(s_, recovery_);
  return {};
}

template <class Real>
Status CommandExecutor<Real>::execute(const SetLoads& command) {
  if (Status status = replace_loads(s_, command.entries); !status.ok()) return status;
  if (s_.recovering()) s_.install_surrogate();  // its solver may be of a model that snapshots alone hold now
  return {};
}

template class CommandExecutor<float>;
template class CommandExecutor<double>;

}  // namespace heml
