#include <cmath>
#include <heml/base/log.hpp>
#include <heml/base/warning_collector.hpp>
#include <heml/mesh/labels/label_map.hpp>
#include <heml/mesh/read.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <heml/scenario/mesh_findings.hpp>
#include <heml/scenario/selection.hpp>
#include <heml/scenario/take_mesh.hpp>
#include <mutex>

namespace heml {
namespace {

constexpr double wanted_tets = 1000;  // by volume, when filling a surface; its kept triangles may lead to more
constexpr int label_tets = 10000;     // of a label map: in real time on one core

double volume_of(const TriangleMesh& surface, const Vec3& inside) {
  double volume = 0;
  for (const Triangle& t : surface.triangles)
    volume += signed_volume(inside, surface.nodes[t[0]], surface.nodes[t[1]], surface.nodes[t[2]]);
  return std::abs(volume);
}

/// Names the file as the scene's mesh, and reads or fills it.
TetMesh mesh_of(Scene& scene, const std::filesystem::path& path) {
  const std::optional<int>& wanted = scene.chosen->given.tets;
  if (is_tet_mesh_file(path)) {
    scene.mesh.file = path;
    return read_mesh_source(scene);
  }
  if (is_label_map_file(path)) {
    scene.mesh.labels = path;
    scene.mesh.label_tets = wanted.value_or(label_tets);
    return read_mesh_source(scene);
  }
  scene.mesh.surface = path;
  const MendedSurface mended = mend_surface(read_surface(path));
  const TriangleMesh& surface = mended.surface;
  scene.chosen->findings = findings_of(mended.report);
  if (mended.report.unmended.empty())
    scene.mesh.max_volume =
        volume_of(surface, bounds_of(surface.nodes).first) / (wanted ? static_cast<double>(*wanted) : wanted_tets);
  return filled_surface(scene, mended);
}

/// Reads the mesh, improves it where a number of elements is given, and lists what was wrong. A label map needs no
/// improvement.
void read_mesh(Scene& scene, const std::filesystem::path& path) {
  BareMeshChoices& chosen = *scene.chosen;
  const TetMesh read = mesh_of(scene, path);
  TetMesh mesh = read, checked = read;
  const QualityReport report = check_tets(checked);
  QualityReport now = report;
  if (chosen.given.tets && scene.mesh.labels.empty()) {
    scene.mesh.tets = chosen.given.tets;
    checked = mesh = with_wanted_tets(scene, read);
    now = check_tets(checked);
  }
  for (BareMeshChoices::Finding& finding : findings_of(read, report, scene.mesh.tets ? &now : nullptr))
    chosen.findings.push_back(std::move(finding));
  chosen.read_tets = report.tets;
  chosen.tets = now.tets;
  chosen.min_dihedral = now.worst_dihedral;
  scene.mesh.source = std::make_shared<const TetMesh>(std::move(mesh));
}

/// The mesh that was taken last. In the window the same file is opened again for each choice, and to mend, fill or
/// improve it takes seconds.
class LastMesh {
 public:
  /// Takes it where it is of this file, which has not changed since, and of this number of elements. Returns whether it
  /// is.
  bool take(Scene& scene, const std::filesystem::path& path) {
    const std::scoped_lock lock(mutex_);
    if (!made_of_ || made_of_ != source_of(scene, path)) return false;
    scene.mesh = mesh_;
    scene.chosen->findings = chosen_.findings;
    scene.chosen->read_tets = chosen_.read_tets;
    scene.chosen->tets = chosen_.tets;
    scene.chosen->min_dihedral = chosen_.min_dihedral;
    for (const std::string& text : warnings_) warn("{}", text);
    return true;
  }

  void keep(const Scene& scene, const std::filesystem::path& path, std::vector<std::string> warnings) {
    const std::scoped_lock lock(mutex_);
    made_of_ = source_of(scene, path);
    if (!made_of_) return;
    mesh_ = scene.mesh;
    chosen_ = *scene.chosen;
    warnings_ = std::move(warnings);
  }

 private:
  struct Source {
    std::filesystem::path file;
    std::filesystem::file_time_type written;
    std::uintmax_t bytes = 0;
    std::optional<int> tets;
    bool operator==(const Source&) const = default;
  };

  /// None for meshes of several files, and where the file cannot be looked at.
  static std::optional<Source> source_of(const Scene& scene, const std::filesystem::path& path) {
    const bool has_more_files = is_label_map_file(path) || path.extension() == ".node" || path.extension() == ".ele";
    std::error_code failed, unknown;
    Source source{path, std::filesystem::last_write_time(path, failed), std::filesystem::file_size(path, unknown),
                  scene.chosen->given.tets};
    if (has_more_files || failed || unknown) return std::nullopt;
    return source;
  }

  std::mutex mutex_;
  std::optional<Source> made_of_;
  MeshSpec mesh_;
  BareMeshChoices chosen_;
  std::vector<std::string> warnings_;
};

}  // namespace

void take_mesh(Scene& scene, const std::filesystem::path& path) {
  static LastMesh last;
  if (last.take(scene, path)) return;
  const WarningCollector warnings;
  read_mesh(scene, path);
  last.keep(scene, path, warnings.texts());
}

}  // namespace heml
