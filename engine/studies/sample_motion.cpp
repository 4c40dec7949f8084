#include <limits>
#include <studies/sample_motion.hpp>

namespace heml {
namespace {

/// Barycentric coordinates in a tetrahedron: inside it, all four are ≥ 0.
struct Barycentric {
  std::array<double, 4> weight;
  double least() const { return *std::min_element(weight.begin(), weight.end()); }
};

class Elements {
 public:
  explicit Elements(const TetMesh& mesh) {
    for (const Tet& tet : mesh.tets) {
      const auto at = [&](std::size_t a) { return mesh.nodes[static_cast<std::size_t>(tet[a])]; };
      Mat3 edges;
      edges << at(1) - at(0), at(2) - at(0), at(3) - at(0);
      origin_.push_back(at(0));
      inverse_.push_back(edges.inverse());
    }
  }
  Barycentric at(std::size_t t, const Vec3& point) const {
    const Vec3 b = inverse_[t] * (point - origin_[t]);
    return {{1 - b.sum(), b.x(), b.y(), b.z()}};
  }
  std::size_t count() const { return origin_.size(); }

 private:
  std::vector<Vec3> origin_;
  std::vector<Mat3> inverse_;
};

}  // namespace

std::vector<Vec3> sample_motion(const TetMesh& mesh, const std::vector<Vec3>& x, const std::vector<Vec3>& points) {
  const Elements elements(mesh);
  std::vector<Vec3> result;
  result.reserve(points.size());
  for (const Vec3& point : points) {
    double best = -std::numeric_limits<double>::infinity();
    std::size_t holder = 0;
    for (std::size_t t = 0; t < elements.count() && best < 0; ++t)
      if (const double least = elements.at(t, point).least(); least > best) best = least, holder = t;
    const Barycentric b = elements.at(holder, point);
    Vec3 at = Vec3::Zero();
    for (std::size_t a = 0; a < 4; ++a) at += b.weight[a] * x[static_cast<std::size_t>(mesh.tets[holder][a])];
    result.push_back(at);
  }
  return result;
}

}  // namespace heml
