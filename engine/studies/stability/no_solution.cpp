#include <fmt/format.h>

#include <algorithm>
#include <heml/materials/ellipticity.hpp>
#include <heml/materials/point.hpp>
#include <map>
#include <studies/stability/no_solution.hpp>
#include <utility>

namespace heml::stability {
namespace {

constexpr double limit_ratio = 0.02;  // of the stiffness at rest: less is that of a limit point

using Edge = std::pair<int, int>;

/// Calls visit(a, b) for the six edges of an element, a < b.
template <class Visit>
void each_edge(const Tet& tet, const Visit& visit) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) visit(std::min(tet[i], tet[j]), std::max(tet[i], tet[j]));
}

/// The lowest acoustic eigenvalue of elements of one body, Pa.
class Ellipticity {
 public:
  explicit Ellipticity(const WorldSetup& setup) : mesh_(setup.mesh), material_(setup.materials[0].material) {
    if (find_law(material_.law)->is_continuum) {
      point_ = make_material_point(material_, setup.solver.continuation);
      return;
    }
    for (const Tet& tet : mesh_.tets) each_edge(tet, [&](int a, int b) { ++elements_at_[{a, b}]; });
  }

  double at(const Tet& tet, const Mat3& F, double volume) const {
    if (point_) return min_acoustic_eigenvalue([&](const Mat3& dF) { return point_->first_piola_differential(F, dF); });
    return min_acoustic_eigenvalue([&](const Mat3& dF) {
      Mat3 sum = Mat3::Zero();
      each_edge(tet, [&](int a, int b) {  // each spring is shared by the elements round it
        const double k = material_.parameters[0] / elements_at_.at({a, b});
        sum += spring_tangent(k, rest(b) - rest(a), volume, F, dF);
      });
      return sum;
    });
  }
  Vec3 rest(int n) const { return mesh_.nodes[static_cast<std::size_t>(n)]; }

 private:
  const TetMesh& mesh_;
  const Material& material_;
  std::unique_ptr<MaterialPoint> point_;  ///< null: springs
  std::map<Edge, int> elements_at_;
};

std::string lost_ellipticity(World& world) {
  const TetMesh& mesh = world.setup().mesh;
  const Ellipticity ellipticity(world.setup());
  const auto x = world.positions();
  int lost = 0, first = -1;
  double first_J = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Tet& tet = mesh.tets[t];
    Mat3 Dm, Ds;
    for (std::size_t c = 1; c < 4; ++c) {
      Dm.col(static_cast<int>(c) - 1) = ellipticity.rest(tet[c]) - ellipticity.rest(tet[0]);
      Ds.col(static_cast<int>(c) - 1) = x[static_cast<std::size_t>(tet[c])] - x[static_cast<std::size_t>(tet[0])];
    }
    const Mat3 F = Ds * Dm.inverse();
    if (!(F.determinant() > 0) || !(ellipticity.at(tet, F, Dm.determinant() / 6) < 0)) continue;
    if (lost++ == 0) {
      first = static_cast<int>(t);
      first_J = F.determinant();
    }
  }
  if (lost == 0) return {};
  return fmt::format("ellipticity is lost in {} of {} elements, element {} at J = {:.2f}", lost, mesh.tets.size(),
                     first, first_J);
}

}  // namespace

std::string proof_of_no_solution(World& world) {
  const WorldSetup& setup = world.setup();
  const std::string& law = setup.materials[0].material.law;
  if (setup.materials.size() != 1 || (law != "stvk" && law != "mass_spring")) return {};
  const SolverStats stats = world.solver_stats();
  if (setup.solver.is_static() && stats.limit_stiffness && *stats.limit_stiffness <= limit_ratio)
    return fmt::format("limit point at {:.6g} of the load: stiffness {:.1e} of that at rest", stats.load,
                       *stats.limit_stiffness);
  return lost_ellipticity(world);
}

}  // namespace heml::stability
