// The parts of a body: their construction, and what depends on all of them together.
#include <algorithm>
#include <cassert>
#include <heml/elastic/body.hpp>
#include <heml/elastic/energy_term.hpp>
#include <heml/elastic/viscoelastic_term.hpp>

namespace heml {
namespace {

/// Values of elements as values of their integration points.
std::vector<int> repeated(const std::vector<int>& of_elements) {
  std::vector<int> result;
  for (const int value : of_elements) result.insert(result.end(), element_points, value);
  return result;
}

}  // namespace

template <class Real>
ElasticBody<Real>::ElasticBody(const TetMesh& mesh, const std::vector<int>& material_of,
                               const std::vector<Material>& materials, BodyOptions options, const MidEdges& midedges)
    : materials_(materials), options_(options) {
  set_elements(mesh, material_of, midedges);
  make_parts();
  make_fans();
  for (Part& part : parts_) part.reset_history(at_rest().data());
}

template <class Real>
ElasticBody<Real>::ElasticBody(const BodySnapshot<Real>& snapshot, BodyOptions options, const Real* x)
    : materials_(snapshot.materials), options_(options) {
  restore(snapshot, x);
}

template <class Real>
std::vector<Real> ElasticBody<Real>::at_rest() const {
  std::vector<Real> x;
  for (const Vec3& X : layout_->mesh.nodes)
    for (const double value : X) x.push_back(static_cast<Real>(value));
  return x;
}

template <class Real>
void ElasticBody<Real>::set_elements(const TetMesh& mesh, const std::vector<int>& material_of,
                                     const MidEdges& midedges) {
  BodyLayout<Real> layout;
  layout.mesh = midedges.empty() ? mesh : virtual_tets(mesh, midedges);
  layout.material_of = midedges.empty() ? material_of : repeated(material_of);
  if (!midedges.empty()) layout.virtual_corners.emplace(mesh, midedges);
  layout_ = std::move(layout);
}

template <class Real>
void ElasticBody<Real>::make_parts() {
  parts_.clear();
  for (std::size_t m = 0; m < materials_.size(); ++m) {
    std::vector<int> elements;
    for (std::size_t t = 0; t < layout_->material_of.size(); ++t)
      if (layout_->material_of[t] == static_cast<int>(m)) elements.push_back(static_cast<int>(t));
    if (!elements.empty()) parts_.push_back(make_part(m, elements));
  }
  join_parts();
}

/// The fan kernels run a law unless it is an expression of stretches.
/// Integration points have no neighbours to share a fan with.
template <class Real>
typename ElasticBody<Real>::Part ElasticBody<Real>::make_part(std::size_t index,
                                                              const std::vector<int>& elements) const {
  return make_part(index, make_group<Real>(layout_->mesh, elements, materials_[index]));
}

template <class Real>
typename ElasticBody<Real>::Part ElasticBody<Real>::make_part(std::size_t index,
                                                              Shared<ElementGroup<Real>> at_rest) const {
  const Material& material = materials_[index];
  if (material.plasticity) at_rest = ElementGroup<Real>(*at_rest);  // flow changes it
  Part part{index, std::move(at_rest), {}, nullptr, nullptr, {}, false, {}};
  const bool by_element = options_.nodal_pressure && layout_->virtual_corners;
  Material of_points = material;
  if (by_element) {
    std::vector<Real> kappa = split_volume_modulus(of_points, part.group);
    if (std::any_of(kappa.begin(), kappa.end(), [](Real value) { return value > 0; }))
      part.dilatation =
          std::make_unique<MeanDilatation<Real>>(std::move(kappa), material.volume_term, options_.continuation);
  }
  part.terms = make_terms<Real>(of_points, options_.continuation, options_.nodal_pressure && !by_element);
  set_active_term(part, material.active_stress);
  auto density = static_cast<Real>(material.density);
  if (layout_->virtual_corners) density /= static_cast<Real>(frequency_ratio);  // for bounds of frequencies alone
  if (part.group->density != density) part.group.write().density = density;
  for (const auto& term : part.terms) term->begin_step(step_);
  part.flow = make_flow<Real>(material, options_.continuation, *part.group);
  part.flows_within_steps =
      part.flow && material.viscosity == 0 && material.bulk_viscosity == 0 && material.relaxation.empty();
  if (layout_->virtual_corners)
    part.points = point_forces<Real>(of_points, options_.continuation, options_.instruction_set);
  part.in_fans = !part.terms.empty() && !layout_->virtual_corners && has_kernel(material);
  for (const auto& term : part.terms)
    if (auto* memory = dynamic_cast<ViscoelasticTerm<Real>*>(term.get())) part.memory = memory;
  if (part.in_fans && part.memory) part.memory->leave_state_to_fans();
  return part;
}

/// Makes, changes or removes the term of active stress.
template <class Real>
void ElasticBody<Real>::set_active_term(Part& part, double stress) const {
  if (stress == 0) {
    if (part.active) part.terms.pop_back();
    part.active = nullptr;
    return;
  }
  assert(!part.group->fibre[0].empty());
  const auto acting = static_cast<Real>(activation_ * stress);
  if (part.active) return part.active->set_stress(acting);
  auto term = std::make_unique<ActiveTerm<Real>>(acting);
  part.active = term.get();
  part.terms.push_back(std::move(term));
}

template <class Real>
void ElasticBody<Real>::set_active_stress(std::size_t index, double stress) {
  const bool had = materials_[index].active_stress != 0;
  materials_[index].active_stress = stress;
  for (Part& part : parts_)
    if (part.material == index) set_active_term(part, stress);
  if (had != (stress != 0)) join_parts();
}

template <class Real>
void ElasticBody<Real>::set_activation(double part) {
  if (part == activation_) return;
  activation_ = part;
  for (Part& each : parts_)
    if (each.active) set_active_term(each, materials_[each.material].active_stress);
}

/// The part of a group that was made for another material, which may be the group of this one too.
template <class Real>
typename ElasticBody<Real>::Part ElasticBody<Real>::remake_part(std::size_t index, const Material& before,
                                                                Shared<ElementGroup<Real>> at_rest) const {
  const Material& now = materials_[index];
  const bool splits_fields = options_.nodal_pressure && layout_->virtual_corners;  // split_volume_modulus()
  const bool same = before.fibre == now.fibre && before.fibre_field == now.fibre_field && before.fields == now.fields &&
                    !(splits_fields && !now.fields.empty());
  return same ? make_part(index, std::move(at_rest)) : make_part(index, at_rest->element);
}

/// Numbers the corners of all parts consecutively; returns how many there are, padding included.
template <class Real>
std::size_t ElasticBody<Real>::number_corners() {
  std::size_t next = 0;
  for (Part& part : parts_) {
    if (part.group->first_corner != next) part.group.write().first_corner = next;
    next += 4 * part.group->volume.size();
  }
  corner_ = {};
  return next;
}

/// Rebuilds what depends on all parts together, except the fans.
template <class Real>
void ElasticBody<Real>::join_parts() {
  typename BodyLayout<Real>::Joints joints;
  step_weights_.reset();
  evaluated_ = false;
  joints.corner_count = number_corners();
  std::vector<const ElementGroup<Real>*> groups;
  for (const Part& part : parts_) groups.push_back(&*part.group);
  joints.corners = map_corners(groups, layout_->mesh.nodes.size());
  if (layout_->virtual_corners) {
    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (!parts_[p].in_points()) groups[p] = nullptr;
    joints.points = PointLayout(groups, *layout_->virtual_corners);
  } else {
    joints.force_corners = force_corners(joints.corners);
    joints.springs = Springs<Real>(layout_->mesh, spring_stiffness());
  }
  if (!(joints == layout_->joints)) layout_.write().joints = std::move(joints);
  make_pressure();
}

template <class Real>
CornerMap ElasticBody<Real>::force_corners(const CornerMap& all) const {
  CornerMap result{std::vector<std::size_t>(nodes() + 1, 0), {}};
  const bool loops_for_pressure = options_.nodal_pressure && !pressure_in_fans();
  const auto has_loops = [&](const Part& part) { return part.has_loops(loops_for_pressure); };
  const auto is_in_loops = [&](std::size_t corner) {
    return std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) {
      const std::size_t first = part.group->first_corner;
      return has_loops(part) && corner >= first && corner < first + 4 * part.group->volume.size();
    });
  };
  if (std::none_of(parts_.begin(), parts_.end(), has_loops)) return result;
  for (std::size_t n = 0; n < nodes(); ++n) {
    for (std::size_t k = all.start[n]; k < all.start[n + 1]; ++k)
      if (is_in_loops(all.corners[k])) result.corners.push_back(all.corners[k]);
    result.start[n + 1] = result.corners.size();
  }
  return result;
}

/// Whether the fans have all elements, so that they evaluate averaged nodal pressure too.
template <class Real>
bool ElasticBody<Real>::pressure_in_fans() const {
  return options_.nodal_pressure &&
         std::all_of(parts_.begin(), parts_.end(), [](const Part& part) { return part.in_fans; });
}

template <class Real>
std::vector<FanPart> ElasticBody<Real>::fan_parts() const {
  std::vector<FanPart> parts;
  for (const Part& part : parts_) {
    const Material& material = materials_[part.material];
    const bool isochoric = options_.nodal_pressure || material.volume_term != VolumeTerm::quadratic;
    if (part.in_fans) parts.push_back({&part.group->element, &material, isochoric, true, options_.nodal_pressure});
  }
  return parts;
}

template <class Real>
void ElasticBody<Real>::make_fans() {
  fans_ = {};
  const std::vector<FanPart> parts = fan_parts();
  if (parts.empty()) return;
  ThreadTeam team = layout_team();
  fans_ = FanForces<Real>(layout_->mesh, parts, options_.continuation, options_.instruction_set, team);
  fans_.begin_step(step_);
}

/// Updates the fans to the present mesh, whose element t is origins[t] of the mesh `before` or a piece of it.
template <class Real>
void ElasticBody<Real>::update_fans(const TetMesh& before, const std::vector<int>& origins) {
  const std::vector<FanPart> parts = fan_parts();
  ThreadTeam team = layout_team();
  if (parts.empty() || !fans_.update_layout(before, layout_->mesh, parts, origins, team)) make_fans();
}

/// Of each element, N/m; 0 where it has no springs.
template <class Real>
std::vector<double> ElasticBody<Real>::spring_stiffness() const {
  std::vector<double> stiffness(layout_->mesh.tets.size(), 0.0);
  for (std::size_t t = 0; t < stiffness.size(); ++t) {
    const Material& material = materials_[static_cast<std::size_t>(layout_->material_of[t])];
    if (!find_law(material.law)->is_continuum) stiffness[t] = material.parameters[0];
  }
  for (const Part& part : parts_)  // stiffness from a field
    if (!find_law(materials_[part.material].law)->is_continuum && !part.group->parameters.empty())
      for (std::size_t s = 0; s < part.group->size(); ++s)
        stiffness[static_cast<std::size_t>(part.group->element[s])] = static_cast<double>(part.group->parameters[0][s]);
  return stiffness;
}

/// After all else of the parts, to which it refers: plastic flow writes to groups of which there is no other user.
template <class Real>
void ElasticBody<Real>::make_pressure() {
  pressure_.reset();
  if (!options_.nodal_pressure || layout_->virtual_corners) return;
  std::vector<const ElementGroup<Real>*> groups;
  std::vector<std::vector<Real>> kappa;
  for (const Part& part : parts_) {
    groups.push_back(&*part.group);
    kappa.push_back(volume_moduli(*part.group, materials_[part.material]));
  }
  const VolumeTerm term = materials_[parts_.front().material].volume_term;
  pressure_ = std::make_unique<NodalPressure<Real>>(std::move(groups), layout_->joints.corners, kappa, term,
                                                    options_.continuation);
}

template <class Real>
std::size_t ElasticBody<Real>::bytes() const {
  std::size_t sum = layout_->bytes() + bytes_of(corner_, of_element_, shared_force_, virtual_x_, evaluated_x_);
  sum += bytes_of(linearisation_point_, packet_energy_, node_volume_, due_packets_, weighted_bound_);
  if (step_weights_) sum += step_weights_->bytes();
  for (const Part& part : parts_) {
    sum += part.group->bytes();
    sum += bytes_of(part.stiffness) + (part.flow ? part.flow->bytes() : 0);
    if (part.dilatation) sum += part.dilatation->bytes();
    if (part.memory) sum += part.memory->scratch_bytes();
    for (const auto& term : part.terms)
      for (const SlotState<Real>& state : term->slot_states()) sum += bytes_of(*state.values);
  }
  return sum + fans_.bytes() + (pressure_ ? pressure_->bytes() : 0);
}

/// As meshed, m³: heat takes no mass.
template <class Real>
Real ElasticBody<Real>::meshed_volume(const ElementGroup<Real>& group, std::size_t s) const {
  const auto t = static_cast<std::size_t>(group.element[s]);
  if (rest_scale(layout_->mesh, t) == 1) return group.volume[s];
  const std::vector<Vec3>& X = layout_->mesh.nodes;
  const auto& [a, b, c, d] = layout_->mesh.tets[t];
  return static_cast<Real>(signed_volume(X[static_cast<std::size_t>(a)], X[static_cast<std::size_t>(b)],
                                         X[static_cast<std::size_t>(c)], X[static_cast<std::size_t>(d)]));
}

/// Of the integration points, in the order of layout_->mesh, kg.
template <class Real>
std::vector<double> ElasticBody<Real>::point_masses() const {
  std::vector<double> mass(layout_->mesh.tets.size(), 0.0);
  for (const Part& part : parts_)
    for (std::size_t s = 0; s < part.group->size(); ++s)
      mass[static_cast<std::size_t>(part.group->element[s])] =
          materials_[part.material].density * static_cast<double>(meshed_volume(*part.group, s));
  return mass;
}

template <class Real>
std::vector<Real> ElasticBody<Real>::consistent_masses() const {
  return layout_->virtual_corners ? layout_->virtual_corners->consistent(point_masses()) : masses();
}

template <class Real>
std::vector<Real> ElasticBody<Real>::masses() const {
  if (layout_->virtual_corners) {
    const std::vector<double> of_points = point_masses();
    std::vector<double> of_elements(elements(), 0.0);
    for (std::size_t k = 0; k < of_points.size(); ++k) of_elements[k / element_points] += of_points[k];
    return layout_->virtual_corners->lumped(of_elements);
  }
  std::vector<double> mass(nodes(), 0.0);
  for (const Part& part : parts_)
    for (std::size_t s = 0; s < part.group->size(); ++s)
      for (const auto& list : part.group->node)
        mass[static_cast<std::size_t>(list[s])] +=
            static_cast<double>(part.group->density) * static_cast<double>(meshed_volume(*part.group, s)) / 4;
  return {mass.begin(), mass.end()};
}

template class ElasticBody<float>;
template class ElasticBody<double>;

}  // namespace heml
