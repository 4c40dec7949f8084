// Default scenes: the one opened without arguments, and the one made for a bare mesh or surface.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/mesh/from_surface.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/mesh/read.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/selection.hpp>

namespace heml {
namespace {

namespace fs = std::filesystem;

constexpr double constrained_part = 0.08;  // of the height, from the top
constexpr double sensible_size = 0.2;      // m, longest side given to a body whose size is implausible
constexpr double wanted_tets = 1000;       // by volume, when filling a surface; its kept triangles may lead to more

/// Bounding box of a body before scaling, in the file's units.
struct Extent {
  Vec3 low, high;
};

Extent extent_of_mesh(Scene& scene, const fs::path& path) {
  scene.mesh.file = path;
  TetMesh mesh = read_tet_mesh(path);
  const QualityReport report = check_tets(mesh);
  return {report.low, report.high};
}

double volume_of(const TriangleMesh& surface, const Vec3& inside) {
  double volume = 0;
  for (const Triangle& t : surface.triangles)
    volume += signed_volume(inside, surface.nodes[t[0]], surface.nodes[t[1]], surface.nodes[t[2]]);
  return std::abs(volume);
}

Extent extent_of_surface(Scene& scene, const fs::path& path) {
  scene.mesh.surface = path;
  TriangleMesh surface = read_surface(path);
  check_surface(surface);
  const auto [low, high] = bounds_of(surface.nodes);
  scene.mesh.max_volume = volume_of(surface, low) / wanted_tets;
  return {low, high};
}

/// Scales a body of implausible size, whose file is probably not in metres, to sensible_size, and warns.
void settle_size(Scene& scene, const Extent& extent) {
  const std::string odd = unit_warning(extent.low, extent.high);
  if (odd.empty()) return;
  const double scale = sensible_size / (extent.high - extent.low).maxCoeff();
  scene.mesh.scale = scale;
  if (scene.mesh.max_volume) *scene.mesh.max_volume *= scale * scale * scale;
  warn("{}: {}", scene.file, odd);
  warn("{}: scaled by {:.6g} to {} m in this default scene; give it a scene file with mesh.scale to choose", scene.file,
       scene.mesh.scale, sensible_size);
}

}  // namespace

Scene scene_around(const fs::path& path) {
  Scene scene;
  scene.file = path.string();
  scene.name = path.stem().string();
  Extent extent = is_tet_mesh_file(path) ? extent_of_mesh(scene, path) : extent_of_surface(scene, path);
  settle_size(scene, extent);
  extent.low *= scene.mesh.scale;
  extent.high *= scene.mesh.scale;

  const LameParameters lame = lame_parameters(1.0e4, 0.45);
  scene.materials = {{std::nullopt, {"neo_hookean", {lame.lambda, lame.mu}, 1000.0}}};
  const Vec3 size = extent.high - extent.low;
  Vec3 low = extent.low - size, high = extent.high + size;
  low.y() = extent.high.y() - constrained_part * size.y();
  scene.boundary.push_back({{{}, std::array{low, high}, std::nullopt}, {}});
  scene.gravity = Vec3(0, -9.81, 0);
  scene.solver.continuation = scene.solver.recovery = true;
  scene.solver.damping = 1;
  return scene;
}

Scene default_scene() { return read_scene(assets_folder() / "scenes" / "kidney_grasp.json"); }

fs::path assets_folder() {
  if (const char* given = std::getenv("HEML_ASSETS"); given && *given) return given;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = program.parent_path().parent_path() / "share" / "heml";
  if (!error && fs::is_directory(installed, error)) return installed;
  return HEML_SOURCE_ASSETS;
}

}  // namespace heml
