#include <algorithm>
#include <heml/mesh/improve/surface_guard.hpp>
#include <numbers>

namespace heml {
namespace {

const double cosine_of_crease = std::cos(40 * std::numbers::pi / 180);
constexpr double cosine_of_turn = 0.5;  // of a new face against the original surface

Vec3 normal_of(const std::array<Vec3, 3>& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

/// The faces at one edge of a node, as indices.
struct Spoke {
  int node;
  std::vector<std::size_t> faces;
};

std::vector<Spoke> spokes_of(const std::vector<Triangle>& faces) {
  std::vector<Spoke> spokes;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 1; k < 3; ++k) {
      auto spoke = std::find_if(spokes.begin(), spokes.end(), [&](const Spoke& s) { return s.node == faces[f][k]; });
      if (spoke == spokes.end()) spoke = spokes.insert(spokes.end(), {faces[f][k], {}});
      spoke->faces.push_back(f);
    }
  return spokes;
}

/// Whether the faces are a single fan round their first node: passing from face to face comes round to all.
bool is_one_fan(const std::vector<Triangle>& faces, const std::vector<Spoke>& spokes) {
  std::vector<char> seen(faces.size(), 0);
  std::vector<std::size_t> open{0};
  seen[0] = 1;
  std::size_t count = 1;
  while (!open.empty()) {
    const std::size_t f = open.back();
    open.pop_back();
    for (const Spoke& spoke : spokes)
      if (std::find(spoke.faces.begin(), spoke.faces.end(), f) != spoke.faces.end())
        for (const std::size_t g : spoke.faces)
          if (!seen[g]) {
            seen[g] = 1;
            ++count;
            open.push_back(g);
          }
  }
  return count == faces.size();
}

bool is_near(const Vec3& x, const Patch& patch, double distance) {
  return std::any_of(patch.begin(), patch.end(), [&](const std::array<Vec3, 3>& triangle) {
    return (nearest_on_triangle(x, triangle) - x).squaredNorm() <= distance * distance;
  });
}

}  // namespace

bool is_crease(const Vec3& normal, const Vec3& other) {
  return !(normal.dot(other) > cosine_of_crease * normal.norm() * other.norm());
}

Patch patch_of(const LocalMesh& mesh, const std::vector<Triangle>& faces) {
  Patch patch;
  for (const auto& [a, b, c] : faces) patch.push_back({mesh.node(a), mesh.node(b), mesh.node(c)});
  return patch;
}

NodeFreedom freedom_of(const LocalMesh& mesh, int node) {
  using Kind = NodeFreedom::Kind;
  NodeFreedom freedom;
  if (!mesh.is_on_surface(node)) return freedom;
  freedom.faces = mesh.surface_faces(node);
  freedom.kind = Kind::corner;
  if (freedom.faces.empty()) return freedom;
  const auto spokes = spokes_of(freedom.faces);
  const Patch patch = patch_of(mesh, freedom.faces);
  if (!is_one_fan(freedom.faces, spokes)) return freedom;
  std::vector<int> creases;
  for (const Spoke& spoke : spokes)
    if (spoke.faces.size() != 2 || is_crease(normal_of(patch[spoke.faces[0]]), normal_of(patch[spoke.faces[1]])))
      creases.push_back(spoke.node);
  if (creases.size() == 2) {
    freedom.kind = Kind::crease;
    freedom.along = {creases[0], creases[1]};
  } else if (creases.empty()) {
    freedom.kind = Kind::smooth;
    for (const auto& triangle : patch) freedom.direction += normal_of(triangle);
    freedom.direction.normalize();
  }
  return freedom;
}

bool SurfaceGuard::follows_original(const std::array<Vec3, 3>& triangle) const {
  const auto& [a, b, c] = triangle;
  for (const Vec3& x : {a, Vec3((a + b) / 2), Vec3((b + c) / 2), Vec3((c + a) / 2)})
    if (!original_.is_within(x, tolerance_)) return false;
  const auto nearest = original_.nearest((a + b + c) / 3, tolerance_);
  if (nearest.triangle < 0) return false;
  const Vec3 normal = normal_of(triangle), there = normal_of(original_.corners(nearest.triangle));
  return normal.dot(there) >= cosine_of_turn * normal.norm() * there.norm();
}

bool SurfaceGuard::allows(const Patch& removed, const Patch& added) const {
  for (const auto& triangle : added)
    if (!follows_original(triangle)) return false;
  Eigen::AlignedBox3d box;
  for (const auto& triangle : removed)
    for (const Vec3& x : triangle) box.extend(x);
  box.min().array() -= tolerance_;
  box.max().array() += tolerance_;
  for (const int t : original_.overlapping(box))
    for (const Vec3& x : samples_[t])
      if (box.contains(x) && !is_near(x, added, tolerance_) && is_near(x, removed, tolerance_)) return false;
  return true;
}

}  // namespace heml
