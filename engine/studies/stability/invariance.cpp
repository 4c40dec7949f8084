// Cases that describe one body in two equivalent ways: results must agree.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <heml/base/hash.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/schedule.hpp>
#include <numeric>
#include <studies/stability/measures.hpp>

namespace heml::stability {
namespace {

/// A permutation of 0 … count − 1.
std::vector<int> shuffled(std::size_t count, std::uint64_t seed) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t k = count; k > 1; --k) std::swap(order[k - 1], order[hash_combine(seed, k) % k]);
  return order;
}

/// Permutes nodes, elements and corners, and inverts the orientation of every third element, which check_tets()
/// restores.
WorldSetup renumbered(const WorldSetup& setup, const std::vector<int>& new_node) {
  WorldSetup other = setup;
  for (std::size_t n = 0; n < new_node.size(); ++n)
    other.mesh.nodes[static_cast<std::size_t>(new_node[n])] = setup.mesh.nodes[n];
  const auto order = shuffled(setup.mesh.tets.size(), 31);
  for (std::size_t t = 0; t < order.size(); ++t) {
    Tet tet = setup.mesh.tets[static_cast<std::size_t>(order[t])];
    std::rotate(tet.begin(), tet.begin() + 1, tet.begin() + 3);
    if (t % 3 == 0) std::swap(tet[1], tet[2]);
    for (int& n : tet) n = new_node[static_cast<std::size_t>(n)];
    other.mesh.tets[t] = tet;
    other.mesh.regions[t] = setup.mesh.regions[static_cast<std::size_t>(order[t])];
  }
  check_tets(other.mesh);
  for (Boundary& entry : other.boundary)
    for (int& n : entry.nodes) n = new_node[static_cast<std::size_t>(n)];
  return other;
}

WorldSetup turned(const WorldSetup& setup, const Mat3& R) {
  WorldSetup other = setup;
  for (Vec3& X : other.mesh.nodes) X = R * X;
  for (Boundary& entry : other.boundary) {
    entry.translate = R * entry.translate;
    entry.axis = R * entry.axis;
    entry.origin = R * entry.origin;
  }
  for (RegionMaterial& entry : other.materials) entry.material.fibre = R * entry.material.fibre;
  other.gravity = R * other.gravity;
  return other;
}

}  // namespace

Outcome permuted(const Trial& trial) {
  WorldSetup setup = trial.setup("30_permuted");
  set_tolerance(setup, 1e-9);
  const Mat3 R = Eigen::AngleAxisd(2.1, Vec3(2, 1, -2) / 3).toRotationMatrix();
  const auto new_node = shuffled(setup.mesh.nodes.size(), 30);
  const auto plain = run_to_end(trial, setup), other = run_to_end(trial, turned(renumbered(setup, new_node), R));
  if (plain->halt()) return stopped(*plain);
  const auto x = plain->positions(), y = other->positions();
  double worst = 0;
  for (std::size_t n = 0; n < x.size(); ++n)
    worst = std::max(worst, (R * x[n] - y[static_cast<std::size_t>(new_node[n])]).norm());
  return ended(*other, worst / diagonal(setup.mesh));
}

Outcome other_units(const Trial& trial) {
  WorldSetup metres = trial.setup("31_other_units");
  set_tolerance(metres, 1e-9);
  // Lengths in mm, masses in kg, times in s: a pascal is 0.001 kg/(mm s²).
  WorldSetup millimetres = metres;
  for (Vec3& X : millimetres.mesh.nodes) X *= 1000;
  millimetres.gravity *= 1000;
  for (RegionMaterial& entry : millimetres.materials) {
    const SmallStrainModuli ground = small_strain_moduli(entry.material);
    if (find_law(entry.material.law)->is_continuum)
      entry.material = material_of(entry.material.law, ground.shear / 1000, ground.bulk / 1000);
    entry.material.density = metres.materials[0].material.density * 1e-9;
  }
  const auto a = run_to_end(trial, metres), b = run_to_end(trial, millimetres);
  if (a->halt()) return stopped(*a);
  std::vector<Vec3> x = a->positions();
  for (Vec3& at : x) at *= 1000;
  return ended(*b, max_difference(x, b->positions()) / diagonal(millimetres.mesh));
}

Outcome any_number_of_threads(const Trial& trial) {
  const char* name = "32_any_number_of_threads";
  const Scene scene = read_scene(assets_folder() / "scenes" / "extreme" / (std::string(name) + ".json"));
  WorldSetup setup = trial.setup(name);
  if (setup.solver.is_static() && setup.solver.single_precision) setup.solver.tolerance = 1e-2;  // 10,000 elements
  std::optional<std::uint64_t> first;
  Outcome outcome;
  for (const int threads : {1, 2, 3, 5, 8, 16}) {
    if (trial.quick && threads > 2) continue;
    setup.solver.threads = threads;
    const auto world = trial.world(setup);
    Schedule schedule(scene, setup.mesh);
    const int ticks = is_explicit(setup.solver.integrator) ? 20 : setup.solver.is_static() ? 1 : 5;
    for (int k = 0; k < ticks && !world->halt(); ++k) {
      schedule.apply(*world);
      world->tick();
    }
    if (world->halt()) return stopped(*world);
    if (!first) first = world->state_hash();
    if (world->state_hash() != *first) ++outcome.value;
    outcome.inverted = inverted(*world);
    outcome.note = fmt::format("1 to {} threads, {} elements", threads, setup.mesh.tets.size());
  }
  return outcome;
}

}  // namespace heml::stability
