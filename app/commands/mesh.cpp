#include <fmt/format.h>

#include <app/commands/mesh_improve.hpp>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/base/write_file.hpp>
#include <heml/mesh/from_surface.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/mesh/read.hpp>
#include <heml/mesh/write.hpp>
#include <heml/scenario/input_files.hpp>
#include <vector>

namespace heml {

namespace {

/// The files of a mesh: two for TetGen's format, else one.
std::vector<std::filesystem::path> files_of_mesh(const std::filesystem::path& path) {
  if (path.extension() != ".node" && path.extension() != ".ele") return {path};
  return {std::filesystem::path(path).replace_extension(".node"),
          std::filesystem::path(path).replace_extension(".ele")};
}

void check_files(const MeshArguments& arguments) {
  refuse_overwriting(files_of_mesh(arguments.surface), files_of_mesh(arguments.out));
  for (const std::filesystem::path& file : files_of_mesh(arguments.out)) expect_writable_file(file);
}

TetMesh read_or_fill(const MeshArguments& arguments) {
  if (is_tet_mesh_file(arguments.surface)) {
    TetMesh mesh = read_tet_mesh(arguments.surface);
    for (Vec3& X : mesh.nodes) X *= arguments.scale;
    return mesh;
  }
  TriangleMesh surface = read_surface(arguments.surface);
  for (Vec3& X : surface.nodes) X *= arguments.scale;
  check_surface(surface);
  TetgenOptions options;
  options.radius_edge_ratio = arguments.radius_edge_ratio;
  options.max_volume = arguments.max_volume;
  return tetrahedralize(surface, options);
}

}  // namespace

int mesh_surface(const MeshArguments& arguments) {
  if (!is_tet_mesh_file(arguments.out))
    throw UsageError(fmt::format("--out {}: end the name in .msh, .mesh, .vtk, .vtu or .node", arguments.out.string()));
  check_files(arguments);
  TetMesh mesh = read_or_fill(arguments);
  if (arguments.improve) mesh = improve_and_print(mesh, arguments);
  const QualityReport report = check_tets(mesh);
  write_tet_mesh(arguments.out, mesh);
  for (const std::string& text : report.warnings) warn("{}", text);
  if (const std::string odd = unit_warning(report.low, report.high); !odd.empty()) warn("{} (--scale changes it)", odd);
  if (arguments.improve)  // standard output holds the lines of JSON alone
    log_info("written to {}", arguments.out.string());
  else
    fmt::print("{}written to {}\n", to_text(report), arguments.out.string());
  return exit_done;
}

}  // namespace heml
