// Cases of static equilibrium.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <studies/stability/measures.hpp>

namespace heml::stability {
namespace {

std::map<int, Vec3> targets(const WorldSetup& setup) {
  std::map<int, Vec3> result;
  for (const Boundary& entry : setup.boundary)
    for (const int n : entry.nodes) result[n] = setup.mesh.nodes[static_cast<std::size_t>(n)] + entry.translate;
  return result;
}

/// The least-squares affine map from rest positions to targets.
Eigen::Matrix<double, 3, 4> affine_fit(const WorldSetup& setup, const std::map<int, Vec3>& to) {
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  Eigen::Matrix<double, 3, 4> b = Eigen::Matrix<double, 3, 4>::Zero();
  for (const auto& [n, x] : to) {
    const Eigen::Vector4d X = setup.mesh.nodes[static_cast<std::size_t>(n)].homogeneous();
    A += X * X.transpose();
    b += x * X.transpose();
  }
  return b * A.inverse();
}

/// Mean sag of the far end, m.
double sag_of(const World& world) {
  const auto& rest = world.setup().mesh.nodes;
  const auto x = world.positions();
  double far = 0, sum = 0;
  int count = 0;
  for (const Vec3& X : rest) far = std::max(far, X.x());
  for (std::size_t n = 0; n < rest.size(); ++n)
    if (rest[n].x() > far - 1e-9) sum += rest[n].y() - x[n].y(), ++count;
  return sum / count;
}

double volume_of(World& world) {
  const auto J = world.volume_ratios();
  const TetMesh& mesh = world.setup().mesh;
  double now = 0, rest = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto X = [&](std::size_t c) { return mesh.nodes[static_cast<std::size_t>(mesh.tets[t][c])]; };
    const double V = signed_volume(X(0), X(1), X(2), X(3));
    now += J[t] * V;
    rest += V;
  }
  return now / rest;
}

}  // namespace

Outcome patch(const Trial& trial) {
  WorldSetup setup = trial.setup("06_patch");
  set_tolerance(setup, 1e-12);
  if (!is_explicit(setup.solver.integrator)) setup.solver.step = 0.02;
  const auto to = targets(setup);
  const auto map = affine_fit(setup, to);
  const auto world = run_to_end(trial, setup);
  const auto x = world->positions();
  double worst = 0;
  for (std::size_t n = 0; n < x.size(); ++n)
    worst = std::max(worst, (x[n] - map * setup.mesh.nodes[n].homogeneous()).norm());
  return ended(*world, worst / 0.1);
}

Outcome flattened(const Trial& trial) {
  // From half the height to below the floor: the reaction must grow at every height.
  WorldSetup setup = trial.setup("14_flattened");
  const double side = 0.1;
  double before = 0, min_rise = 1;
  Outcome outcome;
  for (const double height : {0.5, 0.3, 0.1, 0.0, -0.2}) {
    setup.boundary[1].translate = Vec3(0, (height - 1) * side, 0);
    setup.boundary[1].ramp_time = 0;
    setup.initial_positions.clear();
    for (const Vec3& X : setup.mesh.nodes) setup.initial_positions.emplace_back(X.x(), height * X.y(), X.z());
    const auto world = trial.world(setup);
    if (world->halt()) return stopped(*world);
    const double pushed = -world->reactions()[1].y();
    if (before > 0) min_rise = std::min(min_rise, pushed / before - 1);
    if (!(pushed > before)) ++outcome.value;
    before = pushed;
  }
  outcome.note = fmt::format("least rise {:.0f} %", 100 * min_rise);
  return outcome;
}

Outcome stretched_and_pressed(const Trial& trial) {
  Outcome outcome;
  for (const char* scene : {"16_stretched_five_times", "16_pressed_to_a_fifth"}) {
    WorldSetup setup = trial.setup(scene);
    if (trial.variant.single) setup.solver.tolerance.reset();
    const auto world = run_to_end(trial, setup);
    Outcome one = ended(*world, static_cast<double>(world->solver_stats().iterations));
    const auto reactions = world->reactions();
    const double relative_net_load = (reactions[0] + reactions[1]).norm() / reactions[0].norm();
    if (!(relative_net_load <= (trial.variant.single ? 1e-3 : 1e-6)))
      one.broken = fmt::format("{}: the supports' forces differ by {:.1e}", scene, relative_net_load);
    outcome = worse(outcome, one);
  }
  return outcome;
}

Outcome stiffness_ratio(const Trial& trial) {
  WorldSetup stiff = trial.setup("19_stiff_half");
  if (trial.variant.single) stiff.solver.tolerance.reset();
  WorldSetup rigid = stiff;  // all nodes of the stiff half are constrained
  for (std::size_t t = 0; t < rigid.mesh.tets.size(); ++t)
    if (rigid.mesh.regions[t] == 1)
      for (const int n : rigid.mesh.tets[t]) rigid.boundary[1].nodes.push_back(n);
  const auto a = run_to_end(trial, stiff), b = run_to_end(trial, rigid);
  if (b->halt()) return stopped(*b);
  const double moved = rms_difference(b->positions(), rigid.mesh.nodes);
  const double shape = rms_difference(a->positions(), b->positions()) / moved;
  const double force = (a->reactions()[0] - b->reactions()[0]).norm() / b->reactions()[0].norm();
  return ended(*a, std::max(shape, force), fmt::format("{} iterations", a->solver_stats().iterations));
}

Outcome nearly_incompressible(const Trial& trial) {
  WorldSetup setup = trial.setup("21_nearly_incompressible");
  if (trial.variant.single) setup.solver.tolerance.reset();
  std::vector<std::unique_ptr<World>> worlds;
  for (const double poisson : {0.3, 0.499}) {
    set_young_poisson(setup, 5e5, poisson);
    worlds.push_back(run_to_end(trial, setup));
    if (worlds.back()->halt()) return stopped(*worlds.back());
  }
  const double sag = sag_of(*worlds[1]), volume = volume_of(*worlds[1]) - 1;
  Outcome outcome = ended(*worlds[1], std::abs(sag / sag_of(*worlds[0]) - 1),
                          fmt::format("sag {:.2f} mm, volume {:+.3f} %", 1e3 * sag, 100 * volume));
  if (!(std::abs(volume) <= 0.005)) outcome.broken = fmt::format("volume changes by {:.2f} %", 100 * volume);
  return outcome;
}

}  // namespace heml::stability
