#pragma once
// A simulated body: an immutable model and its mutable state behind one interface, the same for float and double and
// for every mix of laws. One calling thread at a time; results are bit-identical for any number of threads inside.
//
// Everything goes in and comes out in the mesh file's node and element order; inside both are reordered for locality.
#include <cstdint>
#include <heml/base/status.hpp>
#include <heml/elastic/error_estimate.hpp>
#include <heml/mesh/edit.hpp>
#include <heml/world/command.hpp>
#include <heml/world/recovery.hpp>
#include <heml/world/setup.hpp>
#include <heml/world/solver_stats.hpp>
#include <heml/world/tool_state.hpp>
#include <heml/world/world_snapshot.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace heml {

/// Effects of an edit of the mesh: a removal, the sweeps of a stroke of a blade or an electrode, or a tear so far.
struct EditReport {
  long tick = 0;                           ///< at whose start it began
  std::size_t removed = 0;                 ///< elements that are lost
  double mass = 0;                         ///< kg that went
  Energies before, after;                  ///< of the whole body
  double step_before = 0, step_after = 0;  ///< s, stable steps
  // Of a cut:
  std::size_t split = 0;   ///< elements, into
  std::size_t pieces = 0;  ///< so many
  double area = 0;         ///< m², of one side of the cut or tear, in the deformed shape
  double min_angle = 0;    ///< degrees, dihedral, of the worst piece at rest
  std::size_t torn = 0;    ///< of a tear: faces that have come apart
  std::size_t burnt = 0;   ///< of an electrode: elements that heat has reached
};

/// Why a world has stopped. Its state is the last valid one.
struct StopReason {
  enum class Cause { out_of_range, unstable, not_converged };
  Cause cause;
  int element = -1;     ///< the first element out of range, mesh-file order; -1: none to name
  int node = -1;        ///< the first node that ran away, mesh-file order; -1: none to name
  std::string message;  ///< one sentence for people, with what to do
};

/// Scalars a viewer may ask for, one a node (element values averaged by volume). field_list.hpp says what each is.
enum class Field {
  none,
  displacement,  ///< m, distance from the rest position
  stretch,       ///< largest principal stretch, 1 at rest
  von_mises,     ///< Pa, of the Cauchy stress
  volume_ratio,  ///< J, 1 at rest
  error,         ///< of the mesh, of the mean energy norm: elastic/error_estimate.hpp
  displacement_x,
  displacement_y,
  displacement_z,
  stress_max,  ///< Pa, principal Cauchy stress
  stress_mid,
  stress_min,
  pressure,
  max_shear,
  stress_xx,
  stress_yy,
  stress_zz,
  stress_xy,
  stress_yz,
  stress_zx,
  strain_max,  ///< principal Green–Lagrange strain
  strain_mid,
  strain_min,
  strain_xx,
  strain_yy,
  strain_zz,
  strain_xy,
  strain_yz,
  strain_zx
};
inline constexpr std::size_t field_count = static_cast<std::size_t>(Field::strain_zx) + 1;

/// Actions that StepHistory takes back (past) and brings back (future), each by the command that began it.
struct ActionList {
  std::vector<Command> past;    ///< oldest first
  std::vector<Command> future;  ///< next to bring back first
};

/// Vectors of nodes.
enum class NodeVector {
  position,  ///< m
  velocity,  ///< m/s
  force      ///< N: of the body, gravity, loads and tools, not of supports
};

class PreconditionerBuild;  // dynamics/preconditioner_build.hpp
struct WorldFacts;          // facts.hpp

class World {
 public:
  virtual ~World() = default;

  /// Takes one command, before the next tick. Returns what is wrong with it, or nothing; a wrong one changes nothing.
  virtual Status apply(const Command& command) = 0;

  /// Advances one tick (solver.step, or 1/rate in as many equal substeps as stability asks; implicit methods take one,
  /// or halves where one does not converge). A static world is loaded further by tick / duration. Does nothing once
  /// halted.
  virtual void tick() = 0;

  /// Advances to a time within the coming tick, by shortened steps; the next tick() then ends where it would have.
  virtual void advance_within_tick(double time) = 0;

  /// Static worlds alone: goes on to a fraction of all motions, loads and gravity, 0 to 1, never back, in increments of
  /// its own choice. Halts where no equilibrium is found.
  virtual void load_to(double fraction) = 0;

  /// From any thread: a tick under way ends after its current step. For stopping a program; the tick is left
  /// unfinished.
  virtual void interrupt() = 0;
  /// Whether interrupt() left a tick unfinished: the state is then of no whole tick.
  virtual bool unfinished() const = 0;

  virtual const std::optional<StopReason>& halt() const = 0;

  /// The last recovery since the start or the last Reset, if there was any (setup().solver.recovery), and how many
  /// there were.
  virtual const Recovery* recovery() const = 0;
  virtual long recoveries() const = 0;

  virtual long ticks() const = 0;          ///< whole ticks done, not reset by Reset
  virtual double elapsed() const = 0;      ///< s that these ticks took, not reset by Reset
  virtual double time() const = 0;         ///< s since start or the last Reset
  virtual long steps() const = 0;          ///< integration steps done, substeps counted
  virtual int substeps() const = 0;        ///< of the last tick
  virtual double stable_step() const = 0;  ///< s, the live limit (safety included)
  virtual SolverStats solver_stats() const = 0;

  virtual std::vector<Vec3> positions() const = 0;   ///< #V×3, m
  virtual std::vector<Vec3> velocities() const = 0;  ///< #V×3, m/s
  /// Writes a vector of every node, 3 #V values, mesh-file order, without allocating.
  virtual void write_vectors(NodeVector which, std::span<double> out) const = 0;
  /// Writes positions of given nodes as float; no allocation when `out` has the size. `ahead`: s of extrapolation by
  /// velocity.
  virtual void write_positions(std::span<const int> nodes, double ahead, std::vector<Vec3f>& out) const = 0;
  /// Writes a field at given nodes.
  virtual void write_field(Field field, std::span<const int> nodes, std::vector<float>& out) = 0;

  virtual Energies energies() = 0;
  virtual std::vector<double> volume_ratios() = 0;  ///< J of each element of topology(), in its order
  /// J at the integration points of these elements: the same, or of quadratic ones four each, whose mean theirs is.
  virtual std::vector<double> point_volume_ratios() = 0;
  /// Cauchy stress of each, Pa, in the same order; none where there are springs.
  virtual std::vector<Mat3> stresses() = 0;
  /// Of the mesh, as the body is now; elements as topology() has them. None where springs bear what no stress tells.
  virtual std::optional<ErrorEstimate> error_estimate() = 0;
  virtual std::vector<Vec3> reactions() = 0;  ///< one per setup.boundary, N: the support's force on the body
  /// What acts on the body now: grasp, pins, tables, probe, sutures, self-contact, in this order.
  virtual std::vector<ToolState> tools() const = 0;

  /// The whole state: positions, velocities, internal state of materials, contacts with their friction, tools, pins,
  /// sutures, elements, method and the step before, recovery, commands taken, edits to undo.
  virtual std::shared_ptr<const WorldSnapshot> snapshot() = 0;
  /// Returns to a snapshot of this world or of one made of an equal setup; topology() gets a higher version. Refuses,
  /// and does nothing, where the snapshot is of another setup or precision.
  virtual Status restore(const WorldSnapshot& snapshot) = 0;

  /// Takes over the motion of another world of the same setup: positions, velocities, time, what is grasped. Returns
  /// false, and does nothing, where that is not all there is to it: another mesh or precision, internal state,
  /// recovery.
  virtual bool copy_motion_from(const World& leader) = 0;

  /// Hash of positions and velocities, bit for bit, in mesh-file order.
  virtual std::uint64_t state_hash() const = 0;
  /// 16-bit hash of each node's position and velocity, mesh-file order: lets a replay name the node that differs.
  virtual std::vector<std::uint16_t> node_hashes() const = 0;

  /// The existing elements of the mesh. Shared; every edit, or Reset after an edit, makes another one.
  virtual std::shared_ptr<const Topology> topology() const = 0;
  /// Edits since the start or the last Reset, except those undone.
  virtual const std::vector<EditReport>& edits() const = 0;

  /// What StepHistory can take back and bring back. At most 20 actions are kept, fewer of large bodies.
  virtual ActionList actions() const = 0;

  /// If the preconditioner of implicit steps is outdated after a removal, returns a job that rebuilds it on any thread,
  /// which must end before this world does; pass the result to AdoptPreconditioner. Until then steps use the outdated
  /// one. Null if it is up to date.
  virtual std::shared_ptr<PreconditionerBuild> preconditioner_build() = 0;

  /// As it is now: materials, damping, gravity and integrator follow the commands applied. The mesh
  /// is the full one, with what cuts have added; topology() lists the elements that exist. The reference holds until
  /// the next command, edit or restore.
  virtual const WorldSetup& setup() const = 0;

  /// How many threads may step from now on, the caller included; at most those of the setup. Never changes a result.
  virtual void limit_threads(int threads) = 0;
  virtual int threads() const = 0;            ///< that may step now
  virtual double worker_seconds() const = 0;  ///< CPU time, s, of the threads other than the caller

  /// What this world runs now and what that rests on, for people to read (facts.hpp). Implicit and static worlds that
  /// have not stepped yet factor their matrix for it. Steps after it are the same bits as without.
  virtual WorldFacts facts() = 0;
};

/// Number of elements that removals have taken and that were not restored.
std::size_t removed_count(const World& world);

/// Builds a world. Throws InputError for what check_tets() and material_of_elements() refuse.
std::unique_ptr<World> make_world(WorldSetup setup);

/// Builds another world in the state of a snapshot, without reading or resolving anything anew. The two share the
/// setup, the mesh and the layout of its elements until one of them is edited; both go on to the same bits.
std::unique_ptr<World> make_world_from(const WorldSnapshot& snapshot);

}  // namespace heml
