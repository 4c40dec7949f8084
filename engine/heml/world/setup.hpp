#pragma once
// All that makes a world, with every file read and every selection resolved to node numbers. Scenes become this
// (scenario/), tests write it by hand; make_world() turns it into something that steps.
#include <heml/dynamics/integrator.hpp>
#include <heml/dynamics/solver_options.hpp>
#include <heml/elastic/instruction_set.hpp>
#include <heml/materials/material.hpp>
#include <heml/mesh/edit.hpp>
#include <heml/mesh/quadratic.hpp>
#include <heml/tools/contact_surface.hpp>
#include <heml/tools/settings.hpp>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace heml {

/// A material and the region it applies to; no region: the default.
struct RegionMaterial {
  std::optional<int> region;
  Material material;
};

/// A set of coordinate axes: of a node, those in which it is held.
struct AxisSet {
  std::array<bool, 3> has{true, true, true};

  static AxisSet none() { return {{false, false, false}}; }
  bool are_all() const { return has[0] && has[1] && has[2]; }
  bool are_none() const { return !has[0] && !has[1] && !has[2]; }
  AxisSet with(const AxisSet& other) const {
    return {{has[0] || other.has[0], has[1] || other.has[1], has[2] || other.has[2]}};
  }
  bool operator==(const AxisSet&) const = default;
};

/// Nodes held or moved. A moved node goes to rotate(X − origin) + origin + translate of its rest position X,
/// translation and angle ramped linearly over ramp_time from ramp_start, then held. Of several on one coordinate of a
/// node the last wins.
struct Boundary {
  std::vector<int> nodes;         ///< mesh-file order
  Vec3 translate = Vec3::Zero();  ///< m
  Vec3 axis = Vec3(0, 0, 1);      ///< unit
  Vec3 origin = Vec3::Zero();     ///< m
  double degrees = 0;             ///< right-handed about axis
  double ramp_time = 0;           ///< s; 0: at once
  double ramp_start = 0;          ///< s
  AxisSet axes = {};                 ///< coordinates that are prescribed; the others are free
  bool operator==(const Boundary&) const = default;
};

/// A load on selected nodes, ramped linearly over ramp_time from ramp_start. What is removed of the body takes its
/// share of a load along: faces that go with their element, nodes that lose all elements. Faces laid bare carry none.
struct Load {
  enum class Kind {
    force,     ///< N in all, shared equally by the nodes
    traction,  ///< Pa on the boundary faces whose three nodes are selected: rest area, dead load
    pressure   ///< Pa on the same faces, along the inward normal of the deformed surface
  };
  Kind kind = Kind::force;
  std::vector<int> nodes;      ///< mesh-file order
  Vec3 vector = Vec3::Zero();  ///< N for force, Pa for traction
  double pressure = 0;         ///< Pa for pressure
  double ramp_time = 0;        ///< s; 0: at once
  double ramp_start = 0;       ///< s
  bool operator==(const Load&) const = default;
};

/// How much an implicit stage may take, for those who must be on time: at the end of it the body is where it is, never
/// worse off than at the start, with the energy it may have (world/budget.cpp). A scene gives one of
/// the two.
struct Budget {
  int iterations = 0;       ///< of the minimiser, a stage; 0: what the time allows
  double milliseconds = 0;  ///< a tick; 0: none given
  int linear = 0;           ///< iterations of a linear solve, however its elements are shaped; 0: what accuracy takes
};

struct SolverSettings {
  Integrator integrator = Integrator::verlet;
  bool single_precision = false;  ///< float instead of double
  std::optional<double> step;  ///< s; given: obeyed exactly, one step a tick. Not given: live stable substeps of a tick
  double rate = 1000;          ///< Hz of the engine's ticks where no step is given
  double duration = 1;         ///< s, for `heml solve`
  double damping = 0;          ///< mass-proportional, 1/s
  double mass_scaling = 0;     ///< share of the mass that may be added for longer steps (elastic/mass_scaling.hpp)
  int threads = 0;             ///< 0: all cores. Never changes a bit of the result
  bool continuation = false;   ///< continue each law past its range instead of stopping there
  bool recovery = false;  ///< bring a collapsed or wild body back instead of stopping (recovery.hpp); dynamics alone
  bool nodal_pressure = false;  ///< averaged nodal pressure instead of one a tetrahedron (elastic/nodal_pressure.hpp);
                                ///< of quadratic elements their mean dilatation (elastic/mean_dilatation.hpp)
  bool quadratic = false;       ///< ten-node tetrahedra (mesh/quadratic.hpp)
  std::optional<double> tolerance;  ///< of implicit and static solves, relative to the forces at work (contract)
  std::optional<Budget> budget;     ///< none: every stage is solved to its tolerance
  Minimiser minimiser = Minimiser::newton;       ///< of implicit steps; statics are Newton's
  Projection projection = Projection::element;   ///< of a stiffness that is seen not to be positive
  std::optional<Preconditioner> preconditioner;  ///< none: by the body's size
  std::string_view element() const {
    if (quadratic) return nodal_pressure ? "p2_pressure" : "p2";
    return nodal_pressure ? "nodal_pressure" : "p1";
  }
  bool is_static() const { return integrator == Integrator::static_equilibrium; }
  double load_duration() const { return duration > 0 ? duration : 1; }  ///< s, that a static world's ticks load over
  double relative_tolerance() const { return tolerance.value_or(single_precision ? 1e-4 : 1e-8); }
  double tick() const { return step ? *step : 1.0 / rate; }  ///< s
};

struct WorldSetup {
  TetMesh mesh;       ///< checked by check_tets(): positive volumes
  MidEdges midedges;  ///< nodes of the mesh, of each element; empty unless solver.quadratic
  std::vector<RegionMaterial> materials;
  std::vector<TaggedRegion> tagged;  ///< regions of the mesh that were chosen since it was made, in this order
  std::vector<Boundary> boundary;
  std::vector<Load> loads;
  std::vector<Table> tables;
  std::optional<SelfContactSettings> self_contact;  ///< none: tissue passes tissue
  std::optional<TearingSettings> tearing;           ///< none: nothing tears; dynamics alone
  Vec3 gravity = Vec3::Zero();                      ///< m/s²
  SolverSettings solver;
  Vec3 initial_velocity = Vec3::Zero();                   ///< m/s, of every free node
  std::vector<Vec3> initial_positions;                    ///< #V or empty (rest shape), mesh-file order
  InstructionSet instruction_set = InstructionSet::best;  ///< of the force kernels; must be one this processor has
  bool keeps_actions = true;  ///< keep the state before each action for StepHistory; never changes a result
};

/// Whether float resolves the body where it is: no node is farther from the origin, at rest or at the start, than 32
/// diagonals of the body, so that at most five of float's 24 bits tell where the body is rather than what shape it has.
bool fits_single_precision(const WorldSetup& setup);

/// Computes in double what float does not resolve; the tolerance of solves stays that of float. Returns whether it
/// changed the setup. make_world() does this too.
bool use_double_far_away(WorldSetup& setup);

/// The same for static solves of materials with internal state: where values of float are round-off, other bodies are
/// evaluated in double, which that state is not kept in.
bool use_double_for_memory(WorldSetup& setup);

/// The entry of `materials` for elements of a region: its own, or the default; −1: there is neither.
int material_of_region(int region, const std::vector<RegionMaterial>& materials);

/// One entry of `materials` per element: index into `materials`. file: the scene's, for messages; empty: they name the
/// mesh. Throws InputError for a region without material and for two entries of one region.
std::vector<int> material_of_elements(const TetMesh& mesh, const std::vector<RegionMaterial>& materials,
                                      const std::string& file = {});

}  // namespace heml
