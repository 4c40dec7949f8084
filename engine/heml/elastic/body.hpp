#pragma once
// The elastic part of a body: its groups of elements, each with the terms of its material, and what is not of one
// element alone (springs along edges, averaged nodal pressure); and the sum of their forces at the nodes.
//
//   forces(x):  uniform laws ──► fans ──► nodes ──────────────────────► + springs
//               other terms ──► corner forces ──► added at nodes ─┘
//               nodal pressure ───────┘
#include <heml/base/thread_team.hpp>
#include <heml/elastic/element_group.hpp>
#include <heml/elastic/fan_forces.hpp>
#include <heml/elastic/group_term.hpp>
#include <heml/elastic/nodal_pressure.hpp>
#include <heml/elastic/plastic_flow.hpp>
#include <heml/elastic/projection.hpp>
#include <heml/elastic/springs.hpp>
#include <heml/mesh/edit.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace heml {

class BsrMatrix;

/// What a viewer may want to know of an element.
template <class Real>
struct ElementState {
  Real J;
  Real stretch;    ///< largest principal stretch
  Real von_mises;  ///< Pa, of the Cauchy stress
};

/// How a body is made of its materials.
struct BodyOptions {
  bool continuation = false;
  bool nodal_pressure = false;  ///< needs laws with a volume term, the same one in all materials
  InstructionSet instruction_set = InstructionSet::best;  ///< of the fast kernels; must be one this processor has
  int threads = 0;                                        ///< that lay out a large body; 0: one a core
};

/// What runs the forces of the elements of one material.
struct KernelInfo {
  std::size_t material;  ///< index into the body's materials
  std::string law;
  std::string kernel;  ///< "fans"; "corners": the loops of its terms; "fans and corners": its law, its other terms;
                       ///< "springs": along edges
  std::string_view instructions;  ///< "portable", "avx2", "avx512"
  std::size_t elements;
  double bytes_per_tet;  ///< read and written in one evaluation, each array once; 0 of springs
};

/// What is to be known of a body beside its mesh, to make it anew as it was: its materials, in which order its elements
/// lie, what they remember, how the fast kernels have them laid out.
template <class Real>
struct BodyMemory {
  struct Part {
    std::size_t material;
    std::vector<int> element;               ///< of each slot, inner numbers
    std::vector<std::vector<Real>> values;  ///< what its slots remember (slot_memory.hpp)
  };
  std::vector<Part> parts;
  std::vector<Material> materials;
  FanForces<Real> fans;
  double plastic_work = 0;  ///< J
  Real step = 0;            ///< s, begun last
  std::size_t bytes() const;
};

template <class Real>
class ElasticBody {
 public:
  /// mesh: in inner order. material_of: #T, index into materials. Materials no element has get no group. The body is at
  /// rest, and what it remembers begins there.
  ElasticBody(const TetMesh& mesh, const std::vector<int>& material_of, const std::vector<Material>& materials,
              BodyOptions options);
  ElasticBody(const ElasticBody&) = delete;
  ElasticBody& operator=(const ElasticBody&) = delete;

  /// Forces at positions x (3 #V) into f (3 #V, overwritten), N. Returns whether every law is defined there.
  bool forces(const Real* x, Real* f, ThreadTeam& team);

  /// What forces() runs, a line a material that has elements. Nodal pressure and springs are not among it.
  std::vector<KernelInfo> kernels() const;

  /// Finds the stiffness K = ∂²U/∂x² at x, once for all products with it.
  void linearise(const Real* x, ThreadTeam& team);
  /// Makes every element's part of K positive, in the way named (projection.hpp; none and shift: nothing). Averaged
  /// nodal pressure keeps its own.
  void project(Projection projection, ThreadTeam& team);
  /// −K dx into out (3 #V, overwritten), N: change of the forces with a change dx of the positions.
  void force_differential(const Real* dx, Real* out, ThreadTeam& team);

  /// Adds K to rows between free nodes. Returns false, with nothing added, where they cannot hold it: averaged nodal
  /// pressure couples nodes that share no element.
  bool add_stiffness(BsrMatrix& rows, ThreadTeam& team) const;

  /// Calls visit(nodes (4 inner numbers), K) for every element's part of K in turn. With nodal pressure its part is an
  /// approximation of the element alone.
  template <class Visit>
  void each_stiffness(const Visit& visit) {
    for (std::size_t p = 0; p < parts_.size(); ++p)
      for (std::size_t s = 0; s < parts_[p].group.size(); ++s) {
        ElementMatrix<Real> K = {};
        element_stiffness(p, s, K);
        const auto& node = parts_[p].group.node;
        visit(std::array<int, 4>{node[0][s], node[1][s], node[2][s], node[3][s]}, K);
      }
  }
  /// Calls visit(node a, node b, 3×3 block B) for every spring: its part of K is [B −B; −B B].
  template <class Visit>
  void each_spring_stiffness(const Visit& visit) const {
    springs_.each_stiffness(linearisation_point_.data(), projected_, visit);
  }

  /// Stored elastic energy, J (contract: W of every element).
  double energy(const Real* x, ThreadTeam& team);
  /// What forces() is minus the gradient of, J: with the incremental potential of what remembers, for the step begun.
  double potential(const Real* x, ThreadTeam& team);

  /// Upper bound of ω², 1/s², of small vibrations about x; not a number where a law is not defined.
  Real frequency_bound(const Real* x, ThreadTeam& team);
  /// The same of the damping matrix, 1/s: viscosity.
  Real damping_bound(const Real* x, ThreadTeam& team);

  /// The part of that bound which each element's own terms have, #T in inner order, 1/s²: not nodal pressure, not
  /// springs.
  std::vector<Real> element_bounds(const Real* x) const;

  /// Of all that is kept.
  std::size_t bytes() const;

  /// First element (inner number) out of its law's range, or whose forces are no numbers; −1: none, also where forces()
  /// saw one by its own rounding.
  int first_undefined(const Real* x) const;

  /// #T in inner order.
  void states(const Real* x, std::vector<ElementState<Real>>& out) const;

  /// What is elastic of the first Piola–Kirchhoff stress of every element, #T in inner order, Pa, whatever its terms:
  /// the moment of its corner forces, P = −1/V Σ_a f_a ⊗ X_a. Springs bear none.
  std::vector<Mat3> stresses(const Real* x, ThreadTeam& team);
  bool has_springs() const { return !springs_.empty(); }

  /// Puts another law on the elements of one material, and forgets what they remember.
  void set_material(std::size_t index, const Material& material, const Real* x);

  /// Leaves the given elements (inner numbers, ascending; at least one), numbered anew in that order. What they
  /// remember stays with them; forces are those of a body made of them alone, to round-off: blocks of fans that lose
  /// none keep their layout (fan_layout.hpp).
  void keep_elements(const std::vector<int>& elements);
  /// Another mesh, of the same nodes and further ones: element t is what origins[t] was or a piece of it, and
  /// remembers what that did. Materials as theirs. Blocks of fans that are not touched keep their layout.
  void transfer_state(const TetMesh& mesh, const std::vector<int>& material_of, const std::vector<int>& origins);
  /// What is to be known of the body beside its mesh, to come back to it as it is now, to the bit.
  BodyMemory<Real> memory();
  /// Back to a mesh and what memory() was then. What has another material since has forgotten: it has lasted at x.
  void restore(const TetMesh& mesh, const std::vector<int>& material_of, const BodyMemory<Real>& memory, const Real* x);
  /// Another mesh, at rest, as in the constructor.
  void set_mesh(const TetMesh& mesh, const std::vector<int>& material_of);

  // What remembers (viscosity, relaxation, plasticity), if anything does: a step of length h begins (0: none; infinite:
  // all has relaxed); the positions it reached are kept; all is forgotten.
  bool has_internal_state() const;
  void begin_step(Real h);
  void commit(const Real* x);
  void reset_history(const Real* x);
  double plastic_work() const { return plastic_work_; }  ///< J, since forget()

  /// Lumped masses (#V, kg): each tetrahedron's density × volume / 4 on its nodes.
  std::vector<Real> masses() const;

  std::size_t nodes() const { return corners_.start.size() - 1; }
  std::size_t elements() const { return mesh_.tets.size(); }

 private:
  struct Part {
    std::size_t material;
    ElementGroup<Real> group;
    std::vector<std::unique_ptr<GroupTerm<Real>>> terms;
    std::unique_ptr<PlasticFlow<Real>> flow;
    std::vector<Real> stiffness;  ///< of every element (edge_stiffness.hpp), once it was asked for
    bool in_fans;                 ///< its law's forces are run by fans_, not by the first of its terms

    std::size_t first_loop() const { return in_fans ? 1 : 0; }  ///< of its terms
    SlotMemories<Real> memory();                                ///< of all of them
    bool has_loops(bool nodal_pressure) const { return terms.size() > first_loop() || nodal_pressure; }
  };
  static constexpr std::size_t grain_ = 2048;       ///< elements below which waking a thread costs more than it brings
  static constexpr std::size_t large_body_ = 8192;  ///< elements from which laying them out is worth a team

  std::vector<Real> at_rest() const;
  void make_parts();
  Part make_part(std::size_t material, const std::vector<int>& elements) const;
  void join_parts();
  std::vector<FanPart> fan_parts() const;
  ThreadTeam layout_team() const { return ThreadTeam(mesh_.tets.size() < large_body_ ? 1 : options_.threads); }
  void make_fans();
  void update_fans(const TetMesh& before, const std::vector<int>& origins);
  void make_shared();
  void keep_numbered(Part& part, const std::vector<int>& number);
  void transfer_memory(const Part& old, const TetMesh& before, const std::vector<int>& origins, Part& part) const;
  void gather_corners(const CornerMap& corners, Real* f, bool add, ThreadTeam& team) const;
  double sum_energies(const Real* x, bool stored, ThreadTeam& team);
  void element_stiffness(std::size_t part, std::size_t s, ElementMatrix<Real>& K) const;
  template <class Bound>
  Real max_bound(ThreadTeam& team, const Bound& bound) const;

  /// Calls visit(part, slot, whole link, rest shape) for every element.
  template <class Visit>
  void each_slot(const Real* x, const Visit& visit) const {
    for (const Part& part : parts_)
      for (std::size_t s = 0; s < part.group.size(); ++s) {
        const auto rest = rest_shape(part.group, s);
        visit(part, s, full_kinematics(part.group, x, s, rest), rest);
      }
  }

  TetMesh mesh_;  ///< inner order
  std::vector<int> material_of_;
  std::vector<Material> materials_;
  BodyOptions options_;
  std::vector<Part> parts_;
  FanForces<Real> fans_;
  CornerMap corners_;        ///< of all parts
  CornerMap force_corners_;  ///< of those that are not in fans
  Springs<Real> springs_;
  std::unique_ptr<NodalPressure<Real>> pressure_;
  std::vector<Real> corner_;               ///< 3 a corner, written and read within forces()
  std::vector<Real> linearisation_point_;  ///< 3 #V
  bool projected_ = false;                 ///< whether what was found there has been made positive
  std::vector<double> packet_energy_;      ///< written and read within energy()
  double plastic_work_ = 0;
  Real step_ = 0;  ///< s, begun last
};

}  // namespace heml
