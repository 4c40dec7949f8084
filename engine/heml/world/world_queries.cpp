#include <algorithm>
#include <heml/base/hash.hpp>
#include <heml/world/typed_world.hpp>
#include <numeric>

namespace heml {

template <class Real>
std::vector<Vec3> TypedWorld<Real>::in_file_order(const std::vector<Real>& values) const {
  std::vector<Vec3> result(mass_.size());
  for (std::size_t file = 0; file < result.size(); ++file) {
    const Real* value = &values[3 * static_cast<std::size_t>(model_.order.new_node[file])];
    result[file] = Vec3(value[0], value[1], value[2]);
  }
  return result;
}

template <class Real>
void TypedWorld<Real>::write_positions(std::span<const int> nodes, double ahead, std::vector<Vec3f>& out) const {
  out.resize(nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const std::size_t n = 3 * static_cast<std::size_t>(model_.order.new_node[static_cast<std::size_t>(nodes[k])]);
    for (std::size_t i = 0; i < 3; ++i)
      out[k][static_cast<int>(i)] = static_cast<float>(state_.x[n + i] + static_cast<Real>(ahead) * state_.v[n + i]);
  }
}

template <class Real>
void TypedWorld<Real>::write_field(Field field, std::span<const int> nodes, std::vector<float>& out) {
  if (field == Field::none) return out.clear();
  out.resize(nodes.size());
  const auto inner = [&](int file) {
    return static_cast<std::size_t>(model_.order.new_node[static_cast<std::size_t>(file)]);
  };
  if (field == Field::displacement) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const std::size_t n = inner(nodes[k]);
      const Vec3 x = Eigen::Map<const Vector3<Real>>(&state_.x[3 * n]).template cast<double>();
      out[k] = static_cast<float>((x - model_.mesh.nodes[n]).norm());
    }
    return;
  }
  const std::vector<double> values = element_values(field);
  std::vector<double> sum(mass_.size(), 0.0), weight(mass_.size(), 0.0);
  for (std::size_t t = 0; t < model_.mesh.tets.size(); ++t) {
    const Tet& tet = model_.mesh.tets[t];
    const auto X = [&](std::size_t c) -> const Vec3& { return model_.mesh.nodes[static_cast<std::size_t>(tet[c])]; };
    const double volume = signed_volume(X(0), X(1), X(2), X(3));
    for (const int n : tet) {
      sum[static_cast<std::size_t>(n)] += volume * values[t];
      weight[static_cast<std::size_t>(n)] += volume;
    }
  }
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const std::size_t n = inner(nodes[k]);
    out[k] = weight[n] > 0 ? static_cast<float>(sum[n] / weight[n]) : 0.0f;
  }
}

/// #T in inner order.
template <class Real>
std::vector<double> TypedWorld<Real>::element_values(Field field) {
  std::vector<double> values(model_.mesh.tets.size(), 0.0);
  if (field == Field::error) {
    if (const auto found = estimate()) values = found->densities(model_.mesh);
    return values;
  }
  acting_body().states(state_.x.data(), element_states_);
  for (std::size_t t = 0; t < values.size(); ++t) {
    const auto& s = element_states_[t];
    values[t] = static_cast<double>(field == Field::stretch     ? s.stretch
                                    : field == Field::von_mises ? s.von_mises
                                                                : s.J);
  }
  return values;
}

/// #V in inner order, m.
template <class Real>
std::vector<Vec3> TypedWorld<Real>::inner_positions() const {
  std::vector<Vec3> x(mass_.size());
  for (std::size_t n = 0; n < x.size(); ++n)
    x[n] = Eigen::Map<const Vector3<Real>>(&state_.x[3 * n]).template cast<double>();
  return x;
}

/// Elements in inner order.
template <class Real>
std::optional<ErrorEstimate> TypedWorld<Real>::estimate() {
  const FlushDenormals flush;
  ElasticBody<Real>& body = acting_body();
  if (body.has_springs()) return std::nullopt;
  ErrorEstimate found;
  found.of_element =
      recovery_errors(model_.mesh, model_.material_of, deformation_gradients(model_.mesh, inner_positions()),
                      body.stresses(state_.x.data(), team_));
  found.squared = std::accumulate(found.of_element.begin(), found.of_element.end(), 0.0);
  found.stored = body.energy(state_.x.data(), team_);
  return found;
}

template <class Real>
std::optional<ErrorEstimate> TypedWorld<Real>::error_estimate() {
  auto found = estimate();
  if (!found) return found;
  const std::vector<double> inner = std::move(found->of_element);
  found->of_element.clear();
  for (const int file : topology_->elements)
    found->of_element.push_back(inner[static_cast<std::size_t>(model_.order.new_tet[static_cast<std::size_t>(file)])]);
  return found;
}

template <class Real>
bool TypedWorld<Real>::copy_motion_from(const World& leader) {
  const auto* other = dynamic_cast<const TypedWorld*>(&leader);
  if (!other || other->halt_ || other->remembers_ || remembers_ || other->recovering() || recovering()) return false;
  if (other->model_.order.file_node != model_.order.file_node || other->model_.order.file_tet != model_.order.file_tet)
    return false;
  ++changes_;
  state_ = other->state_;
  last_valid_ = state_;
  grasps_ = other->grasps_;
  stable_step_ = other->stable_step_;
  halt_.reset();
  if (implicit_) implicit_->h_before = 0;  // BDF2 starts anew
  return true;
}

template <class Real>
Energies TypedWorld<Real>::energies() {
  Energies e;
  const Vec3 gravity = gravity_now();
  for (std::size_t n = 0; n < mass_.size(); ++n) {
    const double m = static_cast<double>(mass_[n]);
    const Vec3 v = Eigen::Map<const Vector3<Real>>(&state_.v[3 * n]).template cast<double>();
    const Vec3 x = Eigen::Map<const Vector3<Real>>(&state_.x[3 * n]).template cast<double>();
    e.kinetic += m / 2 * v.squaredNorm();
    e.potential -= m * gravity.dot(x - model_.mesh.nodes[n]);
  }
  e.elastic = acting_body().energy(state_.x.data(), team_);
  return e;
}

template <class Real>
std::vector<double> TypedWorld<Real>::volume_ratios() {
  acting_body().states(state_.x.data(), element_states_);
  std::vector<double> result;
  for (const int file : topology_->elements) {
    const auto t = static_cast<std::size_t>(model_.order.new_tet[static_cast<std::size_t>(file)]);
    result.push_back(static_cast<double>(element_states_[t].J));
  }
  return result;
}

/// σ = P Fᵀ / J
template <class Real>
std::vector<Mat3> TypedWorld<Real>::stresses() {
  const FlushDenormals flush;
  ElasticBody<Real>& body = acting_body();
  if (body.has_springs()) return {};
  const std::vector<Mat3> F = deformation_gradients(model_.mesh, inner_positions()),
                          P = body.stresses(state_.x.data(), team_);
  std::vector<Mat3> result;
  for (const int file : topology_->elements) {
    const auto t = static_cast<std::size_t>(model_.order.new_tet[static_cast<std::size_t>(file)]);
    result.push_back(P[t] * F[t].transpose() / F[t].determinant());
  }
  return result;
}

/// A support gives what the node's motion asks for and nothing else does: m (a + α v) − f, at rest −f.
template <class Real>
std::vector<Vec3> TypedWorld<Real>::reactions() {
  std::vector<Vec3> result(setup_.boundary.size(), Vec3::Zero());
  const double inertia = setup_.solver.is_static() ? 0 : 1;
  for (const ConstrainedNode& constrained : model_.constrained) {
    const auto n = static_cast<std::size_t>(constrained.node);
    const PrescribedMotion::At at = prescribed_at(model_, constrained, state_.time);
    const Vec3 f = Eigen::Map<const Vector3<Real>>(&state_.f[3 * n]).template cast<double>();
    result[static_cast<std::size_t>(constrained.entry)] +=
        inertia * static_cast<double>(mass_[n]) * (at.a + setup_.solver.damping * at.v) - f;
  }
  return result;
}

template <class Real>
ToolState TypedWorld<Real>::tool() const {
  ToolState tool;
  if (grasps_.empty()) return tool;
  const auto& grasp = grasps_.front();
  tool.active = true;
  tool.node = model_.order.file_node[static_cast<std::size_t>(grasp.center())];
  tool.target = grasp.target();
  tool.grip = grasp.grip(state_.x.data());
  tool.force = grasp.force(state_.x.data(), state_.v.data());
  return tool;
}

template <class Real>
std::vector<PinState> TypedWorld<Real>::pins() const {
  const auto file = [this](int n) { return model_.order.file_node[static_cast<std::size_t>(n)]; };
  std::vector<PinState> pins;
  for (const PinnedPatch& pin : pins_) {
    PinState& state = pins.emplace_back();
    state.node = file(pin.center);
    for (const int n : pin.nodes) state.nodes.push_back(file(n));
    state.place =
        Eigen::Map<const Vector3<Real>>(&state_.x[3 * static_cast<std::size_t>(pin.center)]).template cast<double>();
    state.force = pin_force(pin, state_.f.data());
  }
  return pins;
}

template <class Real>
std::vector<TableState> TypedWorld<Real>::tables() const {
  std::vector<TableState> tables;
  for (std::size_t s = 0; s < contacts_.tables.size(); ++s) {
    const ContactReport report = contacts_.report_of(s);
    tables.push_back(
        {contacts_.tables[s], report.force, report.work, report.energy, report.max_penetration, report.contact_count});
  }
  return tables;
}

template <class Real>
ProbeState TypedWorld<Real>::probe() const {
  if (!contacts_.probe) return {};
  const ContactSurface at = surface_of(*contacts_.probe, state_.time);
  const ContactReport report = contacts_.report_of(contacts_.tables.size());
  return {true,
          at.point,
          at.other,
          at.radius,
          report.force,
          report.work,
          report.energy,
          report.max_penetration,
          report.contact_count};
}

template <class Real>
std::vector<SutureState> TypedWorld<Real>::sutures() const {
  std::vector<SutureState> sutures;
  for (std::size_t k = 0; k < contacts_.sutures.size(); ++k) {
    SutureState& state = sutures.emplace_back();
    for (std::size_t end = 0; end < 2; ++end) {
      const auto n = static_cast<std::size_t>(contacts_.sutures[k].nodes[end]);
      state.nodes[end] = model_.order.file_node[n];
      state.ends[end] = Eigen::Map<const Vector3<Real>>(&state_.x[3 * n]).template cast<double>();
    }
    state.force = contacts_.report_of(contacts_.tables.size() + (contacts_.probe ? 1 : 0) + k).force;
  }
  return sutures;
}

template <class Real>
std::optional<SelfContactState> TypedWorld<Real>::self_contact() const {
  if (!contacts_.tissue) return std::nullopt;
  const ContactReport report =
      contacts_.report_of(contacts_.tables.size() + (contacts_.probe ? 1 : 0) + contacts_.sutures.size());
  return SelfContactState{report.normal_force, report.work, report.energy, report.max_penetration,
                          report.contact_count};
}

template <class Real>
SolverStats TypedWorld<Real>::solver_stats() const {
  SolverStats work = work_;
  work.integrator = integrator_name(method_);
  if (setup_.solver.budget) work.budget = stage_iterations();
  if (!implicit_) return work;
  work.preconditioner = preconditioner_names[static_cast<std::size_t>(implicit_->linear.preconditioner())];
  work.linear = implicit_->linear.counts();
  return work;
}

template <class Real>
std::uint64_t TypedWorld<Real>::node_hash(std::size_t file_node) const {
  const std::size_t n = 3 * static_cast<std::size_t>(model_.order.new_node[file_node]);
  std::uint64_t hash = 0;
  for (std::size_t i = 0; i < 3; ++i) hash = hash_combine(hash_combine(hash, state_.x[n + i]), state_.v[n + i]);
  return hash;
}

template <class Real>
std::uint64_t TypedWorld<Real>::state_hash() const {
  std::uint64_t hash = 0;
  for (std::size_t n = 0; n < mass_.size(); ++n) hash = hash_combine(hash, node_hash(n));
  return hash;
}

template <class Real>
std::vector<std::uint16_t> TypedWorld<Real>::node_hashes() const {
  std::vector<std::uint16_t> hashes(mass_.size());
  for (std::size_t n = 0; n < hashes.size(); ++n) hashes[n] = static_cast<std::uint16_t>(node_hash(n));
  return hashes;
}

template class TypedWorld<float>;
template class TypedWorld<double>;

}  // namespace heml
