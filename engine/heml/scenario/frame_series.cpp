#include <fmt/format.h>

#include <heml/base/write_file.hpp>
#include <heml/mesh/write_surface.hpp>
#include <heml/scenario/animation.hpp>
#include <heml/scenario/frame_series.hpp>
#include <numeric>
#include <utility>

namespace heml {
namespace {

namespace fs = std::filesystem;

std::vector<double> flat(const std::vector<Vec3>& vectors) {
  std::vector<double> values;
  values.reserve(3 * vectors.size());
  for (const Vec3& v : vectors) values.insert(values.end(), v.data(), v.data() + 3);
  return values;
}

/// A field of a world at given nodes.
NodeField field_of(World& world, const char* name, Field field, const std::vector<int>& nodes) {
  std::vector<float> values;
  world.write_field(field, nodes, values);
  return {name, 1, {values.begin(), values.end()}};
}

void write_body(const fs::path& path, World& world) {
  const WorldSetup& setup = world.setup();
  const std::vector<int>& elements = world.topology()->elements;
  TetMesh mesh = with_elements(setup.mesh, elements);
  std::vector<int> all(mesh.nodes.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<Vec3> displacement = world.positions();
  for (std::size_t n = 0; n < displacement.size(); ++n) displacement[n] -= mesh.nodes[n];
  mesh.nodes = world.positions();
  mesh.fields.push_back({"J", 1, world.volume_ratios()});
  if (!mesh.burns.empty()) {
    ElementField& burnt = mesh.fields.emplace_back(ElementField{"burnt", 1, {}});
    for (const Burn& burn : mesh.burns) burnt.values.push_back(burn.level);
  }
  if (const std::vector<Mat3> stresses = world.stresses(); !stresses.empty()) {
    ElementField& field = mesh.fields.emplace_back(ElementField{"stress", 9, {}});
    for (const Mat3& sigma : stresses) field.values.insert(field.values.end(), sigma.data(), sigma.data() + 9);
  }
  write_vtu(path, mesh,
            {{"displacement", 3, flat(displacement)},
             {"velocity", 3, flat(world.velocities())},
             field_of(world, "stretch", Field::stretch, all),
             field_of(world, "von_mises", Field::von_mises, all)},
            with_elements(setup.midedges, elements));
}

void write_surface_mesh(const fs::path& path, World& world) {
  WorldSurface surface = surface_of(world);
  const std::vector<Vec3> positions = world.positions();
  TriangleMesh mesh;
  for (const int n : surface.nodes) mesh.nodes.push_back(positions[static_cast<std::size_t>(n)]);
  mesh.triangles = std::move(surface.triangles);
  const std::vector<int>& nodes = surface.nodes;
  write_surface(
      path, mesh,
      {field_of(world, "displacement", Field::displacement, nodes), field_of(world, "stretch", Field::stretch, nodes),
       field_of(world, "von_mises", Field::von_mises, nodes),
       field_of(world, "volume_ratio", Field::volume_ratio, nodes)});
}

}  // namespace

void write_frame(const fs::path& path, World& world) {
  path.extension() == ".vtu" ? write_body(path, world) : write_surface_mesh(path, world);
}

FrameSeries::FrameSeries(fs::path folder, std::string ending) : folder_(std::move(folder)), ending_(std::move(ending)) {
  make_folder(folder_);
}

void FrameSeries::add_frame(World& world) {
  files_.push_back({world.time(), fmt::format("frame_{:05}.{}", files_.size(), ending_)});
  write_frame(folder_ / files_.back().file, world);
  if (ending_ == "vtu") write_pvd(folder_ / "frames.pvd", files_);
}

}  // namespace heml
