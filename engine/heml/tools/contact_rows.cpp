#include <algorithm>
#include <cmath>
#include <heml/tools/contact_rows.hpp>

namespace heml {

template <class Real>
void ContactRows<Real>::clear(std::size_t node_count) {
  rows_.clear();
  if (local_.size() != node_count) local_.assign(node_count, -1);
  for (const int n : nodes_)
    if (index(n) < local_.size()) local_[index(n)] = -1;
  nodes_.clear();
  is_warm_ = true;
  rounds_ = 0;
  residual_ = 0;
}

template <class Real>
auto ContactRows<Real>::row_of(const ContactPoint& point, double effective_inverse_mass,
                               const std::vector<Real>& inverse_mass) -> Row {
  Row row;
  row.normal = padded(point.normal);
  row.drift.setZero();
  row.friction_impulse.setZero();
  row.weights = point.weights;
  for (std::size_t k = 0; k < 4; ++k) {
    const int n = point.nodes[k];
    row.mobility[k] = point.weights[k] * static_cast<double>(inverse_mass[index(n)]);
    int& local = local_[index(n)];
    if (local < 0) {
      local = static_cast<int>(nodes_.size());
      nodes_.push_back(n);
    }
    row.nodes[k] = local;
  }
  row.min_gap_rate = row.normal_impulse = row.work = row.friction = 0;
  row.inverse_mass = effective_inverse_mass;
  row.mass = 1 / effective_inverse_mass;
  row.is_known = false;
  return row;
}

template <class Real>
auto ContactRows<Real>::add(const ContactPoint& point, double effective_inverse_mass,
                            const std::vector<Real>& inverse_mass) -> Row& {
  return rows_.emplace_back(row_of(point, effective_inverse_mass, inverse_mass));
}

template <class Real>
auto ContactRows<Real>::replace(std::size_t i, const ContactPoint& point, double effective_inverse_mass,
                                const std::vector<Real>& inverse_mass) -> Row& {
  return rows_[i] = row_of(point, effective_inverse_mass, inverse_mass);
}

template <class Real>
void ContactRows<Real>::load(const Real* v) {
  velocities_.resize(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) velocities_[i] = padded(at(v, nodes_[i]));
}

template <class Real>
void ContactRows<Real>::store(Real* v) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    Eigen::Map<Vector3<Real>>(v + 3 * nodes_[i]) = velocities_[i].template head<3>().template cast<Real>();
}

template <class Real>
auto ContactRows<Real>::velocity_of(const Row& row) const -> Vec4 {
  const auto v = [&](std::size_t k) -> const Vec4& { return velocities_[index(row.nodes[k])]; };
  const auto& w = row.weights;
  return (w[0] * v(0) + w[1] * v(1)) + (w[2] * v(2) + w[3] * v(3));
}

template <class Real>
void ContactRows<Real>::add_impulse(const Row& row, const Vec4& impulse) {
  for (std::size_t k = 0; k < 4; ++k) velocities_[index(row.nodes[k])] += row.mobility[k] * impulse;
}

template <class Real>
void ContactRows<Real>::start(Real* v) {
  is_warm_ = true;
  if (rows_.empty()) return;
  load(v);
  // The rounds minimise the kinetic energy plus the impulses' work against the required velocities.
  double energy = 0;
  for (Row& row : rows_) {
    if (!(row.normal_impulse > 0)) continue;
    const Vec4 u = velocity_of(row);
    if (row.friction > 0)
      row.friction_impulse -= row.normal.dot(row.friction_impulse) * row.normal;
    else
      row.friction_impulse.setZero();
    const Vec4 impulse = row.normal_impulse * row.normal + row.friction_impulse;
    energy += impulse.dot(u + impulse * (row.inverse_mass / 2)) - row.normal_impulse * row.min_gap_rate +
              row.friction_impulse.dot(row.drift);
    row.work = row.friction_impulse.dot(u + row.friction_impulse * (row.inverse_mass / 2));
    add_impulse(row, impulse);
  }
  is_warm_ = energy <= 0;
  if (is_warm_) return store(v);
  for (Row& row : rows_) {
    row.normal_impulse = row.work = 0;
    row.friction_impulse.setZero();
  }
}

template <class Real>
void ContactRows<Real>::solve(const RoundLimit& warm, const RoundLimit& cold, Real* v) {
  if (rows_.empty()) return;
  load(v);
  for (int round = 1;; ++round) {
    double largest = 0, change = 0;
    bool is_cold = !is_warm_;
    for (Row& row : rows_) {
      change = std::max(change, visit(row));
      largest = std::max(largest, row.normal_impulse);
      is_cold = is_cold || (row.normal_impulse > 0 && !row.is_known);
    }
    ++rounds_;
    residual_ = largest > 0 ? change / largest : 0;
    const RoundLimit& limit = is_cold ? cold : warm;
    if (change <= limit.tolerance * largest || round >= limit.rounds) break;
  }
  store(v);
}

/// Updates a point's impulses. Returns their change, N s.
template <class Real>
double ContactRows<Real>::visit(Row& row) {
  const Vec4 u = velocity_of(row);
  const double rate = row.normal.dot(u), closing = row.min_gap_rate - rate;
  if (row.normal_impulse == 0 && !(closing > 0)) return 0;  // most points at rest: others bear the load
  const double normal = std::max(0.0, row.normal_impulse + closing * row.mass);
  const double added = normal - row.normal_impulse;
  double change = std::abs(added);
  row.normal_impulse = normal;
  if (!(row.friction > 0)) {
    add_impulse(row, added * row.normal);
    return change;
  }
  // The normal impulse leaves the velocity of sliding as it is.
  Vec4 friction_impulse = row.friction_impulse - (u - rate * row.normal + row.drift) * row.mass;
  const double square = friction_impulse.squaredNorm(), max_friction = row.friction * normal;
  if (square > max_friction * max_friction) friction_impulse *= max_friction / std::sqrt(square);
  const Vec4 correction = friction_impulse - row.friction_impulse;
  row.friction_impulse = friction_impulse;
  row.work += correction.dot(u + correction * (row.inverse_mass / 2));
  add_impulse(row, added * row.normal + correction);
  return std::max(change, correction.norm());
}

template <class Real>
void ContactRows<Real>::turn(std::size_t i, const ContactPoint& point, double effective_inverse_mass,
                             const std::vector<Real>& inverse_mass, Real* v) {
  const Row old = rows_[i];
  apply(old, -1, v);
  Row& row = replace(i, point, effective_inverse_mass, inverse_mass);
  row.normal_impulse = old.normal_impulse;
  row.friction_impulse = old.friction_impulse - row.normal.dot(old.friction_impulse) * row.normal;
  row.work = old.work;
  row.is_known = old.is_known;
  apply(row, 1, v);
}

template <class Real>
void ContactRows<Real>::apply(const Row& row, double sign, Real* v) const {
  const Vec4 impulse = sign * (row.normal_impulse * row.normal + row.friction_impulse);
  for (std::size_t k = 0; k < 4; ++k)
    Eigen::Map<Vector3<Real>>(v + 3 * nodes_[index(row.nodes[k])]) +=
        (row.mobility[k] * impulse).template head<3>().template cast<Real>();
}

template class ContactRows<float>;
template class ContactRows<double>;

}  // namespace heml
