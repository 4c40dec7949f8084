#pragma once
// A scene as data, and how it becomes a world (file format: app/docs/scene-format.md). Reading checks everything that
// does not need the mesh; load_setup() checks the rest:
//
//   soft.json ──► read_scene ──► Scene ──► load_setup ──► WorldSetup ──► make_world ──► World
//   rec.jsonl ──►    (JSON)        ▲       (mesh, node      (all resolved)
//   liver.obj ──► scene_around ────┘        numbers)
//
// Paths in a scene are relative to the scene's file. A recording (recorder.hpp) stores the path of a mesh below its own
// folder relative to that folder, so that both can be moved together, and any other path as absolute. If that file is
// gone at replay, one of the same name in the recording's folder is used, with a warning. MeshFingerprint ensures that
// the mesh is the same.
#include <cstdint>
#include <filesystem>
#include <heml/scenario/bare_mesh_options.hpp>
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

/// Goal of adaptive refinement (adapt.hpp).
struct RefineGoal {
  double error = 0.1;  ///< estimated, relative, in the energy norm, 0 to 1
  int tets = 50000;    ///< maximum number of tetrahedra
};

/// Source and placement of the mesh. Exactly one of file, surface, box, asset.
struct MeshSpec {
  struct Box {
    Vec3 size, origin;         ///< m
    std::array<int, 3> cells;  ///< 5 tetrahedra each
  };
  std::filesystem::path file;     ///< tetrahedral mesh, absolute or relative to the working directory
  std::filesystem::path surface;  ///< closed surface for TetGen
  std::filesystem::path labels;   ///< label map of a scan
  int label_tets = 20000;         ///< wanted of a label map, before `scale`
  std::optional<int> tets;        ///< wanted of a file or surface, whose shapes are improved too; none: as it is
  double radius_edge_ratio = 1.4;
  std::optional<double> max_volume;  ///< m³, of one tetrahedron of the scaled body
  std::optional<Box> box;
  std::string asset;  ///< "kidney", ...
  double scale = 1;
  Vec3 rotate_axis = Vec3(0, 0, 1), rotate_origin = Vec3::Zero();
  double rotate_degrees = 0;
  Vec3 translate = Vec3::Zero();
  std::optional<RefineGoal> refine;       ///< empty: no refinement
  std::shared_ptr<const TetMesh> source;  ///< of the file or surface, before placement, where it was read already
};

/// Nodes selected by an entry: by number, box or sphere (rest positions, closed sets; m).
struct Selection {
  std::vector<int> nodes;  ///< mesh-file order
  std::optional<std::array<Vec3, 2>> box;
  std::optional<std::pair<Vec3, double>> sphere;  ///< centre, radius
};

struct BoundaryEntry {
  Selection where;
  Boundary motion;  ///< load_setup() fills its nodes
};
struct LoadEntry {
  Selection where;
  Load load;  ///< load_setup() fills its nodes
};

/// Nodes whose mean position is written while a scene is solved (trace.hpp).
struct MarkerEntry {
  std::string name;  ///< empty: its index
  Selection where;
};

/// A fine surface that is drawn in place of the body's own (skin.hpp); it does not affect the physics.
struct SkinSpec {
  std::filesystem::path file;     ///< surface, placed as the mesh is
  std::filesystem::path texture;  ///< PNG; empty: the one that the surface names, if any
};

/// Initial settings of a viewer; they do not affect the physics.
struct View {
  std::optional<double> azimuth, elevation;  ///< degrees
  std::optional<double> zoom;                ///< 1: the body fills the image
  bool orthographic = false;                 ///< without perspective
  Field field = Field::none;
  bool wireframe = false;
  std::optional<Vec3> section;  ///< unit normal of the section plane, towards what is cut away; none: no plane
  double section_at = 0;        ///< m, of the plane along its normal, from the centre of the body at rest
  std::vector<int> hidden = {};              ///< regions that are not drawn, ascending
  std::optional<std::array<double, 2>> range = {};  ///< of the colours, in the field's unit; none: of the values
};

/// Hash of a recorded world's state after `tick` ticks, before the commands of the next.
struct Checkpoint {
  long tick = 0;
  std::uint64_t hash = 0;            ///< state_hash()
  std::vector<std::uint16_t> nodes;  ///< node_hashes(); may be empty
};

/// End record of a recording. Format 1 has only `tick`.
struct RecordedEnd {
  long tick = 0;
  std::optional<long> checkpoints;    ///< number of checkpoints in the recording
  std::optional<std::uint64_t> hash;  ///< state_hash() before the commands of the tick
  std::optional<std::string> halt;    ///< StopReason::message, where the world halted within the tick
  std::optional<bool> halted;         ///< whether it did; none: not told
};

/// Format and program that a recording was written with.
struct RecordedBy {
  int format = 1;            ///< from 2 on the end record has the number of checkpoints and the final hash
  long kernel_revision = 0;  ///< build_identity.hpp; 0: older than revisions
  std::string build;         ///< build_name(); empty: unknown
};
constexpr int recording_format = 2;  ///< written by this build

/// Identifies the mesh a recording was made with. Hash: of positions (as placed), elements, regions and the fields that
/// materials use.
struct MeshFingerprint {
  int nodes = 0, tets = 0;
  std::uint64_t hash = 0;
  bool operator==(const MeshFingerprint&) const = default;
};

/// What scene_around() chose for a bare mesh (bare_mesh.hpp), and why.
struct BareMeshChoices {
  struct Text {
    std::string about;  ///< mesh, fineness, unit, up, supports, element, tissue, method
    std::string text;
  };
  /// Something wrong with the mesh as it was read, and what became of it (mesh_findings.hpp).
  struct Finding {
    int count = 0;
    std::string found;        ///< of what: "slivers"
    std::string done;         ///< "closed"; "kept"
    bool is_mended = false;   ///< the body that is simulated does not have it
    std::string detail = {};  ///< a sentence more; may be empty
  };
  BareMeshOptions given;  ///< what was given; the rest was guessed
  std::string unit;       ///< LengthUnit::name
  double scale = 1;       ///< to metres
  double length = 0;      ///< m, longest side
  UpAxis up = UpAxis::y;
  SupportKind supports = SupportKind::underside;
  double supported_area = 0;  ///< share of the surface that is held
  int read_tets = 0, tets = 0;  ///< as read or filled, and of the body: given.tets
  double min_dihedral = 0;      ///< degrees, of the body
  std::vector<Finding> findings;
  double young = 0, poisson = 0, density = 0;
  double stretch = 0;  ///< largest of the body under its weight, means at nodes
  double load = 0;     ///< computing time on one core over simulated time, by the cost model
  std::vector<Text> texts;
};

struct Scene {
  std::string file;  ///< path it was read from, for messages
  std::string name, title, description;
  MeshSpec mesh;
  std::vector<RegionMaterial> materials;
  std::vector<RegionTag> regions;  ///< that load_setup() gives the mesh, in this order
  std::vector<BoundaryEntry> boundary;
  std::vector<LoadEntry> loads;
  std::vector<Table> tables;
  std::optional<SelfContactSettings> self_contact;
  std::optional<TearingSettings> tearing;
  Vec3 gravity = Vec3::Zero();
  SolverSettings solver;
  std::vector<double> output_times;  ///< s (static scene: fraction of the load), as listed
  bool output_positions = true, output_vtu = false;
  std::vector<MarkerEntry> markers;
  bool output_history = false;
  double output_every = 0;  ///< s between rows of markers and history; 0: every tick
  Vec3 initial_velocity = Vec3::Zero();
  std::filesystem::path initial_positions;
  View view;
  std::optional<SkinSpec> skin;
  std::optional<BareMeshChoices> chosen;  ///< of a bare mesh only
  std::vector<Event> events;              ///< ascending in tick
  /// By index in `events`: points (m) given instead of node numbers; the command gets the nearest surface nodes.
  std::map<std::size_t, std::vector<Vec3>> points;
  // Of recordings only:
  std::vector<Checkpoint> checkpoints;      ///< ascending in tick
  std::optional<long> recorded_ticks;       ///< length, as far as known
  std::optional<RecordedEnd> recorded_end;  ///< empty if the recording was cut short
  RecordedBy recorded_by;
  std::optional<MeshFingerprint> recorded_mesh;
  std::optional<InstructionSet> recorded_instructions;  ///< with which its states were computed
};

/// Reads a scene or a recording, or makes a default scene for a bare mesh or surface file. options: of that one. Throws
/// InputError.
Scene read_scene(const std::filesystem::path& path, const BareMeshOptions& options = {});

/// Reads a scene or recording from text; paths and messages refer to the file `as_if_from`. Throws InputError.
Scene parse_scene(std::string_view text, const std::filesystem::path& as_if_from);

/// The scene `heml` opens without arguments.
Scene default_scene();

/// The default scene for a bare mesh or surface (bare_mesh.hpp): soft tissue under gravity, held so that it rests, in
/// real time by the cost model. Says what it chose on stderr and in Scene::chosen. Throws InputError.
Scene scene_around(const std::filesystem::path& mesh_or_surface, const BareMeshOptions& options = {});

/// Whether this processor supports the instruction set a recording names. Then its world uses it and reproduces the
/// recorded states; else states differ by round-off.
bool plays_as_recorded(const Scene& scene);

/// Reads the mesh, resolves selections and fields, refines if the scene asks for it, and checks what depends on the
/// mesh. Throws InputError.
WorldSetup load_setup(const Scene& scene);

/// The same with a mesh from load_mesh() (load_mesh.hpp) and its mid-edge nodes, if it has any.
WorldSetup load_setup(const Scene& scene, TetMesh mesh, MidEdges midedges = {});

/// make_world(load_setup(scene)).
std::unique_ptr<World> load_world(const Scene& scene);

/// Lines of a recording, as JSON text without line end, 17 significant digits. scene_line() leaves out events and
/// checkpoints, which have lines of their own. Its paths are for a file in `folder`; without a folder they are
/// absolute.
std::string scene_line(const Scene& scene, const std::filesystem::path& folder = {});
std::string event_line(const Event& event);
std::string checkpoint_line(const Checkpoint& checkpoint);
std::string end_line(const RecordedEnd& end);

/// A recording as JSON Lines: the scene, its events, checkpoints and end; `folder` as for scene_line().
std::string recording_text(const Scene& scene, const std::filesystem::path& folder = {});

/// The scene with its events, without checkpoints, as an indented scene file; `folder` as for scene_line().
std::string scene_text(const Scene& scene, const std::filesystem::path& folder = {});

/// Reads a file with one entry of `materials` (app/docs/scene-format.md), as `heml probe` takes it. Throws InputError,
/// also for fields, as there is no mesh.
Material read_material(const std::filesystem::path& path);

/// Folder of scenes, meshes and fonts: $HEML_ASSETS, else the installed one, else the source tree's.
std::filesystem::path assets_folder();

}  // namespace heml
