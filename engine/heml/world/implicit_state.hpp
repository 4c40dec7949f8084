#pragma once
// What implicit and static methods keep of a body between steps: the free nodes, the body as an objective, a linear
// solver with its factors, the step before. Made when first needed, and anew when the material changes.
#include <heml/dynamics/incremental_potential.hpp>
#include <heml/dynamics/linear_solver.hpp>
#include <heml/dynamics/static_solve.hpp>
#include <heml/world/body_objective.hpp>
#include <heml/world/rigid_motions.hpp>
#include <optional>

namespace heml {

/// What steps to come depend on beside the state: the step before, the unknowns, contact, and what solves for them.
template <class Real>
struct ImplicitSnapshot {
  FreeNodes free;
  typename BodyObjective<Real>::Snapshot body;
  Vector x_before, v_before;
  double h_before = 0;
  Vector unbalanced;
  LinearSolver::Snapshot linear;
  std::optional<StaticSolve::Snapshot> equilibrium;
};

template <class Real>
struct ImplicitState {
  FreeNodes free;
  Vector mass;  ///< 3 #V, kg; 0 where not free
  BodyObjective<Real> body;
  std::optional<TetMesh>
      linear_mesh;           ///< of quadratic elements: linear ones on the same nodes, which precondition them
  QuadraticPattern pattern;  ///< of quadratic elements
  LinearSolver linear;
  IncrementalPotential step;
  Vector x, v;                ///< 3 #V, the state in double
  Vector x_before, v_before;  ///< one step earlier, for BDF2
  double h_before = 0;        ///< s; 0: there was none
  /// 3 #V, N, what the last solve of that step left of forces less inertia; empty where the step was put back since
  /// (energy_limit.hpp).
  Vector unbalanced;
  std::optional<StaticSolve> equilibrium;
  std::optional<RigidMotions> motions;  ///< of the parts as they are; see rigid_motions()

  /// modulus: #T, Pa. All references must outlive this.
  ImplicitState(ElasticBody<Real>& elastic, const Shared<Model<Real>>& model, const Shared<NodeMasses<Real>>& masses,
                const std::vector<double>& modulus, const std::vector<GraspSpring<Real>>& grasps, Contacts& contacts,
                ThreadTeam& team, const SolverSettings& solver, InstructionSet instruction_set);
  /// Elements have gone: these are left, by the numbers they had; model (with this mesh) and masses have followed.
  /// Returns false where parts have to be made anew.
  bool keep_elements(const TetMesh& mesh, const std::vector<int>& elements, const std::vector<Real>& masses);
  /// How free parts of this body move as a whole; made when first asked for.
  const RigidMotions& rigid_motions(const Model<Real>& model);
  ImplicitSnapshot<Real> snapshot() const;
  /// Of parts made anew, of the body that it was: they go on as those would have.
  void restore(const ImplicitSnapshot<Real>& snapshot);
  ImplicitState(const ImplicitState&) = delete;
  ImplicitState& operator=(const ImplicitState&) = delete;
};

/// Modulus of each element at rest that the scalar matrix of a linear solver stands for, Pa. material_of: #T.
std::vector<double> preconditioner_moduli(const TetMesh& mesh, const std::vector<int>& material_of,
                                          const std::vector<RegionMaterial>& materials, Minimiser minimiser);

/// Whether every connected part of the body has three held nodes that are not on a line.
template <class Real>
bool is_well_constrained(const Model<Real>& model, const std::vector<ConstrainedNode>& constrained);

}  // namespace heml
