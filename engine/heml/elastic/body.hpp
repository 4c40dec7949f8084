#pragma once
// The elastic part of a body: one group of elements per material, each with its energy terms; springs along edges and
// averaged nodal pressure, which couple elements; and the sum of all forces at the nodes.
//
//   forces(x):  laws that fans have, with their terms ──► fans ──► nodes ──► + springs
//               others ──► corner forces ──► added at nodes ─┘
//
// Nodal pressure comes with the fans if they have all elements, else with the corner forces.
//
// With mid-edge nodes the elements inside are the integration points of quadratic tetrahedra on virtual corners
// (virtual_corners.hpp), four of each; all that goes in or out is of the ten-node elements.
#include <heml/base/shared.hpp>
#include <heml/base/thread_team.hpp>
#include <heml/elastic/active_term.hpp>
#include <heml/elastic/body_layout.hpp>
#include <heml/elastic/element_group.hpp>
#include <heml/elastic/fan_forces.hpp>
#include <heml/elastic/group_term.hpp>
#include <heml/elastic/mean_dilatation.hpp>
#include <heml/elastic/nodal_pressure.hpp>
#include <heml/elastic/node_bounds.hpp>
#include <heml/elastic/plastic_flow.hpp>
#include <heml/elastic/point_kernels.hpp>
#include <heml/elastic/projection.hpp>
#include <heml/elastic/step_weights.hpp>
#include <heml/mesh/edit.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace heml {

class BsrMatrix;
template <class Real>
class ViscoelasticTerm;

/// State of one element, for display.
template <class Real>
struct ElementState {
  Real J;
  Real stretch;    ///< largest principal stretch
  Real von_mises;  ///< Pa, of the Cauchy stress
};

/// Options of ElasticBody.
struct BodyOptions {
  bool continuation = false;
  bool nodal_pressure = false;  ///< needs laws with a volume term, the same one in all materials; of quadratic elements
                                ///< mean dilatation, each material with a volume term of its own
  InstructionSet instruction_set = InstructionSet::best;  ///< of the force kernels; the processor must support it
  double mass_scaling = 0;                                ///< share of the body's mass that mass_factors() may add
  int threads = 0;                                        ///< that build the layout of a large body; 0: one per core
};

/// The force kernel of one material.
struct KernelInfo {
  std::size_t material;  ///< index into the body's materials
  std::string law;
  std::string kernel;  ///< "fans": fan kernels; "points": point kernels, or the loops that replace them; "corners":
                       ///< loops over corner forces; "fans and corners": fan kernels, loops for nodal pressure;
                       ///< "springs": along edges
  std::string_view instructions;  ///< "portable", "avx2", "avx512"
  std::size_t elements;
  double bytes_per_tet;  ///< read and written in one force evaluation, each array counted once; 0 for springs
};

/// Snapshot of a body: materials and internal state, and what steps do not change, which it shares with the body.
template <class Real>
struct BodySnapshot {
  struct Part {
    std::size_t material;
    Shared<ElementGroup<Real>> group;       ///< at rest: before any plastic flow
    std::vector<std::vector<Real>> values;  ///< internal state of the slots
  };
  Shared<BodyLayout<Real>> layout;
  std::vector<Part> parts;
  std::vector<Material> materials;
  FanForces<Real> fans;
  double plastic_work = 0;  ///< J
  Real step = 0;            ///< s, of the last begin_step()
  double activation = 1;    ///< of the last set_activation()
  std::shared_ptr<const StepWeights<Real>> step_weights;
  std::size_t bytes() const;
};

/// Internal state of all slots, while elements and materials stay the same.
template <class Real>
struct InternalState {
  std::vector<std::vector<Real>> values;  ///< of each list of each part
  double plastic_work = 0;                ///< J
};

/// Calls on one body must not overlap, since they share scratch arrays; each distributes its work over the given team.
template <class Real>
class ElasticBody {
 public:
  /// mesh: in inner order, positive volumes, with the fields that the materials name. material_of: #T, indices into
  /// materials; a material without elements gets no group. The body is at rest, without history. midedges: of quadratic
  /// elements, which take no springs; they are edited by transfer_state() alone (asserted).
  ElasticBody(const TetMesh& mesh, const std::vector<int>& material_of, const std::vector<Material>& materials,
              BodyOptions options, const MidEdges& midedges = {});
  /// As the body of a snapshot was, which had the same options. x: positions then, 3 #V, m.
  ElasticBody(const BodySnapshot<Real>& snapshot, BodyOptions options, const Real* x);
  ElasticBody(const ElasticBody&) = delete;
  ElasticBody& operator=(const ElasticBody&) = delete;

  /// Writes the forces (N) at positions x (3 #V, m) into f (3 #V, overwritten). Returns whether every law is defined at
  /// x.
  bool forces(const Real* x, Real* f, ThreadTeam& team);

  /// The kernels that forces() runs, one entry per material that has elements. The work of nodal pressure and springs
  /// is not counted.
  std::vector<KernelInfo> kernels() const;

  /// Evaluates the stiffness K = ∂²U/∂x² (N/m) at x, for the calls below until the next linearise().
  void linearise(const Real* x, ThreadTeam& team);
  /// Projects the part of K of every element and spring to positive semidefinite (projection.hpp); `none` and `shift`
  /// do nothing. What averaged nodal pressure couples is not projected.
  void project(Projection projection, ThreadTeam& team);
  /// Writes −K dx (N), the change of the forces with a change dx of the positions, into out (3 #V, overwritten).
  void force_differential(const Real* dx, Real* out, ThreadTeam& team);

  /// Makes `rows`, which is of the same elements, K between free nodes. Returns false and changes nothing with averaged
  /// nodal pressure, which couples nodes that share no element.
  bool assemble(BsrMatrix& rows, ThreadTeam& team) const;

  /// Calls visit(nodes (4 inner numbers), K (12×12)) for every element, or visit(nodes (10), K (30×30)) for quadratic
  /// ones. With nodal pressure, K includes an approximation that couples the nodes of the element alone.
  template <class Visit>
  void each_stiffness(const Visit& visit) {
    if constexpr (std::is_invocable_v<const Visit&, const std::array<int, 10>&, const QuadraticMatrix<Real>&>)
      if (layout_->virtual_corners) return each_quadratic_stiffness(visit);
    for (std::size_t p = 0; p < parts_.size(); ++p)
      for (std::size_t s = 0; s < parts_[p].group->size(); ++s) {
        ElementMatrix<Real> K = {};
        element_stiffness(p, s, K);
        const auto& node = parts_[p].group->node;
        visit(std::array<int, 4>{node[0][s], node[1][s], node[2][s], node[3][s]}, K);
      }
  }
  /// Calls visit(node a, node b, 3×3 block B) for every spring: its part of K is [B −B; −B B].
  template <class Visit>
  void each_spring_stiffness(const Visit& visit) const {
    layout_->joints.springs.each_stiffness(linearisation_point_.data(), projected_, visit);
  }

  /// Stored elastic energy, J: V W of every element, springs and nodal pressure; viscosity and relaxation store none.
  double energy(const Real* x, ThreadTeam& team);
  /// The part of it that is the potential of active stress, J: below 0 where muscle has shortened, so it says nothing
  /// about how much a body is deformed.
  double active_energy(const Real* x, ThreadTeam& team);
  /// The potential U of forces() = −∇U, J: energy() plus the incremental potential of viscosity and relaxation for the
  /// step of the last begin_step().
  double potential(const Real* x, ThreadTeam& team);

  /// Upper bound of ω² (1/s²), the largest eigenvalue of M⁻¹K at x (step_bound.hpp); NaN where a law is undefined.
  Real frequency_bound(const Real* x, ThreadTeam& team);
  /// Upper bound of the largest eigenvalue of M⁻¹D (1/s), D the viscous damping matrix at x.
  Real damping_bound(const Real* x, ThreadTeam& team);
  /// The same `steps` after their last evaluation with the same `nodes`, at those alone that may have the largest
  /// since; where that is below `bearable` (1/s²), it may be the one of an earlier state.
  Real frequency_bound(const Real* x, ThreadTeam& team, NodeBounds<Real>& nodes, int steps, Real bearable = 0);
  Real damping_bound(const Real* x, ThreadTeam& team, NodeBounds<Real>& nodes, int steps);
  /// Which element adds most to the bound at a node in the last evaluation of all nodes, inner number, and how large
  /// its part of it is, to 1; −1 if no element adds anything.
  struct Contribution {
    int element = -1;
    double share = 0;
  };
  Contribution largest_contribution(std::size_t node) const;

  /// Size of all arrays, in bytes.
  std::size_t bytes() const;

  /// Lowest inner number of an element outside the range of its law or with non-finite tensions; −1 if there is none.
  /// It may be −1 although forces() returned false, whose kernels round differently.
  int first_undefined(const Real* x) const;

  /// Writes the state of every integration point at x into out (#T in inner order, resized): one an element, or the
  /// four of each quadratic element in turn.
  void states(const Real* x, std::vector<ElementState<Real>>& out) const;
  /// The same of signed volume ratios alone, at a small part of the cost.
  void volume_ratios(const Real* x, std::vector<Real>& out) const;

  /// Elastic first Piola–Kirchhoff stress of every integration point, as states(), Pa, from its corner forces: P = −1/V
  /// Σ_a f_a ⊗ X_a. Springs, viscosity and relaxation do not contribute.
  std::vector<Mat3> stresses(const Real* x, ThreadTeam& team);
  /// Deformation gradients of every integration point, as states().
  std::vector<Mat3> deformation_gradients(const Real* x) const;
  std::size_t points_per_element() const { return layout_->virtual_corners ? element_points : 1; }
  bool has_springs() const { return !layout_->joints.springs.empty(); }

  /// Replaces a material. Its elements lose their internal state and are taken as relaxed at x; those of other
  /// materials keep theirs. plastic_work() keeps the work done so far in all of them.
  void set_material(std::size_t index, const Material& material, const Real* x);
  /// Sets the active stress of a material, Pa, which must have a fibre if it is not 0 (asserted). Its elements keep
  /// their internal state.
  void set_active_stress(std::size_t index, double stress);
  /// Sets the part of every active stress that acts: static worlds ramp it with their loads. 1 at the start.
  void set_activation(double part);
  double activation() const { return activation_; }
  /// Elements have other materials: materials, those there are and more; material_of: #T. One that loses elements keeps
  /// the internal state of the rest; one that gains some is taken as relaxed at x altogether.
  void set_material_of(const std::vector<Material>& materials, const std::vector<int>& material_of, const Real* x);

  /// Heat has changed rest shapes: burns, #T. Masses, positions and internal state stay, with the flow of plasticity.
  /// Bounds of frequencies take an element's mass for ρ V of the smaller rest shape: steps are shorter than need be.
  void set_burns(const std::vector<Burn>& burns);

  /// Removes all but the given elements (inner numbers, ascending; at least one) and renumbers those in that order.
  /// They keep their internal state. Forces equal those of a body built from these elements alone to round-off, since
  /// fan blocks that lose no element keep their layout (fan_layout.hpp).
  void keep_elements(const std::vector<int>& elements);
  /// Replaces the mesh by one with the same nodes and further ones. Element t is the old element origins[t] or a piece
  /// of it; it has the same material and inherits the internal state. Fan blocks without changed elements keep their
  /// layout. Quadratic elements: with the mesh's mid-edge nodes and the present positions x (3 #V, m). A point of
  /// a piece inherits from the nearest one of the whole how its state differs from a state at x.
  void transfer_state(const TetMesh& mesh, const std::vector<int>& material_of, const std::vector<int>& origins,
                      const MidEdges& midedges = {}, const Real* x = nullptr);
  /// Snapshot for restore(), which reproduces the present state to the bit.
  BodySnapshot<Real> snapshot();
  /// Restores the elements and the state of a snapshot. Elements whose material has changed since lose their internal
  /// state and are taken as relaxed at x.
  void restore(const BodySnapshot<Real>& snapshot, const Real* x);
  /// Restores the materials of the snapshot too: nothing is lost.
  void restore_all(const BodySnapshot<Real>& snapshot, const Real* x);
  /// Replaces the mesh; the body is then as after construction.
  void set_mesh(const TetMesh& mesh, const std::vector<int>& material_of);

  // Internal state (viscosity, relaxation, plasticity). begin_step() starts a step of h seconds (0: no time passes;
  // infinite: fully relaxed); commit() stores the state reached at x; reset_history() discards the state and takes x as
  // relaxed.
  bool has_internal_state() const;
  void begin_step(Real h);
  void commit(const Real* x);
  void reset_history(const Real* x);
  InternalState<Real> internal_state();
  /// Goes back to a state of this body with its present elements and materials (sizes asserted), to round-off.
  void set_internal_state(const InternalState<Real>& state);
  /// Until end_flow_trial() rest shapes are those that plastic flow to x gives (plastic_flow.hpp), for forces(),
  /// potential() and linearise() at x. Not of materials with viscosity or relaxation too, which flow after steps alone:
  /// without others flows_within_steps() is false, and a trial changes nothing.
  bool flows_within_steps() const;
  void begin_flow_trial(const Real* x, ThreadTeam& team);
  void end_flow_trial();
  double plastic_work() const { return plastic_work_; }  ///< J, of all elements since the last reset_history()

  /// Lumped masses (#V, kg), which are positive: each tetrahedron's density × volume as meshed / 4 on its nodes; of
  /// quadratic ones 1/36 on corners and 4/27 on mid-edge nodes.
  std::vector<Real> masses() const;
  /// What they are multiplied by with options().mass_scaling, #V, 1 or more; empty: 1. Bounds of frequencies and
  /// damping are of the masses that come out.
  const std::vector<Real>& mass_factors(ThreadTeam& team);
  /// ∫ρN of each node (#V, kg), which gravity acts on: that of quadratic elements is negative on corners; of linear
  /// ones, masses().
  std::vector<Real> consistent_masses() const;

  std::size_t nodes() const { return layout_->nodes(); }
  const std::vector<Material>& materials() const { return materials_; }
  const BodyOptions& options() const { return options_; }
  std::size_t elements() const { return layout_->mesh.tets.size() / points_per_element(); }

 private:
  struct Part {
    std::size_t material;
    Shared<ElementGroup<Real>> group;  ///< a body's own if plastic flow changes its rest shapes
    std::vector<std::unique_ptr<GroupTerm<Real>>> terms;
    std::unique_ptr<PlasticFlow<Real>> flow;
    std::unique_ptr<MeanDilatation<Real>> dilatation;  ///< null: the points have all of the volume term
    std::vector<Real> stiffness;                       ///< of every element (edge_stiffness.hpp), filled by linearise()
    bool in_fans;                                      ///< fans_ evaluates the forces of all terms
    PointForces<Real> points;                          ///< of all terms, if it has a kernel
    ViscoelasticTerm<Real>* memory = nullptr;          ///< one of the terms, or null
    ActiveTerm<Real>* active = nullptr;                ///< the last of the terms, or null
    bool flows_within_steps = false;                   ///< of implicit methods; else after them

    Shared<ElementGroup<Real>> group_at_rest() const { return flow ? flow->at_rest(*group) : group; }
    bool in_points() const { return points.kernel != nullptr; }
    /// The first of the terms whose forces are those of loops.
    std::size_t first_loop() const { return in_fans || in_points() ? terms.size() : 0; }
    PointTerms<Real> terms_of_points() const;
    SlotStates<Real> slot_states();     ///< of all terms and the flow
    void reset_history(const Real* x);  ///< of all terms and the flow
    bool has_loops(bool nodal_pressure) const { return terms.size() > first_loop() || nodal_pressure; }
  };
  static constexpr std::size_t grain_ = 2048;       ///< min. elements per thread, which outweigh the cost of waking it
  static constexpr std::size_t large_body_ = 8192;  ///< elements from which a team builds the layout

  std::vector<Real> at_rest() const;
  void set_elements(const TetMesh& mesh, const std::vector<int>& material_of, const MidEdges& midedges);
  void make_parts();
  void set_active_term(Part& part, double stress) const;
  Part make_part(std::size_t material, const std::vector<int>& elements) const;
  Part make_part(std::size_t material, Shared<ElementGroup<Real>> at_rest) const;
  Part remake_part(std::size_t material, const Material& before, Shared<ElementGroup<Real>> at_rest) const;
  void join_parts();
  std::vector<FanPart> fan_parts() const;
  std::vector<FanSlots<Real>> fan_slots() const;
  bool pressure_in_fans() const;
  void flow(const Real* x, bool fans_know);
  void put_rest_shapes(std::size_t in_fans, const Part& part, std::span<const std::size_t> slots);
  void put_trial_in_fans();
  void update_slots() const;
  ThreadTeam layout_team() const { return ThreadTeam(layout_->mesh.tets.size() < large_body_ ? 1 : options_.threads); }
  void make_fans();
  void update_fans(const TetMesh& before, const std::vector<int>& origins);
  std::size_t number_corners();
  CornerMap force_corners(const CornerMap& all) const;
  std::vector<double> spring_stiffness() const;
  void make_pressure();
  void keep_numbered(Part& part, const std::vector<int>& number);
  /// Of quadratic elements in an edit: which points are of pieces (4 #T), and all virtual corners before and after.
  struct PointsInEdit {
    std::vector<bool> is_of_piece;
    std::vector<Real> before, after;
  };
  std::vector<int> point_origins(const TetMesh& mesh, const VirtualCorners<Real>& whole,
                                 const std::vector<int>& element_origins, std::vector<bool>& is_of_piece) const;
  void transfer_slot_states(const Part& old, const TetMesh& before, const std::vector<int>& origins,
                            const PointsInEdit& points, Part& part) const;
  /// 3 a corner, N: scratch, made on first use, since fans alone do without it.
  std::vector<Real>& corner_forces() {
    corner_.resize(3 * layout_->joints.corner_count);
    return corner_;
  }
  /// 3 a node of each quadratic element, N (VirtualCorners::sum()): scratch.
  Real* nodal_forces() {
    of_element_.resize(30 * layout_->virtual_corners->elements());
    return of_element_.data();
  }
  bool virtual_corner_forces(const Real* x, Real* f, bool add, ThreadTeam& team);
  bool quadratic_forces(const Real* x, Real* f, ThreadTeam& team);
  /// Whether kernels of points write what commit() asks for: the next state, or what is beyond yield.
  bool points_remember() const;
  void evaluate_points(const Real* x);
  void gather_corners(const CornerMap& corners, Real* f, bool add, ThreadTeam& team) const;
  double sum_energies(const Real* x, bool stored, ThreadTeam& team);
  void element_stiffness(std::size_t part, std::size_t s, ElementMatrix<Real>& K) const;
  void quadratic_stiffness(std::size_t part, std::size_t first_slot, QuadraticMatrix<Real>& K) const;
  template <class Visit>
  void each_quadratic_stiffness(const Visit& visit) const {
    for (std::size_t p = 0; p < parts_.size(); ++p)
      for (std::size_t s = 0; s < parts_[p].group->size(); s += element_points) {
        QuadraticMatrix<Real> K = {};
        quadratic_stiffness(p, s, K);
        visit(
            layout_->virtual_corners->nodes_of(static_cast<std::size_t>(parts_[p].group->element[s]) / element_points),
            K);
      }
  }
  /// Positions of the nodes of the elements inside: of virtual corners, valid until the next call, or x itself.
  const Real* inner_positions(const Real* x, ThreadTeam& team) {
    if (!layout_->virtual_corners) return x;
    layout_->virtual_corners->positions(x, virtual_x_, team);
    return virtual_x_.data();
  }
  const Real* inner_positions(const Real* x, std::vector<Real>& y) const {
    if (!layout_->virtual_corners) return x;
    y = layout_->virtual_corners->positions(x);
    return y.data();
  }
  /// Calls work(part, begin, end) for packets of the parts with mean dilatation.
  template <class Work>
  void each_dilatation(ThreadTeam& team, const Work& work) {
    for (Part& part : parts_)
      if (part.dilatation)
        team.parallel_for(part.group->packets(), grain_ / 4 / part.group->lanes,
                          [&](std::size_t begin, std::size_t end) { work(part, begin, end); });
  }
  Real meshed_volume(const ElementGroup<Real>& group, std::size_t s) const;
  std::vector<double> point_masses() const;
  template <class Bound>
  Real max_at_nodes(ThreadTeam& team, NodeBounds<Real>& nodes, int steps, Real bearable, const Bound& bound);
  Real inner_frequency_bound(const Real* x, ThreadTeam& team, NodeBounds<Real>& nodes, int steps, Real bearable = 0);
  void need_step_weights(ThreadTeam& team);
  std::shared_ptr<StepWeights<Real>> step_weights(ThreadTeam& team) const;
  /// Of the nodes of the elements inside; null: virtual corners.
  const Real* corner_weights() const { return layout_->virtual_corners ? nullptr : step_weights_->node.data(); }
  void find_packets(const std::vector<int>& nodes);
  void weigh_bounds(const ElementGroup<Real>& group, std::size_t packet, const Real* bounds);
  Real mean_bound(std::size_t node) const;

  /// Calls visit(part, slot, kinematics, rest shape) for every element.
  template <class Visit>
  void each_slot(const Real* x, const Visit& visit) const {
    update_slots();
    std::vector<Real> y;
    x = inner_positions(x, y);
    for (const Part& part : parts_)
      for (std::size_t s = 0; s < part.group->size(); ++s) {
        const auto rest = rest_shape(*part.group, s);
        visit(part, s, full_kinematics(*part.group, x, s, rest), rest);
      }
  }

  Shared<BodyLayout<Real>> layout_;
  std::vector<Material> materials_;
  BodyOptions options_;
  std::vector<Part> parts_;
  FanForces<Real> fans_;
  std::unique_ptr<NodalPressure<Real>> pressure_;
  std::vector<Real> virtual_x_;            ///< scratch of inner_positions()
  std::vector<Real> corner_;               ///< corner_forces()
  std::vector<Real> of_element_;           ///< nodal_forces()
  std::vector<Real> shared_force_;         ///< 3 a shared slot of the point layout, scratch of forces()
  std::vector<Real> evaluated_x_;          ///< where point kernels wrote the next state
  bool evaluated_ = false;                 ///< whether they did, in this step
  std::vector<Real> linearisation_point_;  ///< 3 a node of the layout's mesh
  bool projected_ = false;                 ///< whether project() was applied
  std::vector<double> packet_energy_;      ///< scratch of energy()
  std::shared_ptr<const StepWeights<Real>> step_weights_;  ///< null: not asked for since elements or materials changed
  std::vector<int> due_packets_;           ///< find_packets()
  std::vector<std::pair<Real, Real>> weighted_bound_;  ///< weigh_bounds()
  std::vector<Real> node_volume_;          ///< m³, scratch of forces()
  double plastic_work_ = 0;
  Real step_ = 0;  ///< s, of the last begin_step()
  double activation_ = 1;
  /// Whether the state by slot of the parts in fans is older than that of fans_; update_slots() copies it.
  mutable bool slots_are_old_ = false;
};

/// Lasts as long as a trial of plastic flow to x, or is none.
template <class Real>
class FlowTrial {
 public:
  FlowTrial(ElasticBody<Real>& body, const Real* x, ThreadTeam& team, bool is_none = false)
      : body_(is_none ? nullptr : &body) {
    if (body_) body_->begin_flow_trial(x, team);
  }
  ~FlowTrial() {
    if (body_) body_->end_flow_trial();
  }
  FlowTrial(const FlowTrial&) = delete;
  FlowTrial& operator=(const FlowTrial&) = delete;

 private:
  ElasticBody<Real>* body_;
};

}  // namespace heml
