#include <fmt/format.h>

#include <app/commands/commands.hpp>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/mesh/from_surface.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/mesh/read.hpp>
#include <heml/mesh/write.hpp>

namespace heml {

int mesh_surface(const MeshArguments& arguments) {
  if (!(arguments.scale > 0)) throw UsageError(fmt::format("--scale must be greater than 0, is {}", arguments.scale));
  if (!is_tet_mesh_file(arguments.out))
    throw UsageError(fmt::format("--out {}: end the name in .msh, .mesh, .vtk, .vtu or .node", arguments.out.string()));
  TetMesh mesh;
  if (is_tet_mesh_file(arguments.surface)) {
    mesh = read_tet_mesh(arguments.surface);
    for (Vec3& X : mesh.nodes) X *= arguments.scale;
  } else {
    SurfaceMesh surface = read_surface(arguments.surface);
    for (Vec3& X : surface.nodes) X *= arguments.scale;
    check_surface(surface);
    TetgenOptions options;
    options.radius_edge_ratio = arguments.radius_edge_ratio;
    options.max_volume = arguments.max_volume;
    mesh = tetrahedralize(surface, options);
  }
  const QualityReport report = check_tets(mesh);
  write_tet_mesh(arguments.out, mesh);
  for (const std::string& text : report.warnings) warn("{}", text);
  if (const std::string odd = unit_suspicion(report.low, report.high); !odd.empty())
    warn("{} (--scale changes it)", odd);
  fmt::print("{}written to {}\n", to_text(report), arguments.out.string());
  return exit_done;
}

}  // namespace heml
