#include <app/panel/piece.hpp>
#include <numeric>

namespace heml::panel {

int Piece::root(int node) {
  while (roots_[static_cast<std::size_t>(node)] != node) {
    int& above = roots_[static_cast<std::size_t>(node)];
    above = roots_[static_cast<std::size_t>(above)];
    node = above;
  }
  return node;
}

/// Triangles join the mid-edge nodes of quadratic elements to the corners.
void Piece::find(const Frame& frame) {
  solid_ = frame.solid;
  surface_mesh_ = frame.surface_mesh;
  roots_.resize(solid_->rest.size());
  std::iota(roots_.begin(), roots_.end(), 0);
  const auto join = [&](int a, int b) { roots_[static_cast<std::size_t>(root(a))] = root(b); };
  for (const Tet& tet : solid_->tets)
    for (int k = 1; k < 4; ++k) join(tet[0], tet[k]);
  const std::vector<int>& nodes = surface_mesh_->nodes;
  for (const Triangle& triangle : surface_mesh_->triangles)
    for (std::size_t k = 1; k < 3; ++k)
      join(nodes[static_cast<std::size_t>(triangle[0])], nodes[static_cast<std::size_t>(triangle[k])]);
}

std::optional<PieceSize> Piece::size_of(int node, const Frame& frame) {
  if (!frame.solid || !frame.surface_mesh || frame.solid_positions.size() != frame.solid->rest.size())
    return std::nullopt;
  if (frame.solid != solid_ || frame.surface_mesh != surface_mesh_) find(frame);
  if (node < 0 || node >= std::ssize(roots_)) return std::nullopt;
  const int wanted = root(node);
  PieceSize size;
  const auto at = [&](int n) -> Vec3 { return frame.solid_positions[static_cast<std::size_t>(n)].cast<double>(); };
  for (const Tet& tet : solid_->tets) {
    if (root(tet[0]) != wanted) continue;
    const Vec3 origin = at(tet[0]);
    size.volume += (at(tet[1]) - origin).dot((at(tet[2]) - origin).cross(at(tet[3]) - origin)) / 6;
  }
  for (const Triangle& triangle : surface_mesh_->triangles) {
    const auto corner = [&](std::size_t k) { return surface_mesh_->nodes[static_cast<std::size_t>(triangle[k])]; };
    if (root(corner(0)) != wanted) continue;
    size.area += (at(corner(1)) - at(corner(0))).cross(at(corner(2)) - at(corner(0))).norm() / 2;
  }
  return size.volume == 0 ? std::nullopt : std::optional(size);
}

}  // namespace heml::panel
