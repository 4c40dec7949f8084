#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <heml/materials/material.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/world/world.hpp>

namespace heml::test {

inline Material soft(const char* law = "neo_hookean", double young = 1e4, double poisson = 0.3) {
  const LameParameters lame = lame_parameters(young, poisson);
  return {law, {lame.lambda, lame.mu}, 1000};
}

/// Whether a world has a tool of a kind.
template <class State>
bool has_tool(const World& world) {
  return find_tool<State>(world.tools()) != nullptr;
}

/// The first tool of a kind; the default where there is none.
template <class State>
State tool_of(const World& world) {
  const std::vector<ToolState> tools = world.tools();
  const State* state = find_tool<State>(tools);
  return state ? *state : State{};
}

/// Nodes of a mesh that a predicate takes.
template <class Take>
std::vector<int> nodes_where(const TetMesh& mesh, const Take& take) {
  std::vector<int> nodes;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (take(mesh.nodes[n])) nodes.push_back(static_cast<int>(n));
  return nodes;
}

/// Adds another mesh at a place.
inline void add(TetMesh& mesh, const TetMesh& other, const Eigen::Isometry3d& place) {
  const auto first = static_cast<int>(mesh.nodes.size());
  for (const Vec3& X : other.nodes) mesh.nodes.push_back(place * X);
  for (Tet tet : other.tets) {
    for (int& n : tet) n += first;
    mesh.tets.push_back(tet);
  }
  mesh.regions.insert(mesh.regions.end(), other.regions.begin(), other.regions.end());
}

/// A cut through a bar along x, at x.
inline CutTissue blade_at(double x) {
  CutTissue cut;
  cut.sweep.blades = {{Vec3(x, -0.1, -0.1), Vec3(x, 0.1, -0.1)}, {Vec3(x, -0.1, 0.1), Vec3(x, 0.1, 0.1)}};
  return cut;
}

/// A material with what it may remember, one after the other and all together, and without.
inline std::vector<Material> with_internal_state(const Material& plain) {
  Material viscous = plain, relaxing = plain, plastic = plain, all = plain;
  viscous.viscosity = all.viscosity = 2;
  relaxing.relaxation = all.relaxation = {{0.5, 0.01}, {0.2, 0.1}};
  plastic.plasticity = all.plasticity = Plasticity{60, 10};
  std::vector<Material> materials;
  for (const Material& material : {plain, viscous, relaxing, plastic, all})
    if (!material_problem(material)) materials.push_back(material);
  return materials;
}

/// Number of integration points that are flat or inside out.
inline int inverted(World& world) {
  const std::vector<double> J = world.point_volume_ratios();
  return static_cast<int>(std::count_if(J.begin(), J.end(), [](double ratio) { return !(ratio > 0); }));
}

/// A block 0.1 × 0.02 × 0.02 m along x, held at x = 0, under gravity in −y.
inline WorldSetup cantilever(const char* law = "neo_hookean", double young = 1e4) {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(0.1, 0.02, 0.02), {10, 2, 2});
  setup.materials = {{std::nullopt, soft(law, young)}};
  setup.boundary.push_back({nodes_where(setup.mesh, [](const Vec3& X) { return X.x() < 1e-9; })});
  setup.gravity = Vec3(0, -9.81, 0);
  setup.solver.threads = 1;
  return setup;
}

inline double rms_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

inline double total(const Energies& e) { return e.kinetic + e.elastic + e.potential; }

inline void run_until(World& world, double time) {
  while (!world.halt() && world.time() < time - 1e-9) world.tick();
}

}  // namespace heml::test
