#pragma once
// All data of a running world of one scalar type, and the operations that every phase of a tick shares. Phases
// (explicit_stepper.hpp, implicit_stepper.hpp, static_stepper.hpp, recovery_controller.hpp, mesh_editor.hpp,
// command_executor.hpp, method_choice.hpp) and queries (world_queries.hpp) each hold a reference to one Simulation.
//
//   setup ──► model (inner order) ──► body         not changed by steps (but for the body's internal state), shared by
//                                                  worlds of one scene and their snapshots (base/shared.hpp)
//   SimulationState: masses, tools, positions,     plain values, copied by snapshots (simulation_snapshot.hpp)
//   step limit, counters
//   implicit, recovery                             made when needed; snapshots copy what steps to come depend on
//
// Nodes and elements are in inner order (mesh/reorder.hpp) unless a comment says mesh-file order.
#include <atomic>
#include <heml/base/shared.hpp>
#include <heml/base/thread_team.hpp>
#include <heml/dynamics/state.hpp>
#include <heml/elastic/body.hpp>
#include <heml/tools/contact_impulses.hpp>
#include <heml/tools/grasp.hpp>
#include <heml/tools/pin.hpp>
#include <heml/world/implicit_state.hpp>
#include <heml/world/model.hpp>
#include <heml/world/node_masses.hpp>
#include <heml/world/recovery_state.hpp>
#include <heml/world/world.hpp>
#include <memory>
#include <optional>
#include <vector>

namespace heml {

/// The longest stable step of explicit methods, and when to evaluate it again (stable_step.hpp).
struct StepLimit {
  double stable = 0;          ///< s, safety factor included
  double found = 0;           ///< s, at the last evaluation; stable follows it down at once, up slowly
  double at_start = 0;        ///< s, at the start or the last Reset
  int steps_since_bound = 0;  ///< steps since the frequency bound was evaluated
  int interval = 0;           ///< steps until it is evaluated again
  /// s: a step was too long for an element (step_strain.hpp), and later ones grow
  double of_strain = std::numeric_limits<double>::infinity();
  int steps_to_strain = 0;    ///< until that of all small elements and those at contacts is looked at again
  std::vector<char> touched;  ///< of each node, whether it was at a contact since the last such look
  std::vector<long> watched;  ///< serial numbers of the grasps near which every element is evaluated each time
};

/// The values of a simulation that a tick or a command changes and that refer to nothing else: whoever adds one adds it
/// to snapshots.
template <class Real>
struct SimulationState {
  std::vector<EditReport> edits;          ///< since the start or the last Reset, without undone ones
  std::vector<GraspSpring<Real>> grasps;  ///< ascending hands, one each; an empty list costs nothing
  long grasps_taken = 0;                  ///< so far: the serial number of the last
  std::vector<PinnedPatch> pins;          ///< in the order they were set
  Contacts contacts;                      ///< empty in most worlds
  ContactImpulses<Real> impulses;

  bool has_internal_state = false;  ///< whether a material has viscosity, relaxation or plasticity
  Shared<NodeMasses<Real>> masses;  ///< made anew when elements or constraints change
  State<Real> state;
  Motion<Real> last_valid;  ///< before the current step

  Real rest_frequency = 0;  ///< 1/s, bound of the highest frequency at rest: scales the tools
  StepLimit limit;
  NodeBounds<Real> frequency_bounds, damping_bounds;  ///< of acting_body(), behind the limit
  long ticks = 0, steps = 0;
  long origin_tick = 0;            ///< tick of the start, the last Reset, or the last change of the rate
  double origin_time = 0;          ///< s, state.time at origin_tick
  long rate_tick = 0;              ///< tick of the start or the last change of the rate
  double elapsed_before_rate = 0;  ///< s, elapsed() at rate_tick
  long explicit_until = -1;        ///< tick up to which a rescue goes on (step_rescue.hpp); −1: there was none
  int substeps = 0;                ///< of the last tick
  long changes = 0;           ///< steps, loads and commands other than edits: unchanged, nothing but edits has happened
  long condition_changes = 0;  ///< commands that set boundary or loads
  long region_changes = 0;     ///< commands that made elements a region
  bool is_evaluated = false;  ///< whether forces and stable step belong to the state (restored by an undo)
  std::optional<StopReason> halt;
  bool unfinished = false;
  Integrator method = Integrator::verlet;  ///< in use: the choice of "auto", else the scene's
  std::optional<double> lowest_frequency;  ///< 1/s, at rest; computed on demand
  std::optional<double> step_cost;         ///< s, given: of an explicit step, per element, on one core
  SolverStats stats;
};

template <class Real>
struct SimulationSnapshot;

template <class Real>
struct Simulation : SimulationState<Real> {
  /// Throws InputError as make_world().
  explicit Simulation(WorldSetup setup);
  /// That of a snapshot, with which it shares what steps do not change.
  explicit Simulation(const SimulationSnapshot<Real>& snapshot);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Masses and inverse masses from the body and the constraints.
  void update_masses();
  /// Sets constrained and pinned nodes to their prescribed positions and velocities at state.time.
  /// moving_alone: of the constrained ones only those whose supports move at some time; a step leaves the others where
  /// they are.
  void move_constrained(bool moving_alone = false);
  /// Writes the forces of all but supports at the current state to state.f. Returns false where a law is undefined.
  bool evaluate_forces();
  /// Part of gravity and active stress that acts: below 1 in static worlds alone, which ramp all loads.
  double load() const;
  /// m/s².
  Vec3 gravity() const;
  Energies energies();
  /// Stores the result of a solve. Forces are those that its objective evaluated last. x, v: 3 #V.
  void set_state(const Vector& x, const Vector& v, double time);
  /// Solver data of implicit and static methods, built on first use.
  ImplicitState<Real>& implicit_state();
  /// Nodes constrained by the scene's boundary entries and by pins.
  std::vector<ConstrainedNode> constrained_nodes() const;
  std::vector<Vec3> in_file_order(const std::vector<Real>& values) const;
  std::vector<Vec3> positions() const { return in_file_order(state.x); }  ///< #V×3, metres, mesh-file order
  std::size_t node_count() const { return masses->lumped.size(); }
  bool recovering() const { return recovery && recovery->surrogate; }
  /// The body that steps: the recovery surrogate while a recovery is under way.
  ElasticBody<Real>& acting_body() { return recovering() ? recovery->surrogate->body : body; }
  bool is_stopped() const { return halt || interrupted; }
  /// Simulated seconds since the start, at the rates there were; not reset by Reset.
  double elapsed() const {
    return this->elapsed_before_rate + static_cast<double>(this->ticks - this->rate_tick) * setup->solver.tick();
  }

  /// Makes the surrogate of a recovery for the present mesh, materials and constraints.
  void install_surrogate();

  /// The elements take the regions of the setup's mesh, and their materials.
  void update_regions();

  /// Takes the setup's tables, which rise into tissue that is where they are put.
  void place_tables();
  /// From where a table that is put to its place now rises.
  void find_rise(PlacedTable& placed) const;
  /// Rebuilds what depends on the list of contact surfaces or on the boundary of the mesh.
  void update_contact_surfaces();
  /// Rebuilds self-contact for the current elements.
  void update_self_contact();
  /// Collects the free boundary nodes, and boundary faces for tools smaller than a face.
  void update_contact_boundary();

  using Values = SimulationState<Real>;
  using Values::contacts, Values::grasps, Values::halt, Values::has_internal_state, Values::impulses;
  using Values::last_valid, Values::masses, Values::method, Values::pins, Values::state;

  Shared<WorldSetup> setup;
  Shared<Model<Real>> model;
  std::shared_ptr<const Topology> topology;
  ElasticBody<Real> body;
  ThreadTeam team;

  std::atomic<bool> interrupted{false};
  std::unique_ptr<ImplicitState<Real>> implicit;  ///< null until an implicit or static method needs it
  std::unique_ptr<RecoveryState<Real>> recovery;  ///< null unless the scene asks for it
};

/// A copy in double, 3 #V.
template <class Real>
Vector as_vector(const std::vector<Real>& values) {
  return Eigen::Map<const Eigen::Matrix<Real, Eigen::Dynamic, 1>>(values.data(),
                                                                  static_cast<Eigen::Index>(values.size()))
      .template cast<double>();
}

}  // namespace heml
