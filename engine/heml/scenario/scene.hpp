#pragma once
// A scene file as data, and how it becomes a world. Reading checks everything that can be checked without the mesh;
// load_setup() does the rest:
//
//   soft.json ──► read_scene ──► Scene ──► load_setup ──► WorldSetup ──► make_world ──► World
//   rec.jsonl ──►    (JSON)        ▲       (mesh, node      (all resolved)
//   liver.obj ──► scene_around ────┘        numbers)
//
// Paths inside a scene are relative to the scene's file. A recording (recorder.hpp) writes the path of a mesh below its
// own folder relative to that folder, so both can be moved together, and any other as absolute, so it can be written
// anywhere; if that file is gone by the time of the replay, one of the same name beside the recording is taken, with a
// warning. What was recorded of the mesh (MeshFingerprint) makes sure that it is the same.
#include <cstdint>
#include <filesystem>
#include <heml/world/command.hpp>
#include <heml/world/setup.hpp>
#include <heml/world/world.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace heml {

/// How fine a mesh is to be made where it errs most (adapt.hpp).
struct RefineGoal {
  double error = 0.1;  ///< of the energy norm at rest under all loads, as estimated; 0 to 1
  int tets = 50000;    ///< and no more than so many
};

/// Which mesh, and where it is put. Exactly one of file, surface, box, asset.
struct MeshSpec {
  struct Box {
    Vec3 size, origin;         ///< m
    std::array<int, 3> cells;  ///< 5 tetrahedra each
  };
  std::filesystem::path file;     ///< tetrahedra, absolute or relative to the working directory
  std::filesystem::path surface;  ///< closed surface for TetGen
  double radius_edge_ratio = 1.4;
  std::optional<double> max_volume;  ///< m³ of one tetrahedron, in the body as scaled
  std::optional<Box> box;
  std::string asset;  ///< "kidney", ...
  double scale = 1;
  Vec3 rotate_axis = Vec3(0, 0, 1), rotate_origin = Vec3::Zero();
  double rotate_degrees = 0;
  Vec3 translate = Vec3::Zero();
  std::optional<RefineGoal> refine;  ///< none: as it is
};

/// Nodes chosen in a boundary or load entry: by number, box or sphere (rest positions, closed sets).
struct Selection {
  std::vector<int> nodes;  ///< mesh-file order
  std::optional<std::array<Vec3, 2>> box;
  std::optional<std::pair<Vec3, double>> sphere;  ///< centre, radius
};

struct BoundaryEntry {
  Selection where;
  Boundary motion;  ///< its nodes are filled by load_setup()
};
struct LoadEntry {
  Selection where;
  Load load;  ///< likewise
};

/// Nodes whose mean place is written while a scene is solved (trace.hpp).
struct MarkerEntry {
  std::string name;  ///< empty: its number
  Selection where;
};

/// How a viewer starts: all optional, never part of the physics.
struct View {
  std::optional<double> azimuth, elevation;  ///< degrees
  std::optional<double> zoom;                ///< 1: the body fills the picture
  Field field = Field::none;
  bool wireframe = false;
};

/// State of a recorded world after `tick` ticks, before the commands of the next.
struct Checkpoint {
  long tick = 0;
  std::uint64_t hash = 0;            ///< state_hash()
  std::vector<std::uint16_t> nodes;  ///< node_hashes(); may be empty
};

/// How a recording ends. Only `tick` is there in those of format 1.
struct RecordedEnd {
  long tick = 0;
  std::optional<long> checkpoints;    ///< that the recording holds
  std::optional<std::uint64_t> hash;  ///< state_hash() before the commands of the tick
  std::optional<std::string> halt;    ///< Halt::message, where the world stopped within the tick
};

/// Who made a recording.
struct RecordedBy {
  int format = 1;            ///< 2: its end says how many checkpoints there are and the state it ends with
  long kernel_revision = 0;  ///< build_identity.hpp; 0: made before there were any
  std::string build;         ///< likewise; empty: not told
};
constexpr int recording_format = 2;  ///< that this build writes

/// Says whether a mesh is the one a recording was made with. Hash: of positions (as placed), elements, regions
/// and the fields that materials use.
struct MeshFingerprint {
  int nodes = 0, tets = 0;
  std::uint64_t hash = 0;
  bool operator==(const MeshFingerprint&) const = default;
};

struct Scene {
  std::string file;  ///< where it was read from, for messages
  std::string name, title, description;
  MeshSpec mesh;
  std::vector<RegionMaterial> materials;
  std::vector<BoundaryEntry> boundary;
  std::vector<LoadEntry> loads;
  std::vector<Table> tables;
  std::optional<SelfContactSettings> self_contact;
  std::optional<TearingSettings> tearing;
  Vec3 gravity = Vec3::Zero();
  SolverSettings solver;
  std::vector<double> output_times;  ///< s, as listed
  bool output_positions = true, output_vtu = false;
  std::vector<MarkerEntry> markers;
  bool output_history = false;
  double output_every = 0;  ///< s between rows of markers and history; 0: every tick
  Vec3 initial_velocity = Vec3::Zero();
  std::filesystem::path initial_positions;
  View view;
  std::vector<Event> events;  ///< ascending in tick
  /// Index in `events` of a command about nodes to places in space instead: the surface nodes nearest to them.
  std::map<std::size_t, std::vector<Vec3>> points;
  std::vector<Checkpoint> checkpoints;                  ///< of a recording, ascending in tick
  std::optional<long> recorded_ticks;                   ///< of a recording: how far it went, as far as is known
  std::optional<RecordedEnd> recorded_end;              ///< of a recording that was not cut short
  RecordedBy recorded_by;                               ///< of a recording
  std::optional<MeshFingerprint> recorded_mesh;         ///< of a recording
  std::optional<InstructionSet> recorded_instructions;  ///< of a recording: whose bits its states are
};

/// Reads a scene, a recording (either form), or puts the default scene round a bare mesh or surface file.
/// Throws InputError.
Scene read_scene(const std::filesystem::path& path);

/// A scene or recording from text, with paths and messages as if it stood in that file. Throws InputError.
Scene parse_scene(std::string_view text, const std::filesystem::path& as_if_from);

/// The scene `heml` opens without arguments.
Scene default_scene();

/// The default scene round a bare mesh or surface: soft tissue, held at its top, under gravity.
Scene scene_around(const std::filesystem::path& mesh_or_surface);

/// Whether this processor has the instructions a recording names. Then its world is made to use them, and its states
/// come out as they were; else they differ by round-off.
bool plays_as_recorded(const Scene& scene);

/// Reads the mesh, resolves selections and fields, refines where that is asked for, checks what needs the mesh. Throws
/// InputError.
WorldSetup load_setup(const Scene& scene);

/// The same with the scene's mesh as load_mesh() (load_mesh.hpp) gives it.
WorldSetup load_setup(const Scene& scene, TetMesh mesh);

/// make_world(load_setup(scene)).
std::unique_ptr<World> load_world(const Scene& scene);

/// Scene, event and checkpoint as JSON text on one line each (no line end), as recordings hold them; 17 significant
/// digits.
/// The scene goes without its events and checkpoints, which have lines of their own, and reads back to the same world
/// from a file in `folder`; no folder: from anywhere on this machine.
std::string scene_line(const Scene& scene, const std::filesystem::path& folder = {});
std::string event_line(const Event& event);
std::string checkpoint_line(const Checkpoint& checkpoint);
std::string end_line(const RecordedEnd& end);

/// The scene with its events, but no checkpoints, as a file in `folder` for people: indented, likewise.
std::string scene_text(const Scene& scene, const std::filesystem::path& folder = {});

/// One entry of `materials` (contract), e.g. the file `heml probe` takes; `density` accepted. Throws InputError, also
/// for fields, as there is no mesh.
Material read_material(const std::filesystem::path& path);

/// Folder that holds scenes, meshes and fonts: $HEML_ASSETS, else the installed one, else the source tree's.
std::filesystem::path assets_folder();

}  // namespace heml
