#pragma once
// The bodies of the benchmarks and their materials.
#include <heml/elastic/body.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <heml/world/setup.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace heml {

/// A deformed mesh in the engine's order.
struct BenchBody {
  std::string name;
  TetMesh mesh;           ///< in Hilbert order (mesh/reorder.hpp), for naive loops and engine alike
  std::vector<double> x;  ///< 3 #V, m: a smooth deformation with stretches of 0.9 to 1.1
};

/// Reorders and deforms a mesh.
BenchBody bench_body(std::string name, const TetMesh& mesh);

/// A cube of 10 cm, 5 tetrahedra in each of n³ cells. irregular: inner nodes moved by up to a fifth of a cell (seed 1).
BenchBody bench_cube(int n, bool irregular);

/// A cube fixed at its face x = 0, under gravity along −y.
WorldSetup hanging_cube(const TetMesh& mesh, const Material& material);

/// One material of every law, around 1 kPa, nearly incompressible where it has a volume term.
std::vector<Material> bench_materials();
/// The material of one law; the law must exist.
Material bench_material(std::string_view law);

/// The instruction sets whose kernels this processor can run for a material, the best last.
std::vector<InstructionSet> kernels_of(const Material& material);

/// {1} or {1, all cores}.
std::vector<int> bench_threads();

/// x (3 #V) converted to Real.
template <class Real>
std::vector<Real> as_reals(const std::vector<double>& x) {
  return {x.begin(), x.end()};
}

}  // namespace heml
