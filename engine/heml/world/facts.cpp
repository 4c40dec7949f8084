#include <algorithm>
#include <cmath>
#include <heml/elastic/mass_scaling.hpp>
#include <heml/math/bytes.hpp>
#include <heml/world/world_queries.hpp>
#include <numeric>

namespace heml {

std::size_t bytes_of_mesh(const TetMesh& mesh) {
  std::size_t sum = bytes_of(mesh.nodes, mesh.tets, mesh.regions, mesh.burns);
  for (const ElementField& field : mesh.fields) sum += bytes_of(field.values);
  return sum;
}

template <class Real>
std::size_t bytes_of_model(const Model<Real>& model) {
  std::size_t sum = bytes_of_mesh(model.mesh);
  sum += bytes_of(model.order.new_node, model.order.file_node, model.order.new_tet, model.order.file_tet);
  sum += bytes_of(model.midedges, model.spread_area);
  sum += bytes_of(model.material_of, model.loaded_faces.triangles, model.loaded_faces.tets, model.surface_nodes);
  sum += bytes_of(model.constrained, model.prescribed_motions, model.speeds);
  for (const DeadLoad<Real>& load : model.dead) sum += bytes_of(load.nodes, load.forces);
  for (const Pressure<Real>& load : model.pressures) sum += bytes_of(load.faces);
  return sum;
}

template <class Real>
StepFacts WorldQueries<Real>::step_facts() const {
  constexpr int most_steps = 1'000'000'000;  // a body may be too stiff for any number of them
  StepFacts facts;
  facts.tick = s_.setup->solver.tick();
  facts.stable = s_.limit.stable;
  if (is_explicit(s_.method) && !s_.setup->solver.step && s_.limit.stable > 0)
    facts.steps_per_tick = static_cast<int>(std::clamp(std::ceil(facts.tick / s_.limit.stable), 1.0, 1.0 * most_steps));
  const std::vector<Real>&lumped = s_.masses->lumped, &heavy = s_.masses->heavy();
  if (s_.setup->solver.mass_scaling > 0) {
    const double true_mass = std::accumulate(heavy.begin(), heavy.end(), 0.0);
    facts.added_mass = std::accumulate(lumped.begin(), lumped.end(), 0.0) / true_mass - 1;
    const std::vector<Real>& factors = s_.body.mass_factors(s_.team);
    facts.heavier_nodes = static_cast<int>(std::count_if(factors.begin(), factors.end(), [](Real f) { return f > 1; }));
  }
  NodeBounds<Real> nodes;
  const Real bound = s_.body.frequency_bound(s_.state.x.data(), s_.team, nodes, 0);
  const auto [element, share] = s_.body.largest_contribution(nodes.largest_node());
  if (element < 0 || !std::isfinite(bound)) return facts;
  facts.element = s_.model->order.file_tet[static_cast<std::size_t>(element)];
  std::vector<Real> bounds = nodes.bounds();
  const double most = static_cast<double>(bounds[nodes.largest_node()]);
  facts.element_share = share * most / static_cast<double>(bound);
  if (s_.setup->solver.mass_scaling == 0)
    for (const Real factor : mass_factors(bounds, lumped, StepFacts::offered))
      facts.scaled_step = std::max(facts.scaled_step, std::sqrt(static_cast<double>(factor)));
  const auto middle = bounds.begin() + static_cast<std::ptrdiff_t>(bounds.size() / 2);
  std::nth_element(bounds.begin(), middle, bounds.end());
  facts.median_ratio = most / static_cast<double>(*middle);
  return facts;
}

template <class Real>
std::optional<SolverFacts> WorldQueries<Real>::solver_facts() {
  if (is_explicit(s_.method)) return std::nullopt;
  const SolverSettings& solver = s_.setup->solver;
  const ImplicitState<Real>& parts = s_.implicit_state();
  SolverFacts facts;
  facts.minimiser = solver.is_static() ? Minimiser::newton : solver.minimiser;
  facts.preconditioner = parts.linear.preconditioner();
  facts.by_size = solver.preconditioner != facts.preconditioner;
  facts.projection = parts.linear.projection();
  facts.free_nodes = parts.free.node.size();
  facts.levels = parts.linear.levels();
  facts.tolerance = solver.relative_tolerance();
  facts.rescues = !solver.is_static() && !solver.step;
  facts.budget = solver.budget;
  return facts;
}

template <class Real>
std::vector<MemoryFacts> WorldQueries<Real>::memory_facts(std::optional<std::size_t> history) const {
  const auto of_motion = [](const Motion<Real>& motion) { return bytes_of(motion.x, motion.v); };
  std::vector<MemoryFacts> facts;
  facts.push_back({"elements", s_.body.bytes()});
  std::size_t mesh = bytes_of_mesh(s_.setup->mesh) + bytes_of_model(*s_.model) + bytes_of(s_.topology->elements);
  facts.push_back({"mesh", mesh});
  if (history) facts.push_back({"undo", *history});
  facts.push_back({"state", of_motion(s_.state) + of_motion(s_.last_valid) + bytes_of(s_.state.f, element_states_) +
                                s_.masses->bytes()});
  if (s_.recovery)
    facts.push_back({"recovery", of_motion(s_.recovery->last_good) + bytes_of(s_.recovery->last_good_internal.values)});
  if (s_.contacts.tissue) facts.push_back({"self-contact", s_.contacts.tissue->bytes()});
  if (!s_.implicit) return facts;
  const ImplicitState<Real>& parts = *s_.implicit;
  facts.push_back({"factors", parts.linear.bytes()});
  facts.push_back(
      {"solver vectors", bytes_of(parts.free.number, parts.free.node) +
                             bytes_of(parts.mass, parts.x, parts.v, parts.x_before, parts.v_before, parts.unbalanced)});
  return facts;
}

template std::size_t bytes_of_model(const Model<float>& model);
template std::size_t bytes_of_model(const Model<double>& model);
template class WorldQueries<float>;
template class WorldQueries<double>;

}  // namespace heml
