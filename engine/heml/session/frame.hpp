#pragma once
// What the engine publishes for eyes: a picture of the body at one tick. Immutable once published.
#include <array>
#include <heml/world/step_doubling.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace heml {

/// The part of the body that is drawn, of one topology. Immutable: frames share it, an edit of the mesh makes another
/// one, and whoever draws takes up what it keeps of a skin when a frame comes with one of another version. Indices are
/// into Skin::nodes.
struct SurfaceMesh {
  long version = 0;                                    ///< Topology::version
  std::vector<int> nodes;                              ///< #S: mesh-file numbers of the surface's nodes
  std::vector<Vec3f> rest;                             ///< #S×3, m
  std::vector<Triangle> triangles;                     ///< #F×3, outward
  std::vector<int> regions;                            ///< #F: region of the element behind each triangle
  std::vector<int> elements;                           ///< #F: its mesh-file number
  std::vector<int> constrained;                        ///< indices of nodes with a boundary condition
  std::shared_ptr<const SurfaceMesh> whole = nullptr;  ///< of the body before anything was removed; none: this is it
};

/// Sum of the forces of all of them, N.
template <class State>
Vec3 sum_of(const std::vector<State>& states) {
  Vec3 sum = Vec3::Zero();
  for (const State& state : states) sum += state.force;
  return sum;
}

inline const SurfaceMesh& uncut_surface(const SurfaceMesh& surface_mesh) {
  return surface_mesh.whole ? *surface_mesh.whole : surface_mesh;
}

/// How well the engine keeps up with the wall clock.
struct Pace {
  double rate = 0;          ///< Hz, ticks asked for per simulated second
  double slowdown = 1;      ///< wall seconds per simulated second over the last second; 1: real time
  long missed = 0;          ///< ticks that ended after their deadline, since start
  double p50 = 0, p99 = 0;  ///< s a tick, over the last 1000 ticks
  bool keeping_up = true;   ///< false while simulated time is slower than asked
  int threads = 1;          ///< that step now
  double others = 0;        ///< cores that the rest of the process takes, drawing above all; 0: not measured
};

/// Of the nodes of two bodies, m.
struct Distance {
  double mean = 0, max = 0;
};

struct Frame {
  std::shared_ptr<const SurfaceMesh> surface_mesh;
  long tick = 0;
  double time = 0;               ///< s, simulated
  long commands = 0;             ///< carried out since the start, to be there (Session::until)
  std::vector<Vec3f> positions;  ///< #S×3, m, in the order of Skin::nodes
  Field field = Field::none;
  std::vector<float> values;            ///< #S in the field's unit; empty for Field::none
  std::vector<float> stretches;         ///< #S, largest principal stretch; empty unless asked for
  std::optional<double> mesh_error;     ///< of the energy norm, 0 to 1; none unless asked for, or not known
  std::optional<TimeError> time_error;  ///< of the last stretch that was looked at; none likewise
  Energies energies;
  double min_J = 1, max_J = 1;
  std::size_t elements = 0, removed = 0;  ///< of the mesh; of them no longer there
  ToolState tool;
  std::vector<PinState> pins;
  std::vector<TableState> tables;
  ProbeState probe;
  std::vector<SutureState> sutures;
  Pace pace;
  int substeps = 1;
  double stable_step = 0;  ///< s
  bool paused = false;
  long fast_forward_target = 0;            ///< a tick that lies ahead; 0: time is simulated as it comes
  std::optional<Recovery> recovery;        ///< the last one, going on or ended
  std::string recovery_file;               ///< that shows it again; empty: none was written
  std::array<Vec3f, 4> recovered_element;  ///< m, corners of its first bad element, where there is one to name
  std::string recording_problem;           ///< why the recording ended early; empty: it goes on, or there is none
  std::optional<EditReport> last_edit;     ///< of the mesh
  long refusals = 0;                       ///< commands the world would not take, so far
  std::string refusal;                     ///< why not the last
  std::string halted;                      ///< why the world will not step on; empty while it does
  std::vector<Frame> comparisons;          ///< the same tick, computed in other ways (SessionOptions::beside)
  std::string variant;                     ///< in which this one is, where there are several
  std::optional<Distance> distance;        ///< of one beside: from the body; none where their surfaces differ
};

}  // namespace heml
