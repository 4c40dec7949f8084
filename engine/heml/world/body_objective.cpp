#include <algorithm>
#include <atomic>
#include <cmath>
#include <heml/elastic/bsr_matrix.hpp>
#include <heml/materials/material.hpp>
#include <heml/world/body_objective.hpp>
#include <limits>

namespace heml {
namespace {

constexpr std::size_t values_remembered = 3;  // where a step began, where it would fly, where it has come
constexpr double max_penetration = 1e-4;      // of the body's size: how far inside a table or a probe tissue may be
constexpr double long_way = 0.02;             // of the spacing of nodes: a shorter step turns no good element
constexpr double nothing = 1e-12;             // N: smaller forces count as none
constexpr std::size_t element_grain = 2048;   // whose volumes outweigh the cost of waking a thread
// A body in float whose values were round-off: what made them so rarely ends within a few steps, and finding out costs
// iterations.
constexpr int steps_in_double = 64;

Vec3 at(const Vector& x, int node) { return x.segment<3>(3 * node); }

}  // namespace

template <class Real>
BodyObjective<Real>::BodyObjective(ElasticBody<Real>& body, const Shared<Model<Real>>& model,
                                   const Shared<NodeMasses<Real>>& masses, const FreeNodes& free,
                                   const std::vector<GraspSpring<Real>>& grasps, Contacts& contacts, ThreadTeam& team)
    : body_(body),
      model_(model),
      masses_(masses),
      free_(free),
      grasps_(grasps),
      team_(team),
      contact_(contacts, max_penetration * model->diagonal) {
  find_noise();
}

/// From the forces at rest, which are nothing but round-off, within bounds from the stiffness: some laws have a stress
/// at rest, and some meshes numbers without round-off. At rest without what the body has been through: stress that flow
/// or relaxation has left there is none of it.
template <class Real>
void BodyObjective<Real>::find_noise() {
  Vector rest(3 * static_cast<Eigen::Index>(model_->mesh.nodes.size())), r;
  for (std::size_t n = 0; n < model_->mesh.nodes.size(); ++n)
    rest.segment<3>(3 * static_cast<int>(n)) = model_->mesh.nodes[n];
  std::optional<BodySnapshot<Real>> state;
  if (body_.has_internal_state()) {
    state = body_.snapshot();
    body_.reset_history(as_real(rest, x_));
  }
  residual(rest, r);
  const Vector internal = forces_ - external_;
  double at_rest = 0, inertia = 0;
  for (std::size_t n = 0; n < masses_->lumped.size(); ++n) {
    const double m = static_cast<double>(masses_->lumped[n]);
    inertia += m;
    if (m > 0) at_rest = std::max(at_rest, at(internal, static_cast<int>(n)).norm() / m);
  }
  // An energy density is found as a difference of numbers of the size of a modulus: ω² m L² in all.
  constexpr double epsilon = std::numeric_limits<Real>::epsilon(), safety = 4;
  const double bound = static_cast<double>(body_.frequency_bound(x_.data(), team_));
  if (state) body_.restore(*state, x_.data());
  std::vector<double> stiffness(masses_->lumped.size(), 0.0);
  for (const int n : free_.node) {
    const auto k = static_cast<std::size_t>(n);
    stiffness[k] = bound * static_cast<double>(masses_->lumped[k]);
  }
  contact_.set_stiffness(std::move(stiffness));
  noise_ = epsilon * bound * inertia * model_->spacing * model_->spacing;
  const double worst = epsilon * bound * model_->diagonal;
  acceleration_round_off_ = std::clamp(safety * at_rest, worst / 10, worst);
}

template <class Real>
const Real* BodyObjective<Real>::as_real(const Vector& x, std::vector<Real>& scratch) const {
  scratch.resize(static_cast<std::size_t>(x.size()));
  for (std::size_t i = 0; i < scratch.size(); ++i) scratch[i] = static_cast<Real>(x[static_cast<Eigen::Index>(i)]);
  return scratch.data();
}

template <class Real>
void BodyObjective<Real>::set_time(double time, const Vec3& gravity) {
  time_ = time;
  gravity_ = gravity;
  move_tools(time);
}

template <class Real>
void BodyObjective<Real>::move_tools(double time) {
  if (!contact_.empty()) contact_.set_time(time);
  clear_cache();
}

/// Internal state is in Real alone.
template <class Real>
bool BodyObjective<Real>::refine_precision() {
  if (std::is_same_v<Real, double> || is_refined() || body_.has_internal_state()) return false;
  steps_in_double_ = steps_in_double;
  make_double_body();
  clear_cache();
  return true;
}

template <class Real>
void BodyObjective<Real>::make_double_body() {
  if (is_refined() && !double_body_)
    double_body_ = std::make_unique<ElasticBody<double>>(model_->mesh, model_->material_of, body_.materials(),
                                                         body_.options(), model_->midedges);
  if (double_body_) double_body_->set_activation(body_.activation());
}

template <class Real>
void BodyObjective<Real>::elements_changed() {
  steps_in_double_ = 0;
  double_body_.reset();
  elastic_.clear();
  clear_cache();
}

template <class Real>
void BodyObjective<Real>::set_flow_lags(bool lags) {
  flow_lags_ = lags;
  clear_cache();
}

template <class Real>
void BodyObjective<Real>::begin_step(const Vector& x, double time) {
  if (is_refined() && --steps_in_double_ == 0) clear_cache();
  if (!contact_.empty()) contact_.begin(x, time);
}

template <class Real>
void BodyObjective<Real>::end_step(const Vector& x) {
  if (contact_.empty()) return;
  contact_.accept(x);
  contact_.begin(x, time_);
}

template <class Real>
bool BodyObjective<Real>::update_lagged(const Vector& x) {
  if (contact_.empty() || !contact_.update_lagged(x)) return false;
  clear_cache();
  return true;
}

template <class Real>
void BodyObjective<Real>::set_velocity(double d, const Vector& x_bar) {
  d_ = d;
  x_bar_ = x_bar;
  clear_cache();
}

template <class Real>
void BodyObjective<Real>::begin_static(double duration, const Vec3& gravity, const Vector& start) {
  duration_ = duration;
  full_gravity_ = gravity;
  d_ = 0;
  inverted_at_start_ = count_inverted(start);
  begin_step(start, time_);
}

template <class Real>
void BodyObjective<Real>::set_load(double fraction) {
  body_.set_activation(fraction);
  if (double_body_) double_body_->set_activation(fraction);
  set_time(fraction * duration_, fraction * full_gravity_);
}

template <class Real>
void BodyObjective<Real>::apply_constraints(double fraction, Vector& x) const {
  for (const ConstrainedNode& constrained : model_->constrained)
    set_along(constrained.axes, constrained.node, prescribed_at(*model_, constrained, fraction * duration_).x, x);
}

template <class Real>
double BodyObjective<Real>::relative_residual(const Vector& r) const {
  double reactions = 0;
  for (std::size_t n = 0; n < free_.number.size(); ++n)
    if (free_.number[n] < 0) reactions += forces_.segment<3>(3 * static_cast<int>(n)).squaredNorm();
  for (const int i : free_.held) reactions += forces_[i] * forces_[i];
  const double carried = std::max(std::sqrt(reactions), external_.norm());
  const double left = r.norm();
  if (carried <= nothing) return left <= nothing ? 0 : left / nothing;
  return left / carried;
}

template <class Real>
double BodyObjective<Real>::max_acceleration(const Vector& r) const {
  double largest = 0;
  for (const int n : free_.node) {
    const double mass = static_cast<double>(masses_->lumped[static_cast<std::size_t>(n)]);
    largest = std::max(largest, at(r, n).template lpNorm<Eigen::Infinity>() / mass);
  }
  return largest;
}

template <class Real>
bool BodyObjective<Real>::is_at_round_off(const Vector& r) const {
  constexpr double deformed = 10;  // times the round-off at rest
  return max_acceleration(r) <= deformed * acceleration_round_off_;
}

template <class Real>
double BodyObjective<Real>::relative_net_load() const {
  Vec3 sum = Vec3::Zero();
  double sizes = 0;
  for (const int n : free_.node) {
    sum += at(external_, n);
    sizes += at(external_, n).norm();
  }
  return sizes > nothing ? sum.norm() / sizes : 0;
}

template <class Real>
int BodyObjective<Real>::count_inverted(const Vector& x) const {
  if (!model_->midedges.empty())
    return count_inverted_points(model_->mesh.tets, model_->midedges, [&](int n) { return at(x, n); });
  const std::vector<Tet>& tets = model_->mesh.tets;
  std::atomic<int> inverted{0};
  team_.parallel_for(tets.size(), element_grain, [&](std::size_t begin, std::size_t end) {
    inverted += static_cast<int>(std::count_if(&tets[begin], &tets[begin] + (end - begin), [&](const Tet& tet) {
      return !(signed_volume(at(x, tet[0]), at(x, tet[1]), at(x, tet[2]), at(x, tet[3])) > 0);
    }));
  });
  return inverted;
}

template <class Real>
bool BodyObjective<Real>::inverts_elements(const Vector& from, const Vector& to) const {
  if ((to - from).template lpNorm<Eigen::Infinity>() <= long_way * model_->spacing) return false;
  const int inverted = count_inverted(to);
  return inverted > 0 && inverted > count_inverted(from);
}

template <class Real>
bool BodyObjective<Real>::is_admissible(const Vector& x) const {
  return count_inverted(x) <= inverted_at_start_;
}

template <class Real>
void BodyObjective<Real>::accept(const Vector& x) {
  if (body_.has_internal_state()) body_.commit(as_real(x, x_));
  end_step(x);
}

template <class Real>
void BodyObjective<Real>::add_external(const Real* x, const Vector& x_double) {
  f_.assign(f_.size(), Real(0));
  for (const auto& load : model_->dead) add_load(load, time_, f_.data());
  for (const auto& load : model_->pressures) add_load(load, time_, x, f_.data());
  if (!grasps_.empty()) {
    v_.assign(f_.size(), Real(0));
    if (d_ > 0)
      for (std::size_t i = 0; i < v_.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        v_[i] = static_cast<Real>((x_double[k] - x_bar_[k]) / d_);
      }
    for (const auto& grasp : grasps_) grasp.add_forces(x, v_.data(), f_.data());
  }
  const std::vector<Real>& heavy = masses_->heavy();
  external_.resize(x_double.size());
  for (std::size_t n = 0; n < masses_->lumped.size(); ++n)
    for (std::size_t i = 0; i < 3; ++i)
      external_[static_cast<Eigen::Index>(3 * n + i)] =
          static_cast<double>(f_[3 * n + i]) + static_cast<double>(heavy[n]) * gravity_[static_cast<int>(i)];
  if (!contact_.empty()) contact_.add_forces(x_double, external_);
}

template <class Real>
void BodyObjective<Real>::clear_cache() {
  forces_at_.resize(0);
  values_.clear();
}

template <class Real>
bool BodyObjective<Real>::residual(const Vector& x, Vector& r) {
  if (forces_at_.size() == 0 || forces_at_ != x) find_forces(x);
  r.setZero(x.size());
  for (const int n : free_.node) r.segment<3>(3 * n) = forces_.segment<3>(3 * n);
  free_.clear_held(r);
  return is_defined_;
}

template <class Real>
void BodyObjective<Real>::find_forces(const Vector& x) {
  const Real* at_x = as_real(x, x_);
  f_.resize(x_.size());
  forces_.resize(x.size());
  if (is_refined()) {
    is_defined_ = double_body_->forces(x.data(), forces_.data(), team_);
  } else {
    const FlowTrial trial(body_, at_x, team_, flow_lags_);
    is_defined_ = body_.forces(at_x, f_.data(), team_);
    for (std::size_t i = 0; i < f_.size(); ++i) forces_[static_cast<Eigen::Index>(i)] = static_cast<double>(f_[i]);
  }
  is_defined_ = is_defined_ && !contact_.crosses_probe(x);
  add_external(at_x, x);
  forces_ += external_;
  is_defined_ = is_defined_ && forces_.allFinite();  // on held nodes too: what supports bear
  forces_at_ = x;
}

template <class Real>
std::optional<double> BodyObjective<Real>::value(const Vector& x) {
  if (!model_->pressures.empty()) return std::nullopt;
  for (const auto& [at, value] : values_)
    if (at == x) return value;
  if (values_.size() == values_remembered) values_.pop_front();
  return values_.emplace_back(x, find_value(x)).second;
}

/// At x, whose values in Real are x_.
template <class Real>
double BodyObjective<Real>::elastic_potential(const Vector& x) {
  if (is_refined()) return double_body_->potential(x.data(), team_);
  if (body_.has_internal_state()) {
    const FlowTrial trial(body_, x_.data(), team_, flow_lags_);
    return body_.potential(x_.data(), team_);
  }
  for (const ElasticEnergy& known : elastic_)
    if (known.activation == body_.activation() && known.x == x_) return known.value;
  if (elastic_.size() == values_remembered) elastic_.pop_front();
  return elastic_.emplace_back(ElasticEnergy{x_, body_.activation(), body_.potential(x_.data(), team_)}).value;
}

template <class Real>
double BodyObjective<Real>::find_value(const Vector& x) {
  const Real* at_x = as_real(x, x_);
  double sum = elastic_potential(x);
  for (std::size_t n = 0; n < masses_->lumped.size(); ++n)
    sum -= static_cast<double>(masses_->heavy()[n]) * gravity_.dot(at(x, static_cast<int>(n)) - model_->mesh.nodes[n]);
  for (const auto& load : model_->dead)
    for (std::size_t k = 0; k < load.nodes.size(); ++k) {
      const Vec3 moved = at(x, load.nodes[k]) - model_->mesh.nodes[static_cast<std::size_t>(load.nodes[k])];
      for (int i = 0; i < 3; ++i)
        sum -= load.ramp(time_) * static_cast<double>(load.forces[3 * k + static_cast<std::size_t>(i)]) * moved[i];
    }
  if (!contact_.empty()) sum += contact_.value(x);
  for (const auto& grasp : grasps_) {
    sum += grasp.energy(at_x);
    if (d_ > 0)
      grasp.each_stiffness([&](int n, Real, Real damping) {
        sum += static_cast<double>(damping) / (2 * d_) * (at(x, n) - at(x_bar_, n)).squaredNorm();
      });
  }
  return sum;
}

template class BodyObjective<float>;
template class BodyObjective<double>;

}  // namespace heml
