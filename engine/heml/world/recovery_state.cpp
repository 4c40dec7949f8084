#include <algorithm>
#include <cmath>
#include <heml/world/recovery_state.hpp>
#include <limits>
#include <mutex>

namespace heml {
namespace {

constexpr double tool_interval = 0.02;       // s: commands that move a tool arrive at about 60 Hz
constexpr std::size_t element_grain = 2048;  // whose volumes outweigh the cost of waking a thread
constexpr std::size_t quadratic_grain = 128;  // of four points each, whose positions have to be found first

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

template <class Position>
bool is_upright(const Tet& tet, const Position& position) {
  return signed_volume(position(tet[0]), position(tet[1]), position(tet[2]), position(tet[3])) > 0;
}

/// Calls visit(element, m³) with the signed volume of each point at positions given by position(node).
template <class Real, class Position, class Visit>
void each_volume(const Model<Real>& model, const Position& position, std::size_t begin, std::size_t end,
                 const Visit& visit) {
  for (std::size_t t = begin; t < end; ++t) {
    const Tet& tet = model.mesh.tets[t];
    if (model.midedges.empty())
      visit(t, signed_volume(position(tet[0]), position(tet[1]), position(tet[2]), position(tet[3])));
    else
      for (const double volume : point_volumes(tet, model.midedges[t], position)) visit(t, volume);
  }
}

/// Inverted elements of [begin, end), the lowest J among them and the first element that has it.
template <class Real, class Position>
StateCheck check_elements(const RecoveryReference& reference, const Model<Real>& model, const Position& x,
                          std::size_t begin, std::size_t end) {
  StateCheck check;
  std::size_t point = begin * (model.midedges.empty() ? 1 : element_points), last_inverted = end;
  each_volume(model, x, begin, end, [&](std::size_t t, double volume) {
    const double rest = reference.volume[point++];
    const double J = std::isfinite(volume) ? volume / rest : -std::numeric_limits<double>::infinity();
    if (!(J > 0) && t != last_inverted) {
      ++check.inverted;
      last_inverted = t;
    }
    if (!(J < check.min_J)) return;
    check.min_J = J;
    check.worst = static_cast<int>(t);
  });
  return check;
}

}  // namespace

template <class Real>
RecoveryReference make_recovery_reference(const Model<Real>& model, const std::vector<Real>& masses) {
  const auto X = [&](int n) -> const Vec3& { return model.mesh.nodes[static_cast<std::size_t>(n)]; };
  RecoveryReference rest;
  rest.extent = spread(masses, X).first;
  rest.volume.reserve(model.mesh.tets.size() * (model.midedges.empty() ? 1 : 4));
  each_volume(model, X, 0, model.mesh.tets.size(), [&](std::size_t t, double volume) {
    const double scale = rest_scale(model.mesh, t);
    rest.volume.push_back(scale * scale * scale * volume);
  });
  if (model.midedges.empty()) return rest;
  rest.eighths = subdivided(model.mesh, model.midedges).tets;
  std::erase_if(rest.eighths, [&](const Tet& tet) { return !is_upright(tet, X); });
  return rest;
}

template <class Real>
bool RecoveryState<Real>::is_folded(const State<Real>& state) const {
  const auto x = [&](int n) { return at(state.x, n); };
  const std::vector<Tet>& eighths = this->reference->eighths;
  return std::any_of(eighths.begin(), eighths.end(), [&](const Tet& tet) { return !is_upright(tet, x); });
}

template <class Real>
StateCheck RecoveryState<Real>::check(const Model<Real>& model, const State<Real>& state,
                                      const std::vector<Real>& masses, ThreadTeam& team) const {
  StateCheck check;
  const auto x = [&](int n) { return at(state.x, n); };
  std::mutex mutex;
  const std::size_t grain = model.midedges.empty() ? element_grain : quadratic_grain;
  team.parallel_for(model.mesh.tets.size(), grain, [&](std::size_t begin, std::size_t end) {
    const StateCheck part = check_elements(*this->reference, model, x, begin, end);
    std::lock_guard lock(mutex);
    check.inverted += part.inverted;
    if (part.min_J < check.min_J || (part.min_J == check.min_J && part.worst < check.worst)) {
      check.min_J = part.min_J;
      check.worst = part.worst;
    }
  });
  const Vec3 mean = spread(masses, [&](int n) { return at(state.v, n); }).second;
  for (std::size_t n = 0; n < masses.size(); ++n) {
    const double speed = masses[n] > 0 ? (at(state.v, static_cast<int>(n)) - mean).norm() : 0;
    check.speed = std::max(check.speed, std::isfinite(speed) ? speed : std::numeric_limits<double>::infinity());
  }
  check.extent = spread(masses, x).first / this->reference->extent;
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

template RecoveryReference make_recovery_reference(const Model<float>&, const std::vector<float>&);
template RecoveryReference make_recovery_reference(const Model<double>&, const std::vector<double>&);
template class RecoveryState<float>;
template class RecoveryState<double>;

}  // namespace heml
