#include <fmt/format.h>

#include <app/window/lost_files.hpp>
#include <app/window/screenshot.hpp>
#include <array>
#include <heml/mesh/write.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <memory>
#include <vector>

namespace heml::window {
namespace {

namespace fs = std::filesystem;

std::array<fs::path*, 3> mesh_files(MeshSpec& mesh) { return {&mesh.file, &mesh.surface, &mesh.labels}; }

/// Those that may be named besides the mesh.
std::vector<fs::path*> other_files(Scene& scene) {
  std::vector<fs::path*> files{&scene.initial_positions};
  if (scene.skin) files.insert(files.end(), {&scene.skin->file, &scene.skin->texture});
  return files;
}

void make_whole(fs::path& path) {
  std::error_code failed;
  if (const fs::path whole = fs::absolute(path, failed); !path.empty() && !failed) path = whole.lexically_normal();
}

bool is_lost(const fs::path& path) {
  std::error_code failed;
  return !path.empty() && !fs::exists(path, failed);
}

std::string put_back(const fs::path& path) {
  return fmt::format("\nIts file {} is gone: it cannot be opened before that is back.", path.string());
}

}  // namespace

void hold_files(Scene& scene) {
  const bool has_file = !scene.mesh.file.empty() || !scene.mesh.surface.empty() || !scene.mesh.labels.empty();
  if (has_file && !scene.mesh.source && !scene.solver.quadratic)
    scene.mesh.source = std::make_shared<const TetMesh>(read_mesh_source(scene));
  for (fs::path* path : mesh_files(scene.mesh)) make_whole(*path);
  for (fs::path* path : other_files(scene)) make_whole(*path);
}

std::string keep_lost_files(Scene& scene) {
  MeshSpec& mesh = scene.mesh;
  std::string told;
  for (fs::path* path : mesh_files(mesh)) {
    if (!is_lost(*path)) continue;
    if (!mesh.source) {
      told += put_back(*path);
      continue;
    }
    const fs::path file = unused_path(scene.name, ".msh", "-mesh");  // which keeps fields and names of regions
    write_tet_mesh(file, *mesh.source);
    told += fmt::format("\nThe file of its mesh, {}, is gone: the mesh is in {} now.", path->string(), file.string());
    mesh.surface.clear();
    mesh.labels.clear();
    mesh.tets.reset();  // the mesh in memory has them
    mesh.max_volume.reset();
    mesh.file = file;
    break;
  }
  for (const fs::path* path : other_files(scene))
    if (is_lost(*path)) told += put_back(*path);
  return told;
}

}  // namespace heml::window
