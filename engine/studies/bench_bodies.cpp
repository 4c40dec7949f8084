#include <fmt/format.h>

#include <cmath>
#include <heml/base/hash.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/reorder.hpp>
#include <studies/bench_bodies.hpp>
#include <thread>

namespace heml {
namespace {

/// Number `place` of a deterministic sequence, uniform in [−1, 1].
double noise(std::uint64_t place) { return static_cast<double>(hash_combine(1, place) >> 11) * 0x1p-52 - 1; }

void jitter(TetMesh& mesh, int n, double size) {
  const double reach = 0.2 * size / n, edge = 1e-9 * size;
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      double& X = mesh.nodes[k][i];
      if (X > edge && X < size - edge) X += reach * noise(3 * k + static_cast<std::size_t>(i));
    }
}

}  // namespace

BenchBody bench_body(std::string name, const TetMesh& mesh) {
  BenchBody body{std::move(name), reordered(mesh, hilbert_order(mesh)), {}};
  Vec3 low = body.mesh.nodes.front(), high = low;
  for (const Vec3& X : body.mesh.nodes) low = low.cwiseMin(X), high = high.cwiseMax(X);
  const double size = (high - low).maxCoeff();
  for (const Vec3& X : body.mesh.nodes) {
    const Vec3 at = (X - low) / size;
    const Vec3 bend(0.02 * std::sin(3 * at.y()), 0.02 * std::sin(3 * at.z()), 0.02 * std::sin(3 * at.x()));
    const Vec3 moved = X + size * (bend + Vec3(0.03 * at.x(), -0.02 * at.y(), 0.01 * at.z()));
    body.x.insert(body.x.end(), {moved.x(), moved.y(), moved.z()});
  }
  return body;
}

BenchBody bench_cube(int n, bool irregular) {
  constexpr double size = 0.1;
  TetMesh mesh = make_box(Vec3(size, size, size), {n, n, n});
  if (irregular) jitter(mesh, n, size);
  return bench_body(fmt::format("{} cube {}", irregular ? "irregular" : "regular", n), mesh);
}

std::vector<Material> bench_materials() {
  std::vector<Material> materials;
  for (const LawInfo& law : laws()) materials.push_back(bench_material(law.name));
  return materials;
}

Material bench_material(std::string_view law) {
  Material material = sample_material(*find_law(law));
  if (find_law(law)->has_fibre) material.fibre = Vec3(2, -1, 2) / 3;
  return material;
}

WorldSetup hanging_cube(const TetMesh& mesh, const Material& material) {
  WorldSetup setup;
  setup.mesh = mesh;
  setup.materials = {{std::nullopt, material}};
  Boundary fixed;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (mesh.nodes[n].x() < 1e-9) fixed.nodes.push_back(static_cast<int>(n));
  setup.boundary = {fixed};
  setup.gravity = Vec3(0, -9.81, 0);
  return setup;
}

std::vector<InstructionSet> kernels_of(const Material& material) {
  if (!find_law(material.law)->is_continuum) return {InstructionSet::portable};  // springs have no kernels
  const auto sets = instruction_sets();
  return {sets.begin(), sets.end()};
}

std::vector<int> bench_threads() {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  return cores > 1 ? std::vector<int>{1, cores} : std::vector<int>{1};
}

}  // namespace heml
