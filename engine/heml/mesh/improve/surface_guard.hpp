#pragma once
// Decides whether a local change of the surface keeps it within a tolerance of the original, and what a surface node
// may do.
#include <heml/mesh/improve/local_mesh.hpp>
#include <heml/mesh/improve/surface_tree.hpp>
#include <optional>

namespace heml {

/// Where a node may move: anywhere, along the surface, along a crease, or nowhere.
struct NodeFreedom {
  enum class Kind { interior, smooth, crease, corner } kind = Kind::interior;
  Vec3 direction = Vec3::Zero();     ///< unit: normal of a smooth node
  std::array<int, 2> along{-1, -1};  ///< the neighbours along a crease
  std::vector<Triangle> faces;       ///< constrained ones, the node first
};

using Patch = std::vector<std::array<Vec3, 3>>;

class SurfaceGuard {
 public:
  /// tolerance: m.
  SurfaceGuard(TriangleMesh original, double tolerance)
      : original_(std::move(original)), samples_(samples_of(original_.surface())), tolerance_(tolerance) {}

  /// Whether a patch of the surface may be replaced by another with the same border: the new one is near the original
  /// and faces as it does, and what the old one was near to, the new one is near to as well. The first corner of new
  /// triangles may be a moved node, the others lie near already.
  bool allows(const Patch& removed, const Patch& added) const;
  const SurfaceTree& original() const { return original_; }
  double tolerance() const { return tolerance_; }

 private:
  bool follows_original(const std::array<Vec3, 3>& triangle) const;

  SurfaceTree original_;
  std::vector<std::vector<Vec3>> samples_;
  double tolerance_;
};

NodeFreedom freedom_of(const LocalMesh& mesh, int node);

/// Whether two faces at an edge make a crease. normals: of any length, both outward of the same region.
bool is_crease(const Vec3& normal, const Vec3& other);

Patch patch_of(const LocalMesh& mesh, const std::vector<Triangle>& faces);

}  // namespace heml
