#include "app/render/wound.hpp"

#include <cmath>

namespace heml::render {
namespace {

constexpr float opening = 0.006f;      // in body radii, see lip_displacements()
constexpr float least_gap = 0.002f;    // in body radii, keeps the rim of a closed cut lit
constexpr float hole_openness = 0.8f;  // of faces with nothing opposite

/// The frame of a shift: two edges and their unit normal, zero if they are parallel.
struct EdgeFrame {
  Vec3f first, second, normal;
  EdgeFrame(std::span<const Vec3f> x, int node, int a, int b)
      : first(x[a] - x[node]), second(x[b] - x[node]), normal(first.cross(second)) {
    const float length = normal.norm();
    normal = length > 0 && std::isfinite(length) ? Vec3f(normal / length) : Vec3f(Vec3f::Zero());
  }
};

}  // namespace

Wound::Wound(const SurfaceMesh& surface_mesh, float radius)
    : skin_(surface_mesh), radius_(radius), sites_(wound_sites(surface_mesh, skin_.exposed())) {
  if (!empty()) attach(surface_mesh, lip_displacements(surface_mesh, skin_, sites_, opening * radius));
  openness_.assign(surface_mesh.rest.size(), 1);
}

/// Expresses each displacement by the best shaped triangle at its node; of exposed faces where there is one, since
/// those are the same on both sides of a cut.
void Wound::attach(const SurfaceMesh& surface_mesh, const std::vector<Vec3f>& displacements) {
  struct Choice {
    Triangle corners{};
    float quality = 0;
  };
  std::vector<Choice> chosen(displacements.size());
  for (std::size_t t = 0; t < surface_mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Triangle& triangle = surface_mesh.triangles[t];
      const Triangle corners{triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3]};
      if (displacements[corners[0]].isZero(0)) continue;
      const Vec3f first = surface_mesh.rest[corners[1]] - surface_mesh.rest[corners[0]];
      const Vec3f second = surface_mesh.rest[corners[2]] - surface_mesh.rest[corners[0]];
      const float quality = first.cross(second).norm() / std::max(first.squaredNorm(), second.squaredNorm()) +
                            (exposed()[t] ? 2.0f : 0.0f);
      if (quality > chosen[corners[0]].quality) chosen[corners[0]] = {corners, quality};
    }
  for (const Choice& choice : chosen) {
    if (!(choice.quality > 0)) continue;
    const auto [node, a, b] = choice.corners;
    const EdgeFrame frame(surface_mesh.rest, node, a, b);
    const Eigen::Matrix3f axes = (Eigen::Matrix3f() << frame.first, frame.second, frame.normal).finished();
    const Vec3f weights = axes.partialPivLu().solve(displacements[node]);
    if (weights.allFinite()) shifts_.push_back({node, a, b, weights.x(), weights.y(), weights.z()});
  }
}

const std::vector<Vec3f>& Wound::place(std::span<const Vec3f> nodes) {
  placed_.assign(nodes.begin(), nodes.end());
  for (const Shift& shift : shifts_) {
    const EdgeFrame frame(nodes, shift.node, shift.a, shift.b);
    placed_[shift.node] += shift.u * frame.first + shift.v * frame.second + shift.w * frame.normal;
  }
  update_openness();
  return placed_;
}

/// A groove of width g is open at depth d by the sine of half its angle, about g / √(g² + d²).
void Wound::update_openness() {
  for (const WoundSite& site : sites_)
    for (const int node : site.nodes) {
      const float depth = skin_.places()[node].depth;
      float gap = 0;
      for (const int other : site.nodes) gap = std::max(gap, (placed_[other] - placed_[node]).norm());
      const bool is_front = std::any_of(site.around.begin(), site.around.end(),
                                        [&](int other) { return sites_[other].nodes.size() > 1; });
      if (site.nodes.size() == 1 && !is_front)
        openness_[node] = hole_openness;
      else
        openness_[node] = (gap + least_gap * radius_) / (std::hypot(gap, depth) + least_gap * radius_);
    }
}

}  // namespace heml::render
