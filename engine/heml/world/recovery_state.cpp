#include <algorithm>
#include <cmath>
#include <heml/world/recovery_state.hpp>
#include <limits>

namespace heml {
namespace {

constexpr double tool_interval = 0.02;  // s: commands that move a tool arrive at about 60 Hz

template <class Real>
Vec3 at(const std::vector<Real>& values, int node) {
  const Real* value = &values[3 * static_cast<std::size_t>(node)];
  return {static_cast<double>(value[0]), static_cast<double>(value[1]), static_cast<double>(value[2])};
}

/// Radius of gyration and mean.
template <class Real, class At>
std::pair<double, Vec3> spread(const std::vector<Real>& masses, const At& x) {
  const std::size_t nodes = masses.size();
  Vec3 sum = Vec3::Zero();
  double mass = 0, square = 0;
  for (std::size_t n = 0; n < nodes; ++n) {
    sum += static_cast<double>(masses[n]) * x(static_cast<int>(n));
    mass += static_cast<double>(masses[n]);
  }
  const Vec3 mean = sum / mass;
  for (std::size_t n = 0; n < nodes; ++n)
    square += static_cast<double>(masses[n]) * (x(static_cast<int>(n)) - mean).squaredNorm();
  return {std::sqrt(square / mass), mean};
}

}  // namespace

template <class Real>
RecoveryState<Real>::RecoveryState(const TetMesh& mesh, const std::vector<Real>& masses,
                                   RecoveryProgress<Real> progress)
    : RecoveryProgress<Real>(std::move(progress)) {
  set_mesh(mesh, masses);
}

template <class Real>
void RecoveryState<Real>::set_mesh(const TetMesh& mesh, const std::vector<Real>& masses) {
  rest_extent_ = spread(masses, [&](int n) { return mesh.nodes[static_cast<std::size_t>(n)]; }).first;
  rest_volume_.clear();
  for (const Tet& tet : mesh.tets) {
    const auto X = [&](std::size_t c) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(tet[c])]; };
    rest_volume_.push_back(signed_volume(X(0), X(1), X(2), X(3)));
  }
}

template <class Real>
StateCheck RecoveryState<Real>::check(const TetMesh& mesh, const State<Real>& state,
                                      const std::vector<Real>& masses) const {
  StateCheck check;
  for (std::size_t t = 0; t < rest_volume_.size(); ++t) {
    const Tet& tet = mesh.tets[t];
    const double volume =
        signed_volume(at(state.x, tet[0]), at(state.x, tet[1]), at(state.x, tet[2]), at(state.x, tet[3]));
    const double J = std::isfinite(volume) ? volume / rest_volume_[t] : -std::numeric_limits<double>::infinity();
    if (!(J > 0)) ++check.inverted;
    if (!(J < check.min_J)) continue;
    check.min_J = J;
    check.worst = static_cast<int>(t);
  }
  const Vec3 mean = spread(masses, [&](int n) { return at(state.v, n); }).second;
  for (std::size_t n = 0; n < masses.size(); ++n) {
    const double speed = masses[n] > 0 ? (at(state.v, static_cast<int>(n)) - mean).norm() : 0;
    check.speed = std::max(check.speed, std::isfinite(speed) ? speed : std::numeric_limits<double>::infinity());
  }
  check.extent = spread(masses, [&](int n) { return at(state.x, n); }).first / rest_extent_;
  return check;
}

template <class Real>
void RecoveryState<Real>::track_tools(const std::vector<GraspSpring<Real>>& grasps, double time) {
  auto& before = this->tools_were;
  if (!grasps.empty() && !before.empty() && time < this->tool_time + tool_interval) return;
  this->tool_speed = 0;
  for (const auto& grasp : grasps)
    for (const auto& tool : before)
      if (tool.serial == grasp.id().serial)
        this->tool_speed =
            std::max(this->tool_speed, (grasp.target() - tool.place).norm() / (time - this->tool_time));
  before.clear();
  for (const auto& grasp : grasps) before.push_back({grasp.id().serial, grasp.target()});
  this->tool_time = time;
}

template class RecoveryState<float>;
template class RecoveryState<double>;

}  // namespace heml
