#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <heml/base/error.hpp>
#include <heml/base/hash.hpp>
#include <heml/base/log.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/improve/improve.hpp>
#include <heml/mesh/labels/mesh_labels.hpp>
#include <heml/mesh/mend/mend.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/mesh/read.hpp>
#include <heml/scenario/feb_scene.hpp>
#include <heml/scenario/label_names.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <heml/scenario/placement.hpp>
#include <heml/scenario/selection.hpp>

namespace heml {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> asset_names(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".mesh") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

TetMesh asset_mesh(const Scene& scene, MidEdges* midedges) {
  const fs::path path = asset_mesh_file(scene.mesh.asset), folder = path.parent_path();
  std::error_code error;
  if (!fs::exists(path, error))
    throw InputError(scene.file, "mesh.asset", fmt::format("'{}' is not in {}", scene.mesh.asset, folder.string()),
                     fmt::format("there are: {}", fmt::join(asset_names(folder), ", ")));
  return read_tet_mesh(path, midedges);
}

/// Throws InputError where curved edges turn an element inside out.
void check_midedges(const TetMesh& mesh, const MidEdges& midedges) {
  std::size_t first = mesh.tets.size(), count = 0;
  for (std::size_t t = 0; t < midedges.size(); ++t) {
    const int inverted = count_inverted_points({mesh.tets[t]}, {midedges[t]},
                                               [&](int n) { return mesh.nodes[static_cast<std::size_t>(n)]; });
    if (inverted > 0) first = std::min(first, t), ++count;
  }
  if (count > 0)
    throw InputError(mesh.source, "",
                     fmt::format("the mid-edge nodes turn {} of {} tetrahedra inside out, the first is {}", count,
                                 mesh.tets.size(), first),
                     "mesh it finer there, or take \"element\": \"p1\", which leaves them out");
}

/// check_tets(). Where the scene makes or places the mesh, errors name the scene too.
QualityReport checked(const Scene& scene, TetMesh& mesh, MidEdges* midedges) try {
  return check_tets(mesh, midedges);
} catch (const InputError& error) {
  const MeshSpec& spec = scene.mesh;
  const bool is_placed = spec.scale != 1 || spec.rotate_degrees != 0 || !spec.translate.isZero(0);
  if (mesh.source == scene.file || !(spec.box || is_placed)) throw;
  throw InputError(scene.file, "mesh", error.what());
}

TetMesh meshed_labels(const Scene& scene) {
  LabelMeshOptions options;
  options.tets = scene.mesh.label_tets;
  const fs::path path = find_file(scene, "mesh.labels", scene.mesh.labels);
  TetMesh mesh = mesh_labels(read_label_map(path), options).mesh;
  mesh.region_names = label_names(path);
  return mesh;
}

}  // namespace

TetMesh with_wanted_tets(const Scene& scene, TetMesh mesh) {
  if (!scene.mesh.tets) return mesh;
  ImproveOptions options;
  options.tets = scene.mesh.tets;
  return improve(std::move(mesh), options).mesh;
}

fs::path asset_mesh_file(const std::string& name) { return assets_folder() / "meshes" / (name + ".mesh"); }

TetMesh filled_surface(const Scene& scene, const MendedSurface& surface) {
  TetgenOptions options;
  options.radius_edge_ratio = scene.mesh.radius_edge_ratio;
  // TetGen works in the file's units, the scene's max_volume is of the scaled body.
  const double scale = scene.mesh.scale;
  if (scene.mesh.max_volume) options.max_volume = *scene.mesh.max_volume / (scale * scale * scale);
  return tetrahedralize(surface, options);
}

fs::path find_file(const Scene& scene, const std::string& key, const fs::path& path) {
  std::error_code error;
  if (fs::exists(path, error)) return path;
  const fs::path beside = fs::path(scene.file).parent_path() / path.filename();
  if (scene.recorded_mesh && fs::exists(beside, error)) {
    warn("{}: {}: '{}' is gone; taking '{}' beside the recording", scene.file, key, path.string(), beside.string());
    return beside;
  }
  throw InputError(scene.file, key, fmt::format("there is no file '{}'", path.string()),
                   "paths are relative to the scene file");
}

MeshFingerprint mesh_fingerprint(const TetMesh& mesh) {
  std::uint64_t hash = 0;
  for (const Vec3& node : mesh.nodes)
    for (const double coordinate : node) hash = hash_combine(hash, coordinate);
  const auto number = [](int value) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(value)); };
  for (const Tet& tet : mesh.tets)
    for (const int node : tet) hash = hash_combine(hash, number(node));
  for (const int region : mesh.regions) hash = hash_combine(hash, number(region));
  for (const ElementField& field : mesh.fields) {
    for (const char c : field.name) hash = hash_combine(hash, number(c));
    for (const double value : field.values) hash = hash_combine(hash, value);
  }
  return {static_cast<int>(mesh.nodes.size()), static_cast<int>(mesh.tets.size()), hash};
}

TetMesh read_mesh_source(const Scene& scene, MidEdges* midedges) {
  if (!scene.solver.quadratic || scene.mesh.tets) midedges = nullptr;  // improved elements are straight
  if (scene.mesh.source) return *scene.mesh.source;
  if (!scene.mesh.file.empty())
    return with_wanted_tets(scene, read_tet_mesh(find_file(scene, "mesh.file", scene.mesh.file), midedges));
  if (!scene.mesh.surface.empty()) {
    const MendedSurface mended = mend_surface(read_surface(find_file(scene, "mesh.surface", scene.mesh.surface)));
    return with_wanted_tets(scene, filled_surface(scene, mended));
  }
  if (!scene.mesh.labels.empty()) return meshed_labels(scene);
  if (scene.mesh.box) return make_box(scene.mesh.box->size, scene.mesh.box->cells, scene.mesh.box->origin);
  return asset_mesh(scene, midedges);
}

TetMesh load_mesh(const Scene& scene, MidEdges* midedges) {
  TetMesh mesh = read_mesh_source(scene, midedges);
  const Placement placement(scene.mesh);
  for (Vec3& node : mesh.nodes) node = placement(node);
  for (ElementField& field : mesh.fields)
    for (std::size_t i = 0; field.components % 3 == 0 && i < field.values.size(); i += 3) {
      Eigen::Map<Vec3> vector(&field.values[i]);
      vector = placement.direction(vector);
    }
  const QualityReport report = checked(scene, mesh, midedges);
  if (midedges) check_midedges(mesh, *midedges);
  const std::string source = scene.mesh.box ? scene.file + ": mesh: " + mesh.source : mesh.source;
  for (const std::string& warning : report.warnings) warn("{}: {}", source, warning);
  if (!scene.mesh.box && !is_feb_file(scene.mesh.file))  // a model has all of its numbers in its unit
    if (const std::string odd = unit_warning(report.low, report.high); !odd.empty()) warn("{}: {}", mesh.source, odd);
  return mesh;
}

void check_recorded_mesh(const Scene& scene, const TetMesh& mesh) {
  if (!scene.recorded_mesh) return;
  const MeshFingerprint now = mesh_fingerprint(mesh), then = *scene.recorded_mesh;
  if (now == then) return;
  const std::string problem =
      fmt::format("was recorded on a mesh of {} nodes and {} tetrahedra (hash {:016x}); {} gives {} and {} ({:016x})",
                  then.nodes, then.tets, then.hash, mesh.source, now.nodes, now.tets, now.hash);
  throw InputError(scene.file, "recorded", problem, "replay it on the mesh it was recorded with");
}

}  // namespace heml
