#include <algorithm>
#include <cmath>
#include <heml/math/bytes.hpp>
#include <heml/world/facts.hpp>
#include <heml/world/typed_world.hpp>

namespace heml {
namespace {

std::size_t bytes_of_mesh(const TetMesh& mesh) {
  std::size_t sum = bytes_of(mesh.nodes, mesh.tets, mesh.regions);
  for (const ElementField& field : mesh.fields) sum += bytes_of(field.values);
  return sum;
}

template <class Real>
std::size_t bytes_of_model(const Model<Real>& model) {
  std::size_t sum = bytes_of_mesh(model.mesh);
  sum += bytes_of(model.order.new_node, model.order.file_node, model.order.new_tet, model.order.file_tet);
  sum += bytes_of(model.material_of, model.loaded_faces.triangles, model.loaded_faces.tets, model.surface_nodes);
  sum += bytes_of(model.constrained, model.prescribed_motions, model.speeds);
  for (const DeadLoad<Real>& load : model.dead) sum += bytes_of(load.nodes, load.forces);
  for (const Pressure<Real>& load : model.pressures) sum += bytes_of(load.faces);
  return sum;
}

}  // namespace

template <class Real>
WorldFacts TypedWorld<Real>::facts() {
  const FlushDenormals flush;
  WorldFacts facts;
  facts.nodes = setup_.mesh.nodes.size();
  facts.tets = setup_.mesh.tets.size();
  facts.live_tets = topology_->elements.size();
  facts.constrained_nodes = model_.constrained.size();
  facts.faces = model_.loaded_faces.triangles.size();
  facts.threads = team_.size();
  facts.kernels = body_.kernels();
  facts.method = method_facts();
  facts.step = step_facts();
  facts.solver = solver_facts();
  facts.memory = memory_facts();
  return facts;
}

template <class Real>
StepFacts TypedWorld<Real>::step_facts() {
  StepFacts facts;
  facts.tick = setup_.solver.tick();
  facts.stable = stable_step_;
  if (is_explicit(method_) && !setup_.solver.step && stable_step_ > 0)
    facts.steps_per_tick = static_cast<int>(std::ceil(facts.tick / stable_step_));
  std::vector<Real> bounds = body_.element_bounds(state_.x.data());
  const auto largest = std::max_element(bounds.begin(), bounds.end());
  if (!(*largest > 0)) return facts;
  facts.element = model_.order.file_tet[static_cast<std::size_t>(largest - bounds.begin())];
  const double most = static_cast<double>(*largest);
  facts.element_share = std::min(most / static_cast<double>(body_.frequency_bound(state_.x.data(), team_)), 1.0);
  const auto middle = bounds.begin() + static_cast<std::ptrdiff_t>(bounds.size() / 2);
  std::nth_element(bounds.begin(), middle, bounds.end());
  facts.median_ratio = most / static_cast<double>(*middle);
  return facts;
}

template <class Real>
std::optional<SolverFacts> TypedWorld<Real>::solver_facts() {
  if (is_explicit(method_)) return std::nullopt;
  const SolverSettings& solver = setup_.solver;
  const ImplicitState<Real>& parts = implicit();
  SolverFacts facts;
  facts.minimiser = solver.is_static() ? Minimiser::newton : solver.minimiser;
  facts.preconditioner = parts.linear.preconditioner();
  facts.by_size = solver.preconditioner != facts.preconditioner;
  facts.projection = parts.linear.projection();
  facts.free_nodes = parts.free.node.size();
  facts.levels = parts.linear.levels();
  facts.tolerance = solver.relative_tolerance();
  facts.budget = solver.budget;
  return facts;
}

template <class Real>
std::size_t TypedWorld<Real>::bytes_to_undo() const {
  const auto of = [](const Saved& saved) {
    return bytes_of_mesh(saved.mesh) + bytes_of_model(saved.model) + saved.body.bytes() +
           bytes_of(saved.topology->elements, saved.state.x, saved.state.v, saved.state.f);
  };
  std::size_t sum = !saved_.empty() && saved_.front() == whole_ ? 0 : of(*whole_);
  for (const auto& saved : saved_) sum += of(*saved);
  return sum;
}

template <class Real>
std::vector<MemoryFacts> TypedWorld<Real>::memory_facts() const {
  const auto of_state = [](const State<Real>& state) { return bytes_of(state.x, state.v, state.f); };
  std::vector<MemoryFacts> facts;
  facts.push_back({"elements", body_.bytes()});
  std::size_t mesh = bytes_of_mesh(setup_.mesh) + bytes_of_model(model_) + bytes_of(topology_->elements);
  facts.push_back({"mesh", mesh});
  if (whole_) facts.push_back({"undo", bytes_to_undo()});
  facts.push_back({"state", of_state(state_) + of_state(last_valid_) +
                                bytes_of(mass_, inverse_mass_, inverse_mass_per_dof_, element_states_)});
  if (recovery_) facts.push_back({"recovery", of_state(recovery_->last_good)});
  if (contacts_.tissue) facts.push_back({"self-contact", contacts_.tissue->bytes()});
  if (!implicit_) return facts;
  const ImplicitState<Real>& parts = *implicit_;
  facts.push_back({"factors", parts.linear.bytes()});
  facts.push_back({"solver vectors", bytes_of(parts.free.number, parts.free.node) +
                                         bytes_of(parts.mass, parts.x, parts.v, parts.x_before, parts.v_before)});
  return facts;
}

template class TypedWorld<float>;
template class TypedWorld<double>;

}  // namespace heml
