#include <Eigen/Eigenvalues>
#include <cmath>
#include <heml/mesh/connected_parts.hpp>
#include <heml/world/implicit_state.hpp>

namespace heml {
namespace {

template <class Real>
std::vector<bool> nonzero(const std::vector<Real>& values) {
  std::vector<bool> result;
  for (const Real value : values) result.push_back(value > 0);
  return result;
}

Vector thrice(const FreeNodes& free, const auto& masses) {
  Vector result = Vector::Zero(3 * static_cast<Eigen::Index>(masses.size()));
  for (const int n : free.node)
    result.segment<3>(3 * n).setConstant(static_cast<double>(masses[static_cast<std::size_t>(n)]));
  free.clear_held(result);
  return result;
}

/// Coordinates of free nodes that are held.
template <class Real>
std::vector<int> held_coordinates(const Model<Real>& model, const std::vector<Real>& inverse_mass) {
  std::vector<int> result;
  const std::vector<AxisSet> axes = held_axes(model);
  for (std::size_t n = 0; n < axes.size(); ++n)
    for (std::size_t i = 0; i < 3; ++i)
      if (inverse_mass[n] > 0 && axes[n].has[i]) result.push_back(static_cast<int>(3 * n + i));
  return result;
}

std::vector<double> repeated(const std::vector<double>& values, std::size_t times) {
  std::vector<double> result;
  for (const double value : values) result.insert(result.end(), times, value);
  return result;
}

/// The scene's, or the body's size's; L-BFGS needs one that is made once.
Preconditioner preconditioner_of(const SolverSettings& solver, std::size_t free_nodes) {
  const bool once = solver.minimiser == Minimiser::lbfgs && !solver.is_static();
  if (solver.preconditioner) {
    const bool is_once =
        *solver.preconditioner == Preconditioner::scalar || *solver.preconditioner == Preconditioner::multilevel;
    if (!once || is_once) return *solver.preconditioner;
  }
  const Preconditioner by_size = choose_preconditioner(free_nodes, solver.is_static());
  return once && by_size == Preconditioner::cholesky ? Preconditioner::scalar : by_size;
}

QuadraticPattern quadratic_pattern(const TetMesh& mesh, const MidEdges& midedges) {
  QuadraticPattern pattern{coupled_nodes(mesh, midedges), {}};
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    pattern.elements.push_back(quadratic_nodes(mesh.tets[t], midedges[t]));
  return pattern;
}

}  // namespace

template <class Real>
ImplicitState<Real>::ImplicitState(ElasticBody<Real>& elastic, const Shared<Model<Real>>& model,
                                   const Shared<NodeMasses<Real>>& masses, const std::vector<double>& modulus,
                                   const std::vector<GraspSpring<Real>>& grasps, Contacts& contacts, ThreadTeam& team,
                                   const SolverSettings& solver, InstructionSet instruction_set)
    : free(nonzero(masses->inverse), held_coordinates(*model, masses->inverse)),
      mass(thrice(free, masses->lumped)),
      body(elastic, model, masses, free, grasps, contacts, team),
      linear_mesh(model->midedges.empty() ? std::nullopt
                                          : std::optional<TetMesh>(subdivided(model->mesh, model->midedges))),
      pattern(linear_mesh ? quadratic_pattern(model->mesh, model->midedges) : QuadraticPattern()),
      linear(free, linear_mesh ? *linear_mesh : model->mesh, linear_mesh ? repeated(modulus, 8) : modulus, mass,
             preconditioner_of(solver, free.node.size()), solver.projection, team, linear_mesh ? &pattern : nullptr,
             instruction_set),
      step(body, mass, free) {}

template <class Real>
bool ImplicitState<Real>::keep_elements(const TetMesh& mesh, const std::vector<int>& elements,
                                        const std::vector<Real>& masses) {
  mass = thrice(free, masses);
  motions.reset();
  h_before = 0;  // BDF2 starts anew
  body.elements_changed();
  return !equilibrium && linear.keep_elements(mesh, elements);
}

template <class Real>
const RigidMotions& ImplicitState<Real>::rigid_motions(const Model<Real>& model) {
  if (!motions) motions.emplace(model.mesh, model.midedges, mass);
  return *motions;
}

template <class Real>
ImplicitSnapshot<Real> ImplicitState<Real>::snapshot() const {
  return {free,
          body.snapshot(),
          x_before,
          v_before,
          h_before,
          unbalanced,
          linear.snapshot(),
          equilibrium ? std::optional(equilibrium->snapshot()) : std::nullopt};
}

template <class Real>
void ImplicitState<Real>::restore(const ImplicitSnapshot<Real>& snapshot) {
  free = snapshot.free;  // with the nodes that have lost all elements since it was made: they have no mass
  body.restore(snapshot.body);
  x_before = snapshot.x_before;
  v_before = snapshot.v_before;
  h_before = snapshot.h_before;
  unbalanced = snapshot.unbalanced;
  linear.restore(snapshot.linear);
  if (snapshot.equilibrium) equilibrium.emplace(body, linear, mass, free, *snapshot.equilibrium);
}

template struct ImplicitState<float>;
template struct ImplicitState<double>;

std::vector<double> preconditioner_moduli(const TetMesh& mesh, const std::vector<int>& material_of,
                                          const std::vector<RegionMaterial>& materials, Minimiser minimiser) {
  std::vector<double> moduli;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Material& material = materials[static_cast<std::size_t>(material_of[t])].material;
    const SmallStrainModuli rest = small_strain_moduli(material);
    if (rest.shear > 0) {
      // Conjugate gradients weigh directions for themselves; the steps of L-BFGS are as long as this says.
      moduli.push_back(minimiser == Minimiser::lbfgs ? rest.bulk + 4 * rest.shear / 3 : rest.shear);
      continue;
    }
    // A net of springs: k over a length is a modulus.
    const Tet& tet = mesh.tets[t];
    const auto X = [&](std::size_t c) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(tet[c])]; };
    moduli.push_back(material.parameters[0] / std::cbrt(signed_volume(X(0), X(1), X(2), X(3))));
  }
  return moduli;
}

namespace {

/// Whether no rigid motion leaves all these coordinates of points (m) where they are.
bool holds_all_rigid_motions(const std::vector<std::pair<Vec3, AxisSet>>& held) {
  if (held.empty()) return false;
  const Vec3& origin = held[0].first;
  double size = 0;
  for (const auto& [X, axes] : held) size = std::max(size, (X - origin).norm());
  if (!(size > 0)) return false;
  Eigen::Matrix<double, 6, 6> sum = Eigen::Matrix<double, 6, 6>::Zero();
  for (const auto& [X, axes] : held)
    for (int i = 0; i < 3; ++i) {
      if (!axes.has[static_cast<std::size_t>(i)]) continue;
      Eigen::Matrix<double, 6, 1> row;  // of translations, and of rotations by an angle of 1 over the size
      row << Vec3::Unit(i), ((X - origin) / size).cross(Vec3::Unit(i));
      sum += row * row.transpose();
    }
  const auto values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>(sum, Eigen::EigenvaluesOnly)
                          .eigenvalues();
  return values[0] > 1e-12 * values[5];
}

}  // namespace

template <class Real>
bool is_well_constrained(const Model<Real>& model, const std::vector<ConstrainedNode>& constrained) {
  const TetMesh& mesh = model.mesh;
  const std::vector<int> part = connected_parts(mesh, model.midedges);
  std::vector<std::vector<std::pair<Vec3, AxisSet>>> held(mesh.nodes.size());  // at the node that stands for their part
  for (const ConstrainedNode& h : constrained)
    held[static_cast<std::size_t>(part[static_cast<std::size_t>(h.node)])].emplace_back(
        mesh.nodes[static_cast<std::size_t>(h.node)], h.axes);
  std::vector<bool> looked_at(mesh.nodes.size(), false);
  for (const Tet& tet : mesh.tets) {
    const auto here = static_cast<std::size_t>(part[static_cast<std::size_t>(tet[0])]);
    if (looked_at[here]) continue;
    looked_at[here] = true;
    if (!holds_all_rigid_motions(held[here])) return false;
  }
  return true;
}

template bool is_well_constrained(const Model<float>&, const std::vector<ConstrainedNode>&);
template bool is_well_constrained(const Model<double>&, const std::vector<ConstrainedNode>&);

}  // namespace heml
