#include <cmath>
#include <heml/mesh/labels/label_map.hpp>
#include <heml/mesh/read.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <heml/scenario/mesh_findings.hpp>
#include <heml/scenario/selection.hpp>
#include <heml/scenario/take_mesh.hpp>

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

}  // namespace

void take_mesh(Scene& scene, const std::filesystem::path& path) {
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

}  // namespace heml
