#include <algorithm>
#include <heml/base/hash.hpp>
#include <heml/elastic/quadratic_error.hpp>
#include <heml/world/field_list.hpp>
#include <heml/world/world_queries.hpp>
#include <numeric>

namespace heml {
namespace {
ContactState contact_state(const ContactReport& report) {
  return {report.force, report.work, report.energy, report.max_penetration, report.contact_count};
}
}  // namespace

template <class Real>
void WorldQueries<Real>::write_vectors(NodeVector which, std::span<double> out) const {
  const State<Real>& state = s_.state;
  const std::vector<Real>& values = which == NodeVector::position   ? state.x
                                    : which == NodeVector::velocity ? state.v
                                                                    : state.f;
  const std::vector<int>& inner = s_.model->order.new_node;
  for (std::size_t file = 0; file < inner.size(); ++file)
    for (std::size_t i = 0; i < 3; ++i)
      out[3 * file + i] = static_cast<double>(values[3 * static_cast<std::size_t>(inner[file]) + i]);
}

template <class Real>
void WorldQueries<Real>::write_positions(std::span<const int> nodes, double ahead, std::vector<Vec3f>& out) const {
  out.resize(nodes.size());
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const std::size_t n = 3 * static_cast<std::size_t>(s_.model->order.new_node[static_cast<std::size_t>(nodes[k])]);
    for (std::size_t i = 0; i < 3; ++i)
      out[k][static_cast<int>(i)] =
          static_cast<float>(s_.state.x[n + i] + static_cast<Real>(ahead) * s_.state.v[n + i]);
  }
}

template <class Real>
void WorldQueries<Real>::write_field(Field field, std::span<const int> nodes, std::vector<float>& out) {
  if (field == Field::none) return out.clear();
  out.resize(nodes.size());
  const auto inner = [&](int file) {
    return static_cast<std::size_t>(s_.model->order.new_node[static_cast<std::size_t>(file)]);
  };
  if (const auto of_node = info(field).of_node) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const std::size_t n = inner(nodes[k]);
      const Vec3 x = Eigen::Map<const Vector3<Real>>(&s_.state.x[3 * n]).template cast<double>();
      out[k] = static_cast<float>(of_node(s_.model->mesh.nodes[n], x));
    }
    return;
  }
  const std::vector<double> values = element_values(field);
  std::vector<double> sum(s_.masses->lumped.size(), 0.0), weight(s_.masses->lumped.size(), 0.0);
  for (std::size_t t = 0; t < s_.model->mesh.tets.size(); ++t) {
    const Tet& tet = s_.model->mesh.tets[t];
    const auto X = [&](std::size_t c) -> const Vec3& { return s_.model->mesh.nodes[static_cast<std::size_t>(tet[c])]; };
    const double volume = signed_volume(X(0), X(1), X(2), X(3));
    const auto add = [&](int n) {
      sum[static_cast<std::size_t>(n)] += volume * values[t];
      weight[static_cast<std::size_t>(n)] += volume;
    };
    for (const int n : tet) add(n);
    if (!s_.model->midedges.empty())
      for (const int n : s_.model->midedges[t]) add(n);
  }
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const std::size_t n = inner(nodes[k]);
    out[k] = weight[n] > 0 ? static_cast<float>(sum[n] / weight[n]) : 0.0f;
  }
}

/// #T in inner order.
template <class Real>
std::vector<double> WorldQueries<Real>::element_values(Field field) {
  std::vector<double> values(s_.model->mesh.tets.size(), 0.0);
  if (field == Field::error) {
    if (const auto found = estimate()) values = found->densities(s_.model->mesh);
    return values;
  }
  const std::size_t points = s_.body.points_per_element();
  if (const auto of_state = info(field).of_state) {
    s_.acting_body().states(s_.state.x.data(), element_states_);
    for (std::size_t k = 0; k < element_states_.size(); ++k) {
      const ElementState<Real>& s = element_states_[k];
      values[k / points] +=
          of_state({static_cast<double>(s.J), static_cast<double>(s.stretch), static_cast<double>(s.von_mises)});
    }
  } else if (const auto of_tensors = info(field).of_tensors) {
    const FlushDenormals flush;
    ElasticBody<Real>& body = s_.acting_body();
    const std::vector<Mat3> P = body.stresses(s_.state.x.data(), s_.team),
                            F = body.deformation_gradients(s_.state.x.data());
    for (std::size_t k = 0; k < F.size(); ++k)
      values[k / points] += of_tensors({F[k], P[k] * F[k].transpose() / F[k].determinant()});
  }
  if (points > 1)
    for (double& value : values) value /= static_cast<double>(points);
  return values;
}

/// #V in inner order, m.
template <class Real>
std::vector<Vec3> WorldQueries<Real>::inner_positions() const {
  std::vector<Vec3> x(s_.masses->lumped.size());
  for (std::size_t n = 0; n < x.size(); ++n)
    x[n] = Eigen::Map<const Vector3<Real>>(&s_.state.x[3 * n]).template cast<double>();
  return x;
}

/// Elements in inner order.
template <class Real>
std::optional<ErrorEstimate> WorldQueries<Real>::estimate() {
  const FlushDenormals flush;
  ElasticBody<Real>& body = s_.acting_body();
  if (body.has_springs()) return std::nullopt;
  ErrorEstimate found;
  const std::vector<Mat3> P = body.stresses(s_.state.x.data(), s_.team);
  found.of_element = s_.model->midedges.empty()
                         ? recovery_errors(s_.model->mesh, s_.model->material_of,
                                           deformation_gradients(s_.model->mesh, inner_positions()), P)
                         : quadratic_recovery_errors(s_.model->mesh, s_.model->material_of,
                                                     body.deformation_gradients(s_.state.x.data()), P);
  found.squared = std::accumulate(found.of_element.begin(), found.of_element.end(), 0.0);
  found.stored = body.energy(s_.state.x.data(), s_.team) - body.active_energy(s_.state.x.data(), s_.team);
  return found;
}

template <class Real>
std::optional<ErrorEstimate> WorldQueries<Real>::error_estimate() {
  auto found = estimate();
  if (!found) return found;
  const std::vector<double> inner = std::move(found->of_element);
  found->of_element.clear();
  for (const int file : s_.topology->elements)
    found->of_element.push_back(
        inner[static_cast<std::size_t>(s_.model->order.new_tet[static_cast<std::size_t>(file)])]);
  return found;
}

template <class Real>
std::vector<double> WorldQueries<Real>::volume_ratios() {
  const std::vector<double> of_points = point_volume_ratios();
  const std::size_t points = s_.body.points_per_element();
  if (points == 1) return of_points;
  std::vector<double> result(of_points.size() / points, 0.0);
  for (std::size_t k = 0; k < of_points.size(); ++k) result[k / points] += of_points[k] / static_cast<double>(points);
  return result;
}

template <class Real>
std::vector<double> WorldQueries<Real>::point_volume_ratios() {
  std::vector<Real> ratios;
  s_.acting_body().volume_ratios(s_.state.x.data(), ratios);
  const std::size_t points = s_.body.points_per_element();
  std::vector<double> result;
  for (const int file : s_.topology->elements) {
    const auto t = static_cast<std::size_t>(s_.model->order.new_tet[static_cast<std::size_t>(file)]);
    for (std::size_t q = 0; q < points; ++q) result.push_back(static_cast<double>(ratios[points * t + q]));
  }
  return result;
}

/// σ = P Fᵀ / J
template <class Real>
std::vector<Mat3> WorldQueries<Real>::stresses() {
  const FlushDenormals flush;
  ElasticBody<Real>& body = s_.acting_body();
  if (body.has_springs()) return {};
  const std::vector<Mat3> F = body.deformation_gradients(s_.state.x.data()),
                          P = body.stresses(s_.state.x.data(), s_.team);
  const std::size_t points = body.points_per_element();
  std::vector<Mat3> result;
  for (const int file : s_.topology->elements) {
    const auto t = points * static_cast<std::size_t>(s_.model->order.new_tet[static_cast<std::size_t>(file)]);
    result.push_back(P[t] * F[t].transpose() / F[t].determinant());
    for (std::size_t q = 1; q < points; ++q) result.back() += P[t + q] * F[t + q].transpose() / F[t + q].determinant();
    if (points > 1) result.back() /= static_cast<double>(points);
  }
  return result;
}

/// A support gives what the node's motion asks for and nothing else does: m (a + α v) − f, at rest −f.
template <class Real>
std::vector<Vec3> WorldQueries<Real>::reactions() const {
  std::vector<Vec3> result(s_.setup->boundary.size(), Vec3::Zero());
  const double inertia = s_.setup->solver.is_static() ? 0 : 1;
  for (const ConstrainedNode& constrained : s_.model->constrained) {
    const auto n = static_cast<std::size_t>(constrained.node);
    const PrescribedMotion::At at = prescribed_at(*s_.model, constrained, s_.state.time);
    const Vec3 f = Eigen::Map<const Vector3<Real>>(&s_.state.f[3 * n]).template cast<double>();
    const Vec3 reaction =
        inertia * static_cast<double>(s_.masses->lumped[n]) * (at.a + s_.setup->solver.damping * at.v) - f;
    for (int i = 0; i < 3; ++i)
      if (constrained.axes.has[static_cast<std::size_t>(i)])
        result[static_cast<std::size_t>(constrained.entry)][i] += reaction[i];
  }
  return result;
}

template <class Real>
std::vector<ToolState> WorldQueries<Real>::tools() const {
  const Contacts& contacts = s_.contacts;
  std::vector<ToolState> tools;
  for (const auto& grasp : s_.grasps) tools.push_back(state_of(grasp));
  for (const PinnedPatch& pin : s_.pins) tools.push_back(state_of(pin));
  std::size_t surface = 0;  // reports are in the order of Contacts::surfaces()
  for (const PlacedTable& placed : contacts.tables)
    tools.push_back(TableState{contact_state(contacts.report_of(surface++)), placed.table});
  if (contacts.probe) {
    const ContactSurface at = surface_of(*contacts.probe, s_.state.time);
    tools.push_back(ProbeState{contact_state(contacts.report_of(surface++)), at.point, at.other, at.radius});
  }
  for (const Suture& suture : contacts.sutures) tools.push_back(state_of(suture, contacts.report_of(surface++)));
  if (contacts.tissue) {
    const ContactReport report = contacts.report_of(surface);
    tools.push_back(SelfContactState{report.normal_force, report.work, report.energy, report.max_penetration,
                                     report.contact_count});
  }
  return tools;
}

template <class Real>
GraspState WorldQueries<Real>::state_of(const GraspSpring<Real>& grasp) const {
  return {grasp.id().hand,
          grasp.id().serial,
          s_.model->order.file_node[static_cast<std::size_t>(grasp.center())],
          static_cast<double>(grasp.radius()),
          grasp.target(),
          grasp.grip(s_.state.x.data()),
          grasp.force(s_.state.x.data(), s_.state.v.data())};
}

template <class Real>
PinState WorldQueries<Real>::state_of(const PinnedPatch& pin) const {
  const auto file = [this](int n) { return s_.model->order.file_node[static_cast<std::size_t>(n)]; };
  PinState state{file(pin.center), {}, position(pin.center), pin_force(pin, s_.state.f.data())};
  for (const int n : pin.nodes) state.nodes.push_back(file(n));
  return state;
}

template <class Real>
SutureState WorldQueries<Real>::state_of(const Suture& suture, const ContactReport& report) const {
  SutureState state;
  for (std::size_t end = 0; end < 2; ++end) {
    state.nodes[end] = s_.model->order.file_node[static_cast<std::size_t>(suture.nodes[end])];
    state.ends[end] = position(suture.nodes[end]);
  }
  state.force = report.force;
  return state;
}

/// m, of an internal node.
template <class Real>
Vec3 WorldQueries<Real>::position(int node) const {
  return Eigen::Map<const Vector3<Real>>(&s_.state.x[3 * static_cast<std::size_t>(node)]).template cast<double>();
}

template <class Real>
std::uint64_t WorldQueries<Real>::node_hash(std::size_t file_node) const {
  const std::size_t n = 3 * static_cast<std::size_t>(s_.model->order.new_node[file_node]);
  std::uint64_t hash = 0;
  for (std::size_t i = 0; i < 3; ++i) hash = hash_combine(hash_combine(hash, s_.state.x[n + i]), s_.state.v[n + i]);
  return hash;
}

template <class Real>
std::uint64_t WorldQueries<Real>::state_hash() const {
  std::uint64_t hash = 0;
  for (std::size_t n = 0; n < s_.masses->lumped.size(); ++n) hash = hash_combine(hash, node_hash(n));
  return hash;
}

template <class Real>
std::vector<std::uint16_t> WorldQueries<Real>::node_hashes() const {
  std::vector<std::uint16_t> hashes(s_.masses->lumped.size());
  for (std::size_t n = 0; n < hashes.size(); ++n) hashes[n] = static_cast<std::uint16_t>(node_hash(n));
  return hashes;
}

template class WorldQueries<float>;
template class WorldQueries<double>;

}  // namespace heml
