#include <fmt/format.h>

#include <heml/base/error.hpp>
#include <heml/mesh/edit.hpp>
#include <heml/scenario/animation.hpp>

namespace heml {

WorldSurface surface_of(World& world) {
  const WorldSetup& setup = world.setup();
  BoundaryFaces faces = fine_boundary(setup.mesh, setup.midedges, *world.topology());
  WorldSurface surface;
  std::vector<int> number(setup.mesh.nodes.size(), -1);
  for (Triangle& triangle : faces.triangles)
    for (int& n : triangle) {
      int& own = number[static_cast<std::size_t>(n)];
      if (own < 0) {
        own = static_cast<int>(surface.nodes.size());
        surface.nodes.push_back(n);
      }
      n = own;
    }
  surface.triangles = std::move(faces.triangles);
  surface.tets = std::move(faces.tets);
  return surface;
}

void Animation::begin_part(World& world) {
  AnimationPart& part = parts_.emplace_back();
  part.surface = surface_of(world);
  const TetMesh mesh = with_elements(world.setup().mesh, world.topology()->elements);
  for (const int t : part.surface.tets) part.regions.push_back(mesh.regions[static_cast<std::size_t>(t)]);
  if (extent_ == Extent::body) {
    part.tets = mesh.tets;
    part.tet_regions = mesh.regions;
  }
  version_ = world.topology()->version;
}

void Animation::add_frame(World& world) {
  constexpr std::size_t max_bytes = 1'000'000'000;
  if (parts_.empty() || world.topology()->version != version_) begin_part(world);
  AnimationPart& part = parts_.back();
  const std::vector<Vec3> positions = world.positions();
  const bool whole = extent_ == Extent::body;
  const std::size_t count = whole ? positions.size() : part.surface.nodes.size();
  bytes_ += count * sizeof(Vec3f);
  if (bytes_ > max_bytes)
    throw InputError(file_, "", fmt::format("{} frames of {} nodes take more than 1 GB", taken_ + 1, count),
                     "fewer frames a second (--fps), or --format vtu, a file each");
  std::vector<Vec3f>& frame = part.positions.emplace_back();
  frame.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    frame.push_back(positions[whole ? i : static_cast<std::size_t>(part.surface.nodes[i])].cast<float>());
  part.times.push_back(world.time());
  ++taken_;
}

}  // namespace heml
