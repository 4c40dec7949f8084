#include <heml/elastic/tension.hpp>
#include <studies/operation_count.hpp>
#include <vector>

namespace heml {
namespace {

RestShape<CountingScalar> rest_shape_of(const TetMesh& mesh, const Tet& tet, const Vec3& fibre) {
  const auto node = [&](std::size_t a) { return mesh.nodes[static_cast<std::size_t>(tet[a])]; };
  Mat3 Dm;
  Dm << node(1) - node(0), node(2) - node(0), node(3) - node(0);
  const Mat3 g = Dm.inverse(), A = g * g.transpose();
  const Vec3 m = g * fibre;
  RestShape<CountingScalar> rest;
  const double entries[6] = {A(0, 0), A(1, 1), A(2, 2), A(0, 1), A(0, 2), A(1, 2)};
  for (int i = 0; i < 6; ++i) rest.A[i] = entries[i];
  for (int i = 0; i < 3; ++i) rest.fibre[i] = m[i];
  rest.volume = Dm.determinant() / 6;
  return rest;
}

template <class L>
void add_forces(const L& law, const TetMesh& mesh, const Vec3& fibre, const double* positions) {
  const std::vector<CountingScalar> x(positions, positions + 3 * mesh.nodes.size());
  std::vector<CountingScalar> f(x.size());
  for (const Tet& tet : mesh.tets) {
    std::size_t at[4];
    for (std::size_t a = 0; a < 4; ++a) at[a] = 3 * static_cast<std::size_t>(tet[a]);
    CountingScalar corner[12];
    corner_forces(law, &x[at[0]], &x[at[1]], &x[at[2]], &x[at[3]], rest_shape_of(mesh, tet, fibre), corner);
    for (std::size_t i = 0; i < 12; ++i) f[at[i / 3] + i % 3] += corner[i];
  }
}

}  // namespace

Operations force_operations(const TetMesh& mesh, const Material& material, const double* positions) {
  Operations result;
  visit_law(law_index(material.law), false, [&]<class Tag, bool continued>(Tag, std::bool_constant<continued>) {
    if constexpr (!continued) {
      using L = typename Tag::template Law<CountingScalar, false>;
      const L law = law_from<L, CountingScalar>(material.parameters);
      result = operations_of([&] { add_forces(law, mesh, material.fibre, positions); });
    }
  });
  return result;
}

std::optional<Operations> element_operations(const Material& material) {
  if (law_index(material.law) == law_count) return std::nullopt;  // no law of LawList: springs, expressions
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
  mesh.tets = {{0, 1, 2, 3}};
  const double x[12] = {0, 0, 0, 0.11, 0, 0.01, 0.01, 0.1, 0, 0, 0.01, 0.09};
  return force_operations(mesh, material, x) - Operations{0, 12, 0};
}

}  // namespace heml
