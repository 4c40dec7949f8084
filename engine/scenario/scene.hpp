#pragma once
// A scene file as data (contract: "Scene file", "Recording / script"), and how it becomes a world.
// Reading checks everything that can be checked without the mesh; load_world() resolves the rest.
#include <filesystem>
#include <heml/world/setup.hpp>
#include <heml/world/command.hpp>
#include <heml/world/world.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace heml {

/// Which mesh, and where it is put. Exactly one of file, surface, box, asset.
struct MeshSpec {
  struct Box {
    Vec3 size, origin;         ///< m
    std::array<int, 3> cells;  ///< 5 tetrahedra each
  };
  std::filesystem::path file;     ///< tetrahedra, absolute or relative to the working directory
  std::filesystem::path surface;  ///< closed surface for TetGen
  double radius_edge_ratio = 1.4;
  std::optional<double> max_volume;  ///< m³
  std::optional<Box> box;
  std::string asset;  ///< "kidney", ...
  double scale = 1;
  Vec3 rotate_axis = Vec3(0, 0, 1), rotate_origin = Vec3::Zero();
  double rotate_degrees = 0;
  Vec3 translate = Vec3::Zero();
};

/// Nodes chosen in a boundary or load entry: by number, box or sphere (rest positions, closed sets).
struct Selection {
  std::vector<int> nodes;
  std::optional<std::array<Vec3, 2>> box;
  std::optional<std::pair<Vec3, double>> sphere;
};

struct BoundaryEntry {
  Selection where;
  Boundary motion;  ///< its nodes are filled by load_world()
};
struct LoadEntry {
  Selection where;
  Load load;  ///< likewise
};

/// How a viewer starts: all optional, never part of the physics.
struct View {
  std::optional<double> azimuth, elevation;  ///< degrees
  std::optional<double> zoom;                ///< 1: the body fills the picture
  Field field = Field::none;
  bool wireframe = false;
};

struct Checkpoint {
  long tick = 0;
  std::uint64_t hash = 0;
  std::vector<std::uint16_t> nodes;  ///< node_hashes(); may be empty
};

struct Scene {
  std::string file;  ///< where it was read from, for messages
  std::string name, title, description;
  MeshSpec mesh;
  std::vector<RegionMaterial> materials;
  std::vector<BoundaryEntry> boundary;
  std::vector<LoadEntry> loads;
  Vec3 gravity = Vec3::Zero();
  SolverSettings solver;
  std::vector<double> output_times;  ///< s, ascending
  bool output_positions = true, output_vtu = false;
  Vec3 initial_velocity = Vec3::Zero();
  std::filesystem::path initial_positions;
  View view;
  std::vector<Event> events;            ///< ascending in tick
  std::vector<Checkpoint> checkpoints;  ///< of a recording
  long recorded_ticks = 0;              ///< of a recording: how far it went
};

/// Reads a scene, a recording (either form), or puts the default scene round a bare mesh or surface file.
/// Throws InputError.
Scene read_scene(const std::filesystem::path& path);

/// The scene `heml` opens without arguments.
Scene default_scene();

/// The default scene round a bare mesh or surface: soft tissue, held at its top, under gravity.
Scene scene_around(const std::filesystem::path& mesh_or_surface);

/// Reads the mesh, resolves selections, checks what needs the mesh. Throws InputError.
WorldSetup load_setup(const Scene& scene);

/// make_world(load_setup(scene)).
std::unique_ptr<World> load_world(const Scene& scene);

/// Scene, event and checkpoint as JSON text on one line each, as recordings hold them; 17 significant digits.
std::string scene_line(const Scene& scene);
std::string event_line(const Event& event);
std::string checkpoint_line(const Checkpoint& checkpoint);

/// One entry of `materials` (contract), e.g. the file `heml probe` takes; `density` accepted. Throws InputError.
Material read_material(const std::filesystem::path& path);

/// Folder that holds scenes, meshes and fonts: $HEML_ASSETS, else the installed one, else the source tree's.
std::filesystem::path assets_folder();

}  // namespace heml
