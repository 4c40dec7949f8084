#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <heml/base/hash.hpp>
#include <heml/mesh/quality.hpp>
#include <studies/stability/measures.hpp>
#include <studies/stability/no_solution.hpp>

namespace heml::stability {

Material material_of(std::string_view law, double mu, double kappa, double edge) {
  Material material = sample_material(*find_law(law), {mu, kappa});
  if (!find_law(law)->is_continuum) material.parameters = {mu * edge};
  return material;
}

void set_young_poisson(WorldSetup& setup, double young, double poisson) {
  for (RegionMaterial& entry : setup.materials) {
    const double density = entry.material.density;
    entry.material = material_of(entry.material.law, young / (2 + 2 * poisson), young / (3 - 6 * poisson));
    entry.material.density = density;
  }
}

double min_J(World& world) {
  const auto J = world.volume_ratios();
  return *std::min_element(J.begin(), J.end());
}

int inverted(World& world) {
  const auto J = world.volume_ratios();
  return static_cast<int>(std::count_if(J.begin(), J.end(), [](double ratio) { return !(ratio > 0); }));
}

double total(const Energies& e) { return e.kinetic + e.elastic + e.potential; }

Energies synchronous_energies(World& world) {
  Energies energies = world.energies();
  const WorldSetup& setup = world.setup();
  if (setup.solver.integrator != Integrator::symplectic_euler) return energies;
  const std::size_t nodes = setup.mesh.nodes.size();
  std::vector<double> mass(nodes, 0.0), f(3 * nodes);
  for (std::size_t t = 0; t < setup.mesh.tets.size(); ++t) {
    const Tet& tet = setup.mesh.tets[t];
    const auto X = [&](std::size_t c) { return setup.mesh.nodes[static_cast<std::size_t>(tet[c])]; };
    for (const int n : tet)
      mass[static_cast<std::size_t>(n)] +=
          setup.materials[0].material.density * signed_volume(X(0), X(1), X(2), X(3)) / 4;
  }
  std::vector<bool> fixed(nodes, false);
  for (const Boundary& entry : setup.boundary)
    for (const int n : entry.nodes) fixed[static_cast<std::size_t>(n)] = true;
  world.write_vectors(NodeVector::force, f);
  const double half_step = setup.solver.tick() / world.substeps() / 2;
  const std::vector<Vec3> v = world.velocities();
  energies.kinetic = 0;
  for (std::size_t n = 0; n < nodes; ++n)
    if (!fixed[n])
      energies.kinetic += mass[n] / 2 * (v[n] + half_step / mass[n] * Eigen::Map<const Vec3>(&f[3 * n])).squaredNorm();
  return energies;
}

double rms_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  assert(a.size() == b.size());
  double sum = 0;
  for (std::size_t n = 0; n < a.size(); ++n) sum += (a[n] - b[n]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

double max_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  assert(a.size() == b.size());
  double largest = 0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    const double apart = (a[n] - b[n]).norm();
    if (!(apart <= largest)) largest = apart;  // NaN too
  }
  return largest;
}

double diagonal(const TetMesh& mesh) {
  Vec3 low = mesh.nodes.front(), high = low;
  for (const Vec3& X : mesh.nodes) low = low.cwiseMin(X), high = high.cwiseMax(X);
  return (high - low).norm();
}

double away_from_rest(const World& world) {
  const std::vector<Vec3> x = world.positions();
  const std::vector<Vec3>& rest = world.setup().mesh.nodes;
  const auto mean = [](const std::vector<Vec3>& points) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& point : points) sum += point;
    return Vec3(sum / static_cast<double>(points.size()));
  };
  const Vec3 of_x = mean(x), of_rest = mean(rest);
  Mat3 moment = Mat3::Zero();
  for (std::size_t n = 0; n < x.size(); ++n) moment += (rest[n] - of_rest) * (x[n] - of_x).transpose();
  const Eigen::JacobiSVD<Mat3> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vec3 signs(1, 1, (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0 ? -1 : 1);
  const Mat3 R = svd.matrixV() * signs.asDiagonal() * svd.matrixU().transpose();
  double sum = 0;
  for (std::size_t n = 0; n < x.size(); ++n) sum += (x[n] - of_x - R * (rest[n] - of_rest)).squaredNorm();
  return std::sqrt(sum / static_cast<double>(x.size())) / diagonal(world.setup().mesh);
}

bool run_until(World& world, double time, long max_steps) {
  while (!world.halt() && world.time() < time - 1e-9 && world.steps() < max_steps) world.tick();
  return !world.halt() && world.time() >= time - 1e-9;
}

std::unique_ptr<World> run_to_end(const Trial& trial, const WorldSetup& setup) {
  auto world = trial.world(setup);
  if (setup.solver.is_static())
    world->load_to(1);
  else
    run_until(*world, setup.solver.duration);
  return world;
}

void set_tolerance(WorldSetup& setup, double tolerance) {
  if (!is_explicit(setup.solver.integrator)) setup.solver.tolerance = setup.solver.single_precision ? 1e-4 : tolerance;
}

Outcome ended(World& world, double value, std::string note) {
  Outcome outcome{value, inverted(world), world.recoveries(), {}, {}, std::move(note)};
  if (world.halt()) outcome.stopped = world.halt()->message;
  if (world.halt() || outcome.inverted > 0) outcome.proof = proof_of_no_solution(world);
  return outcome;
}

Outcome stopped(World& world) {
  Outcome outcome = ended(world, std::numeric_limits<double>::infinity());
  if (outcome.stopped.empty()) outcome.stopped = fmt::format("took {} steps to {:.3g} s", world.steps(), world.time());
  return outcome;
}

double noise(std::uint64_t seed, std::uint64_t place) {
  return static_cast<double>(hash_combine(seed, place) >> 11) * 0x1p-52 - 1;
}

std::vector<double> flat(const std::vector<Vec3>& points) {
  std::vector<double> x;
  for (const Vec3& point : points) x.insert(x.end(), {point.x(), point.y(), point.z()});
  return x;
}

}  // namespace heml::stability
