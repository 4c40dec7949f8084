#include <fmt/format.h>

#include <app/commands/mesh_improve.hpp>
#include <app/commands/progress.hpp>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/base/write_file.hpp>
#include <heml/mesh/labels/mesh_labels.hpp>
#include <heml/mesh/mend/mend.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/mesh/read.hpp>
#include <heml/mesh/write.hpp>
#include <heml/scenario/input_files.hpp>
#include <heml/scenario/label_names.hpp>
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

void check_options(const MeshArguments& arguments) {
  const bool is_label_map = is_label_map_file(arguments.surface);
  if (is_label_map && arguments.improve)
    throw UsageError("--improve: meshes of label maps are improved as they are made; leave it out");
  if (!is_label_map && !arguments.labels.empty())
    throw UsageError("--labels goes with a label map (.nii, .nrrd, .mha)");
  if (arguments.max_volume && (is_label_map || is_tet_mesh_file(arguments.surface)))
    throw UsageError("--max-volume goes with a surface");
  if (!is_label_map && arguments.tets && !arguments.improve)
    throw UsageError("--tets goes with --improve or a label map");
  if (!is_label_map && arguments.min_angle && !arguments.improve)
    throw UsageError("--min-angle goes with --improve or a label map");
}

std::string name_of_label(int label, const std::map<int, std::string>& names) {
  const auto name = names.find(label);
  return name == names.end() ? fmt::format("label {}", label) : fmt::format("label {} ({})", label, name->second);
}

TetMesh mesh_label_map(const MeshArguments& arguments) {
  const std::map<int, std::string> names = label_names(arguments.surface);
  Progress progress("meshing labels");
  LabelMeshOptions options;
  options.tets = arguments.tets.value_or(options.tets);
  options.min_angle = arguments.min_angle.value_or(default_min_angle);
  options.progress = [&](double fraction, const char* doing) { progress.show(fraction, doing); };
  LabelMeshing meshing = mesh_labels(read_label_map(arguments.surface, arguments.labels), options);
  for (const LabelMeshing::Label& label : meshing.labels)
    fmt::print("{}: {:.6g} ml, its voxels {:.6g} ml\n", name_of_label(label.value, names), 1e6 * label.mesh_volume,
               1e6 * label.voxel_volume);
  if (!meshing.below.empty())
    warn("{} elements below {:g}° left, the first {}", meshing.below.size(),
         arguments.min_angle.value_or(default_min_angle), meshing.below[0]);
  for (Vec3& X : meshing.mesh.nodes) X *= arguments.scale;
  meshing.mesh.region_names = names;
  return std::move(meshing.mesh);
}

TetMesh read_or_fill(const MeshArguments& arguments) {
  if (is_tet_mesh_file(arguments.surface)) {
    TetMesh mesh = read_tet_mesh(arguments.surface);
    for (Vec3& X : mesh.nodes) X *= arguments.scale;
    return mesh;
  }
  TriangleMesh surface = read_surface(arguments.surface);
  for (Vec3& X : surface.nodes) X *= arguments.scale;
  TetgenOptions options;
  options.radius_edge_ratio = arguments.radius_edge_ratio;
  options.max_volume = arguments.max_volume;
  return tetrahedralize(mend_surface(std::move(surface)), options);
}

}  // namespace

int mesh_surface(const MeshArguments& arguments) {
  if (!is_written_mesh_file(arguments.out))
    throw UsageError(fmt::format("--out {}: end the name in .msh, .mesh, .vtk, .vtu or .node", arguments.out.string()));
  check_options(arguments);
  check_files(arguments);
  TetMesh mesh = is_label_map_file(arguments.surface) ? mesh_label_map(arguments) : read_or_fill(arguments);
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
