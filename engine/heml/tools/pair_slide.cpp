#include <cmath>
#include <heml/tools/pair_slide.hpp>

namespace heml {
namespace {

/// Of an edge e₁ and another e₂, none of them along the normal: e¹.
Vec3 dual_of(const Vec3& edge, const Vec3& other, const Vec3& normal) {
  const Vec3 across = other.cross(normal);
  return across / edge.dot(across);
}

}  // namespace

void add_pair_slides(int side, const ContactPoint& point, const std::array<Vec3, 4>& x, double force,
                     std::vector<RankOneTerm>& out) {
  if (!(force > 0)) return;
  // Ends of both edges; of a face those at its first corner.
  using Ends = std::array<std::size_t, 2>;
  const std::array<Ends, 2> ends =
      side == 0 ? std::array<Ends, 2>{{{1, 2}, {1, 3}}} : std::array<Ends, 2>{{{0, 1}, {2, 3}}};
  const auto edge = [&](const Ends& of) -> Vec3 { return x[of[1]] - x[of[0]]; };
  double square = 0;
  for (const double weight : point.weights) square += weight * weight;
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3 dual = dual_of(edge(ends[i]), edge(ends[1 - i]), point.normal);
    if (!dual.allFinite()) return;
    const double a = std::sqrt(square) * dual.norm(), b = std::sqrt(2.0);  // sizes of a and b
    for (const double sign : {1.0, -1.0}) {
      RankOneTerm term{4, point.nodes, {}, sign};
      const double scale = std::sqrt(force / 2);
      for (std::size_t k = 0; k < 4; ++k) term.g[k] = scale * std::sqrt(b / a) * point.weights[k] * dual;
      const Vec3 tilt = sign * scale * std::sqrt(a / b) * point.normal;
      term.g[ends[i][1]] += tilt;
      term.g[ends[i][0]] -= tilt;
      out.push_back(term);
    }
  }
}

}  // namespace heml
