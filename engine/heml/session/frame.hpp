#pragma once
// Frame: a snapshot of the body at one tick, published by the engine for viewers. Immutable once published.
#include <array>
#include <heml/world/command.hpp>
#include <heml/world/step_doubling.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace heml {

/// Topology of the drawn surface. Immutable and shared by frames; an edit of the mesh makes a new one with another
/// version, on which a viewer rebuilds its buffers. Indices are into SurfaceMesh::nodes.
struct SurfaceMesh {
  long version = 0;                                    ///< Topology::version
  std::vector<int> hidden = {};                        ///< regions that are left out, ascending
  std::vector<int> nodes;                              ///< #S: mesh-file numbers of the surface's nodes
  std::vector<Vec3f> rest;                             ///< #S×3, m
  std::vector<Triangle> triangles;                     ///< #F×3, outward
  std::vector<int> regions;                            ///< #F: region of the element behind each triangle
  std::vector<int> elements;                           ///< #F: its mesh-file number
  std::vector<int> constrained;                        ///< indices of nodes with a boundary condition
  std::shared_ptr<const SurfaceMesh> whole = nullptr;  ///< before any element was removed; null: this one
  std::size_t uncut_elements = 0;                      ///< of the mesh before any cut, shown or not
  std::vector<float> burnt = {};                       ///< #S, 0 to 1: mean Burn::level of the elements behind the
                                                       ///< triangles round a node; empty: nothing is burnt
};

inline const SurfaceMesh& uncut_surface(const SurfaceMesh& surface_mesh) {
  return surface_mesh.whole ? *surface_mesh.whole : surface_mesh;
}

struct Skin;  // scenario/skin.hpp

/// How well the engine keeps up with the wall clock.
struct Pace {
  double rate = 0;          ///< Hz, ticks per simulated second
  double slowdown = 1;      ///< wall seconds per simulated second over the last second; 1: real time
  long missed = 0;          ///< missed deadlines since the start
  double p50 = 0, p99 = 0;  ///< s, percentiles of the wall time of a tick over the same second; 0: it had no tick
  bool keeping_up = true;   ///< slowdown is below 1.1
  int threads = 1;          ///< that step now
  double others = 0;        ///< cores that the rest of the process uses, mainly drawing; 0: not measured
};

/// Between corresponding nodes of two bodies, m.
struct Distance {
  double mean = 0, max = 0;
};

/// Undo and redo: the actions by name, and the settings that a step among them has restored. Immutable and shared by
/// frames until it changes.
struct UndoList {
  std::vector<std::string> past;    ///< names of the actions that can be undone, oldest first
  std::vector<std::string> future;  ///< of those that can be redone, next first
  long steps = 0;                   ///< steps back and forth, and resets of the scene, since the start
  std::vector<Command> settings;    ///< after the last of them: commands that set what holds since
};

/// What holds, moves and loads the body. Immutable and shared by frames until it changes.
struct Conditions {
  std::vector<Boundary> boundary;
  std::vector<Load> loads;
  std::size_t mesh_nodes = 0;  ///< of the mesh as it is now
  bool operator==(const Conditions&) const = default;
};

/// Regions of the elements there are, and materials. Immutable and shared by frames until they change.
struct Regions {
  long version = 0;                       ///< Topology::version
  std::vector<int> numbers;               ///< ascending
  std::map<int, std::string> names;       ///< of those that have one
  std::vector<TaggedRegion> tagged;       ///< WorldSetup::tagged
  std::vector<RegionMaterial> materials;  ///< WorldSetup::materials
};

/// The elements behind the surface, for pictures of the inside. Immutable and shared by frames.
struct Solid {
  long version = 0;          ///< Topology::version
  std::vector<int> hidden;   ///< regions that are left out, ascending
  std::vector<Vec3f> rest;   ///< #N×3, m, of all nodes of the mesh
  std::vector<Tet> tets;     ///< #T: corners of the present and shown elements, indices into `rest`
  std::vector<int> regions;  ///< #T
  std::vector<float> burnt;  ///< #N, 0 to 1: mean Burn::level of the elements round a node; empty: nothing is burnt
};

struct Frame {
  std::shared_ptr<const SurfaceMesh> surface_mesh;
  long tick = 0;
  double time = 0;               ///< s, simulated, since the start or the last reset
  double elapsed = 0;            ///< s, simulated, since the start
  long commands = 0;             ///< carried out since the start (Session::until)
  std::vector<Vec3f> positions;  ///< #S×3, m, in the order of SurfaceMesh::nodes
  Field field = Field::none;
  std::vector<float> values;           ///< #S in the field's unit; empty for Field::none
  std::vector<float> stretches;        ///< #S, largest principal stretch; empty unless asked for
  std::shared_ptr<const Solid> solid;  ///< null unless asked for
  std::vector<Vec3f> solid_positions;  ///< #N×3, m, in the order of Solid::rest
  std::vector<float> solid_values;     ///< #N in the field's unit; empty for Field::none
  std::shared_ptr<const Skin> skin;    ///< drawn in place of the surface, with `solid`; null: there is none
  std::optional<double> mesh_error;    ///< relative, in the energy norm, 0 to 1; empty unless asked for and known
  std::optional<TimeError> time_error;  ///< of the last interval estimated; empty unless asked for and known
  std::shared_ptr<const Conditions> conditions;
  std::shared_ptr<const Regions> regions;
  Energies energies;
  double min_J = 1, max_J = 1;
  std::size_t elements = 0, removed = 0;  ///< elements of the mesh; of these, removed
  std::vector<ToolState> tools;           ///< what acts on the body
  Pace pace;
  int substeps = 1;
  double stable_step = 0;      ///< s
  long explicit_rescues = 0;   ///< SolverStats
  long unconverged_steps = 0;  ///< SolverStats
  bool paused = false;
  long fast_forward_target = 0;               ///< the tick being fast-forwarded to; 0: none
  std::optional<Recovery> recovery;           ///< the last one, active or ended
  std::string recovery_file;                  ///< recording that reproduces it; empty: none was written
  std::array<Vec3f, 4> recovered_element;     ///< m, corners of its first invalid element, if recovery names one
  std::string recording_problem;              ///< why the recording ended early; empty: it did not, or there is none
  std::optional<EditReport> last_edit;        ///< of the mesh
  std::shared_ptr<const UndoList> undo_list;  ///< null before the first action
  long requests = 0;                          ///< number of requests answered (Session::has_answered())
  long refusals = 0;                          ///< number of commands that the world refused
  std::string refusal;                        ///< reason of the last refusal
  std::string halted;                         ///< why the world has halted; empty while it steps
  std::vector<Frame> comparisons;             ///< of the comparison runs, same tick (SessionOptions::comparisons)
  std::string variant;                        ///< name of this frame's variant, where there are comparison runs
  std::optional<Distance> distance;           ///< of a comparison run from the body; empty where their surfaces differ
};

}  // namespace heml
