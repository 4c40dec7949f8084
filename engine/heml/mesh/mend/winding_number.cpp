#include <heml/mesh/mend/winding_number.hpp>
#include <heml/mesh/solid_angle.hpp>
#include <numbers>

namespace heml {
namespace {

constexpr double far = 2.3;  // radii of a branch, from which its dipole is taken

}  // namespace

WindingNumber::WindingNumber(TriangleMesh surface) : tree_(std::move(surface)), dipoles_(tree_.branches().size()) {
  for (std::size_t b = dipoles_.size(); b-- > 0;) {
    const SurfaceTree::Branch& branch = tree_.branches()[b];
    Dipole& sum = dipoles_[b];
    const auto add = [&sum](const Vec3& area, const Vec3& centre, double size) {
      sum.area += area;
      sum.centre += size * centre;
      sum.size += size;
    };
    if (branch.second >= 0) {
      for (const std::size_t part : {b + 1, static_cast<std::size_t>(branch.second)})
        add(dipoles_[part].area, dipoles_[part].centre, dipoles_[part].size);
    } else {
      for (const int t : tree_.triangles_of(branch)) {
        const auto x = tree_.corners(t);
        const Vec3 area = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]);
        add(area, (x[0] + x[1] + x[2]) / 3, area.norm());
      }
    }
    sum.centre = sum.size > 0 ? Vec3(sum.centre / sum.size) : branch.box.center();
    const Vec3 corner = (branch.box.max() - sum.centre).cwiseMax(sum.centre - branch.box.min());
    sum.reach = far * far * corner.squaredNorm();
  }
}

double WindingNumber::at(const Vec3& x) const {
  double angle = 0;
  std::array<int, 128> stack;
  std::size_t size = 0;
  if (!dipoles_.empty()) stack[size++] = 0;
  while (size > 0) {
    const int b = stack[--size];
    const Dipole& dipole = dipoles_[b];
    const Vec3 offset = dipole.centre - x;
    const double square = offset.squaredNorm();
    const SurfaceTree::Branch& branch = tree_.branches()[b];
    if (square > dipole.reach) {
      angle += dipole.area.dot(offset) / (square * std::sqrt(square));
    } else if (branch.second >= 0) {
      stack[size++] = b + 1;
      stack[size++] = branch.second;
    } else {
      for (const int t : tree_.triangles_of(branch)) {
        const auto corners = tree_.corners(t);
        angle += solid_angle(corners[0] - x, corners[1] - x, corners[2] - x);
      }
    }
  }
  return angle / (4 * std::numbers::pi);
}

}  // namespace heml
