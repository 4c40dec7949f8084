#include "contour.hpp"

#include <algorithm>
#include <map>

namespace heml::make {
namespace {

using Index = Eigen::Vector3i;

struct Grid {
  Vec3 low;
  double cell;
  Index size;                  ///< corners along each axis
  std::vector<double> values;  ///< f at the corners

  int at(const Index& i) const { return (i.z() * size.y() + i.y()) * size.x() + i.x(); }
  Vec3 place(int corner) const {
    return low + cell * Vec3(corner % size.x(), corner / size.x() % size.y(), corner / (size.x() * size.y()));
  }
};

Grid sample(const Shape& shape, const Vec3& low, const Vec3& high, double cell) {
  Grid grid{low, cell, ((high - low) / cell).array().ceil().cast<int>() + 1, {}};
  grid.values.resize(std::size_t(grid.size.prod()));
  for (int corner = 0; corner < int(grid.values.size()); ++corner) grid.values[corner] = shape(grid.place(corner));
  return grid;
}

class Contour {
 public:
  explicit Contour(const Grid& grid) : grid_(grid) {}

  /// The triangle or two that separate the inner from the outer corners of a tetrahedron.
  void cut(const std::array<int, 4>& tet) {
    std::vector<int> in, out;
    for (const int corner : tet) (grid_.values[corner] < 0 ? in : out).push_back(corner);
    if (in.empty() || out.empty()) return;
    const Vec3 outward = mean(out) - mean(in);
    if (in.size() == 2) {
      const int a = node(in[0], out[0]), b = node(in[0], out[1]), c = node(in[1], out[1]), d = node(in[1], out[0]);
      add({a, b, c}, outward);
      add({a, c, d}, outward);
    } else {
      const auto& three = in.size() == 3 ? in : out;
      const int one = in.size() == 3 ? out[0] : in[0];
      add({node(one, three[0]), node(one, three[1]), node(one, three[2])}, outward);
    }
  }

  TriangleMesh mesh;

 private:
  Vec3 mean(const std::vector<int>& corners) const {
    Vec3 sum = Vec3::Zero();
    for (const int corner : corners) sum += grid_.place(corner);
    return sum / double(corners.size());
  }

  /// The node on the grid edge a–b, kept a little off its ends so that no triangle is degenerate.
  int node(int a, int b) {
    if (a > b) std::swap(a, b);
    const auto [entry, fresh] = nodes_.try_emplace({a, b}, int(mesh.nodes.size()));
    if (fresh) {
      const double fa = grid_.values[a], fb = grid_.values[b];
      mesh.nodes.push_back(grid_.place(a) + std::clamp(fa / (fa - fb), 0.1, 0.9) * (grid_.place(b) - grid_.place(a)));
    }
    return entry->second;
  }

  void add(Triangle t, const Vec3& outward) {
    const Vec3 &x0 = mesh.nodes[t[0]], &x1 = mesh.nodes[t[1]], &x2 = mesh.nodes[t[2]];
    if ((x1 - x0).cross(x2 - x0).dot(outward) < 0) std::swap(t[1], t[2]);
    mesh.triangles.push_back(t);
  }

  const Grid& grid_;
  std::map<std::pair<int, int>, int> nodes_;
};

}  // namespace

TriangleMesh contour(const Shape& shape, const Vec3& low, const Vec3& high, double cell) {
  const Grid grid = sample(shape, low, high, cell);
  Contour contour(grid);
  for (int z = 0; z + 1 < grid.size.z(); ++z)
    for (int y = 0; y + 1 < grid.size.y(); ++y)
      for (int x = 0; x + 1 < grid.size.x(); ++x) {
        // One tetrahedron for each order in which the three axes can be walked from a corner to the opposite one.
        Index order(0, 1, 2);
        do {
          Index i(x, y, z);
          std::array<int, 4> tet{grid.at(i)};
          for (int step = 0; step < 3; ++step) tet[step + 1] = grid.at(i += Index::Unit(order[step]));
          contour.cut(tet);
        } while (std::next_permutation(order.data(), order.data() + 3));
      }
  return std::move(contour.mesh);
}

}  // namespace heml::make
