#include <algorithm>
#include <cmath>
#include <heml/mesh/surface.hpp>
#include <heml/world/simulation.hpp>
#include <heml/world/simulation_snapshot.hpp>

namespace heml {
namespace {

constexpr std::size_t node_grain = 400;
constexpr double table_speed = 1;   // of the body's diagonal, 1/s: at which a table rises into tissue, or faster
constexpr double longest_rise = 2;  // s: from below pieces that lie deep
constexpr double touching = 1e-6;   // of the body's diagonal: tissue so deep in a table lies on it

std::vector<Material> materials_of(const WorldSetup& setup) {
  std::vector<Material> materials;
  for (const RegionMaterial& entry : setup.materials) materials.push_back(entry.material);
  return materials;
}

/// Of nodes [begin, end). By coordinate, so that the loop vectorises.
template <class Real>
void add_weights(const Real* mass, const Vector3<Real>& g, Real* f, std::size_t begin, std::size_t end) {
  const Real gx = g.x(), gy = g.y(), gz = g.z();
  for (std::size_t i = 3 * begin; i < 3 * end; i += 3) {
    f[i] += mass[i] * gx;
    f[i + 1] += mass[i + 1] * gy;
    f[i + 2] += mass[i + 2] * gz;
  }
}

BodyOptions options_of(const WorldSetup& setup) {
  return {setup.solver.continuation, setup.solver.nodal_pressure, setup.instruction_set, setup.solver.mass_scaling,
          setup.solver.threads};
}

}  // namespace

template <class Real>
Simulation<Real>::Simulation(WorldSetup setup_in)
    : setup(std::move(setup_in)),
      model(make_model<Real>(*setup)),
      topology(std::make_shared<const Topology>(full_topology(setup->mesh))),
      body(model->mesh, model->material_of, materials_of(*setup), options_of(*setup), model->midedges),
      team(setup->solver.threads) {
  const FlushDenormals flush;
  update_masses();
}

template <class Real>
Simulation<Real>::Simulation(const SimulationSnapshot<Real>& snapshot)
    : setup(snapshot.setup),
      model(snapshot.model),
      topology(snapshot.topology),
      body(snapshot.body, options_of(*setup), snapshot.values.state.x.data()),
      team(setup->solver.threads) {
  const FlushDenormals flush;
  restore(snapshot, *this);
}

template <class Real>
void Simulation<Real>::update_masses() {
  has_internal_state = body.has_internal_state();
  NodeMasses<Real> now;
  now.lumped = body.masses();
  if (!model->midedges.empty()) now.consistent = body.consistent_masses();
  if (const std::vector<Real>& factors = body.mass_factors(team); !factors.empty()) {
    if (now.consistent.empty()) now.consistent = now.lumped;
    for (std::size_t n = 0; n < factors.size(); ++n) now.lumped[n] *= factors[n];
  }
  now.inverse.reserve(now.lumped.size());
  for (const Real m : now.lumped) now.inverse.push_back(m > 0 ? 1 / m : Real(0));
  const std::vector<AxisSet> held = held_axes(*model);
  for (std::size_t n = 0; n < held.size(); ++n)
    if (held[n].are_all()) now.inverse[n] = 0;
  for (const PinnedPatch& pin : pins)
    for (const int n : pin.nodes) now.inverse[static_cast<std::size_t>(n)] = 0;
  now.inverse_per_dof.reserve(3 * now.inverse.size());
  for (std::size_t n = 0; n < held.size(); ++n)
    for (const bool is_held : held[n].has) now.inverse_per_dof.push_back(is_held ? Real(0) : now.inverse[n]);
  now.heavy_per_dof.reserve(now.inverse_per_dof.size());
  for (const Real m : now.heavy()) now.heavy_per_dof.insert(now.heavy_per_dof.end(), 3, m);
  if (now != *masses) masses = std::move(now);  // else others may share them still
  for (auto& grasp : grasps) grasp.update_masses(masses->inverse);
}

template <class Real>
void Simulation<Real>::update_regions() {
  Model<Real>& inner = model.write();
  inner.mesh.region_names = setup->mesh.region_names;
  for (std::size_t t = 0; t < inner.mesh.tets.size(); ++t) {
    inner.mesh.regions[t] = setup->mesh.regions[static_cast<std::size_t>(inner.order.file_tet[t])];
    inner.material_of[t] = material_of_region(inner.mesh.regions[t], setup->materials);
  }
  body.set_material_of(materials_of(*setup), inner.material_of, state.x.data());
}

template <class Real>
void Simulation<Real>::move_constrained(bool moving_alone) {
  for (const ConstrainedNode& constrained : model->constrained) {
    if (moving_alone && !(model->speeds[static_cast<std::size_t>(constrained.entry)] > 0)) continue;
    const PrescribedMotion::At at = prescribed_at(*model, constrained, state.time);
    set_along(constrained.axes, constrained.node, at.x, state.x);
    set_along(constrained.axes, constrained.node, at.v, state.v);
  }
  for (const PinnedPatch& pin : pins)
    for (std::size_t k = 0; k < pin.nodes.size(); ++k) {
      const auto n = 3 * static_cast<std::size_t>(pin.nodes[k]);
      Eigen::Map<Vector3<Real>>(&state.x[n]) = pin.positions[k].template cast<Real>();
      Eigen::Map<Vector3<Real>>(&state.v[n]).setZero();
    }
}

template <class Real>
double Simulation<Real>::load() const {
  return setup->solver.is_static() ? Ramp{0, setup->solver.load_duration()}(state.time) : 1;
}

template <class Real>
Vec3 Simulation<Real>::gravity() const {
  return load() * setup->gravity;
}

template <class Real>
bool Simulation<Real>::evaluate_forces() {
  const Real* x = state.x.data();
  Real* f = state.f.data();
  body.set_activation(load());
  const bool valid = acting_body().forces(x, f, team);
  const Vector3<Real> g = gravity().template cast<Real>();
  if (!g.isZero(0))
    team.parallel_for(node_count(), node_grain, [&](std::size_t begin, std::size_t end) {
      add_weights(masses->heavy_per_dof.data(), g, f, begin, end);
    });
  for (const auto& load : model->dead) add_load(load, state.time, f);
  for (const auto& load : model->pressures) add_load(load, state.time, x, f);
  for (const auto& grasp : grasps) grasp.add_forces(x, state.v.data(), f);
  if (!contacts.empty() && implicit && !is_explicit(method) && !recovering()) {
    Vector contact = Vector::Zero(static_cast<Eigen::Index>(state.x.size()));
    implicit->body.add_contact(as_vector(state.x), contact);
    for (std::size_t i = 0; i < state.f.size(); ++i) f[i] += static_cast<Real>(contact[static_cast<Eigen::Index>(i)]);
  }
  return valid;
}

template <class Real>
Energies Simulation<Real>::energies() {
  Energies e;
  const Vec3 g = gravity();
  for (std::size_t n = 0; n < masses->lumped.size(); ++n) {
    const double m = static_cast<double>(masses->lumped[n]);
    const Vec3 v = Eigen::Map<const Vector3<Real>>(&state.v[3 * n]).template cast<double>();
    const Vec3 x = Eigen::Map<const Vector3<Real>>(&state.x[3 * n]).template cast<double>();
    e.kinetic += m / 2 * v.squaredNorm();
    e.potential -= static_cast<double>(masses->heavy()[n]) * g.dot(x - model->mesh.nodes[n]);
  }
  body.set_activation(load());
  e.elastic = acting_body().energy(state.x.data(), team);
  return e;
}

template <class Real>
void Simulation<Real>::set_state(const Vector& x, const Vector& v, double time) {
  const Vector& f = (recovering() ? recovery->surrogate->implicit : implicit_state()).body.forces();
  for (std::size_t i = 0; i < state.x.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    state.x[i] = static_cast<Real>(x[k]);
    state.v[i] = static_cast<Real>(v[k]);
    state.f[i] = static_cast<Real>(f[k]);
  }
  state.time = time;
  last_valid = state;
}

template <class Real>
ImplicitState<Real>& Simulation<Real>::implicit_state() {
  if (!implicit)
    implicit = std::make_unique<ImplicitState<Real>>(
        body, model, masses,
        preconditioner_moduli(model->mesh, model->material_of, setup->materials, setup->solver.minimiser), grasps,
        contacts, team, setup->solver, setup->instruction_set);
  return *implicit;
}

template <class Real>
void Simulation<Real>::install_surrogate() {
  recovery->surrogate =
      std::make_unique<RecoverySurrogate<Real>>(model, *setup, masses, grasps, contacts, team);
}

template <class Real>
std::vector<ConstrainedNode> Simulation<Real>::constrained_nodes() const {
  std::vector<ConstrainedNode> nodes = model->constrained;
  for (const PinnedPatch& pin : pins)
    for (const int n : pin.nodes) nodes.push_back({n, -1});
  return nodes;
}

template <class Real>
std::vector<Vec3> Simulation<Real>::in_file_order(const std::vector<Real>& values) const {
  std::vector<Vec3> result(values.size() / 3);
  for (std::size_t file = 0; file < result.size(); ++file) {
    const Real* value = &values[3 * static_cast<std::size_t>(model->order.new_node[file])];
    result[file] = Vec3(value[0], value[1], value[2]);
  }
  return result;
}

// The body is where it will meet them.
template <class Real>
void Simulation<Real>::place_tables() {
  contacts.tables.clear();
  for (const Table& table : setup->tables) {
    contacts.tables.push_back({table});
    contacts.tables.back().table.normal.normalize();
  }
  update_contact_surfaces();
  for (PlacedTable& placed : contacts.tables) find_rise(placed);
}

// From below the deepest node. In static worlds time does not pass.
template <class Real>
void Simulation<Real>::find_rise(PlacedTable& placed) const {
  if (setup->solver.is_static()) return;
  const auto at = [this](int n) {
    const Real* x = &state.x[3 * static_cast<std::size_t>(n)];
    return Vec3(static_cast<double>(x[0]), static_cast<double>(x[1]), static_cast<double>(x[2]));
  };
  double deepest = 0;
  for (const int n : contacts.boundary.nodes)
    deepest = std::max(deepest, placed.table.normal.dot(placed.table.point - at(n)));
  placed.depth = deepest > touching * model->diagonal ? deepest : 0;
  placed.speed = std::max(table_speed * model->diagonal, placed.depth / longest_rise);
  placed.start = state.time;
}

// There are other surfaces, or the body has another skin.
template <class Real>
void Simulation<Real>::update_contact_surfaces() {
  update_contact_boundary();
  for (PlacedTable& placed : contacts.tables)
    if (placed.rises(state.time)) find_rise(placed);  // what was deepest may be gone
  contacts.reports.assign(contacts.surfaces(state.time).size(), {});
  impulses.begin_tick();
  impulses.set_memory({});
  if (implicit) implicit->body.reset_contact();
  if (recovering()) recovery->surrogate->implicit.body.reset_contact();
}

// The body has other elements, or begins anew. Quadratic ones bear on each other as the linear ones on their nodes.
template <class Real>
void Simulation<Real>::update_self_contact() {
  if (!setup->self_contact) return;
  if (model->midedges.empty())
    contacts.tissue.emplace(*setup->self_contact, model->mesh);
  else
    contacts.tissue.emplace(*setup->self_contact, subdivided(model->mesh, model->midedges));
}

// The nodes of the surface that are free, and its faces where something may be smaller than they are.
template <class Real>
void Simulation<Real>::update_contact_boundary() {
  contacts.boundary = {};
  if (contacts.tables.empty() && !contacts.probe) return;
  for (const int n : model->surface_nodes)
    if (masses->inverse[static_cast<std::size_t>(n)] > 0) contacts.boundary.nodes.push_back(n);
  if (contacts.probe) contacts.boundary.faces = fine_boundary(model->mesh, model->midedges).triangles;
}

template struct Simulation<float>;
template struct Simulation<double>;

}  // namespace heml
