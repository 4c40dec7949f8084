#pragma once
// The bodies that are measured, and the materials they are made of.
#include <heml/elastic/body.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <heml/world/setup.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace heml {

/// A mesh in the engine's order, deformed.
struct BenchBody {
  std::string name;
  TetMesh mesh;           ///< inner order (mesh/reorder.hpp), which naive loops and ours share
  std::vector<double> x;  ///< 3 #V, m: a smooth deformation with stretches of 0.9 to 1.1
};

/// As above from any mesh.
BenchBody bench_body(std::string name, const TetMesh& mesh);

/// A cube of 10 cm, 5 tetrahedra in each of n³ cells. irregular: inner nodes moved by up to a fifth of a cell (seed 1).
BenchBody bench_cube(int n, bool irregular);

/// A cube that hangs from its face x = 0, and swings.
WorldSetup hanging_cube(const TetMesh& mesh, const Material& material);

/// One material of every law, around 1 kPa, nearly incompressible where it has a volume term.
std::vector<Material> bench_materials();
/// Of that law; which has to be one.
Material bench_material(std::string_view law);

/// The instruction sets whose kernels this processor can run for a material, the best last.
std::vector<InstructionSet> kernels_of(const Material& material);

/// {1} or {1, all cores}.
std::vector<int> bench_threads();

/// A mesh's nodes one after the other (3 #V), as Real.
template <class Real>
std::vector<Real> as_reals(const std::vector<double>& x) {
  return {x.begin(), x.end()};
}

}  // namespace heml
