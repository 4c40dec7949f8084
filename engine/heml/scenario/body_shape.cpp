#include <algorithm>
#include <heml/base/error.hpp>
#include <heml/mesh/from_surface.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/scenario/body_shape.hpp>
#include <numeric>

namespace heml {
namespace {

constexpr double sensible_size = 0.2;                // m
constexpr double min_organ = 0.05, max_organ = 0.5;  // m
constexpr double flat_depth = 0.01;                  // of the extent: faces so near the end belong to its base
constexpr double flat_cosine = 0.98;                 // of the angle between a base's normal and the axis
constexpr double is_base = 0.25, is_no_base = 0.1;   // flat_base()
constexpr double round_off = 1e-9;                   // of the height

Vec3 area_vector(const TetMesh& mesh, const Triangle& face) {
  const Vec3 &a = mesh.nodes[face[0]], &b = mesh.nodes[face[1]], &c = mesh.nodes[face[2]];
  return (b - a).cross(c - a) / 2;
}

using Point = Eigen::Vector2d;

double turn(const Point& a, const Point& b, const Point& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// Convex hull, anticlockwise (Andrew's monotone chain).
std::vector<Point> hull_of(std::vector<Point> points) {
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Point> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Point& p : points) {
      while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

bool is_inside(const std::vector<Point>& hull, const Point& p) {
  if (hull.size() < 3) return false;
  for (std::size_t k = 0; k < hull.size(); ++k)
    if (turn(hull[k], hull[(k + 1) % hull.size()], p) < 0) return false;
  return true;
}

/// Whether the centre of the body's volume is above or below the nodes of a support.
bool is_balanced(const TetMesh& mesh, const BodyShape& shape, const Support& support) {
  std::vector<Point> points;
  for (const int n : shape.nodes) {
    const Vec3& x = mesh.nodes[n];
    if (support.top ? x.y() >= support.height : x.y() <= support.height) points.emplace_back(x.x(), x.z());
  }
  return points.size() >= 3 && is_inside(hull_of(std::move(points)), Point(shape.centre.x(), shape.centre.z()));
}

bool is_plausible(double length) { return unit_warning(Vec3::Zero(), Vec3::Constant(length)).empty(); }

}  // namespace

BodyShape shape_of(const TetMesh& mesh) {
  BodyShape shape;
  shape.faces = extract_boundary(mesh);
  for (const Triangle& face : shape.faces.triangles) {
    shape.nodes.insert(shape.nodes.end(), face.begin(), face.end());
    shape.area += area_vector(mesh, face).norm();
  }
  std::sort(shape.nodes.begin(), shape.nodes.end());
  shape.nodes.erase(std::unique(shape.nodes.begin(), shape.nodes.end()), shape.nodes.end());
  if (shape.nodes.empty())
    throw InputError(mesh.source, "", "has no surface: its elements overlap",
                     "remove elements that are given twice or overlap");
  shape.low = shape.high = mesh.nodes[shape.nodes.front()];
  for (const int n : shape.nodes) {
    shape.low = shape.low.cwiseMin(mesh.nodes[n]);
    shape.high = shape.high.cwiseMax(mesh.nodes[n]);
  }
  double volume = 0;
  shape.centre.setZero();
  for (const Tet& tet : mesh.tets) {
    const Vec3 &a = mesh.nodes[tet[0]], &b = mesh.nodes[tet[1]], &c = mesh.nodes[tet[2]], &d = mesh.nodes[tet[3]];
    const double part = signed_volume(a, b, c, d);
    shape.centre += part * (a + b + c + d) / 4;
    volume += part;
  }
  shape.centre /= volume;
  return shape;
}

LengthUnit guess_unit(double length) {
  if (is_plausible(length)) return {"metres", 1};
  for (const LengthUnit& unit : {LengthUnit{"centimetres", 0.01}, LengthUnit{"millimetres", 0.001}})
    if (length * unit.scale >= min_organ && length * unit.scale <= max_organ) return unit;
  return {"", sensible_size / length};
}

std::vector<LengthUnit> plausible_units(double length) {
  std::vector<LengthUnit> units{{"metres", 1},          {"decimetres", 0.1},   {"centimetres", 0.01},
                                {"millimetres", 0.001}, {"micrometres", 1e-6}, {"inches", 0.0254}};
  std::erase_if(units, [&](const LengthUnit& unit) { return !is_plausible(unit.scale * length); });
  units.push_back({"", sensible_size / length});
  return units;
}

double flat_base(const TetMesh& mesh, const BodyShape& shape, int axis) {
  const Vec3 size = shape.size();
  const double end = shape.low[axis] + flat_depth * size[axis];
  double area = 0;
  for (const Triangle& face : shape.faces.triangles) {
    if (!(mesh.nodes[face[0]][axis] <= end && mesh.nodes[face[1]][axis] <= end && mesh.nodes[face[2]][axis] <= end))
      continue;
    const Vec3 vector = area_vector(mesh, face);
    if (-vector[axis] >= flat_cosine * vector.norm()) area += vector.norm();
  }
  return area * size[axis] / size.prod();
}

UpAxis guess_up(const TetMesh& mesh, const BodyShape& shape) {
  return flat_base(mesh, shape, 2) >= is_base && flat_base(mesh, shape, 1) < is_no_base ? UpAxis::z : UpAxis::y;
}

Support support_at(bool top, const TetMesh& mesh, const BodyShape& shape, double share) {
  const double sign = top ? -1 : 1;
  const auto height = [&](const Triangle& face) {
    return (mesh.nodes[face[0]].y() + mesh.nodes[face[1]].y() + mesh.nodes[face[2]].y()) / 3;
  };
  std::vector<std::size_t> order(shape.faces.triangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return sign * height(shape.faces.triangles[a]) < sign * height(shape.faces.triangles[b]);
  });
  double area = 0, reached = 0;
  for (const std::size_t k : order) {
    reached = height(shape.faces.triangles[k]);
    area += area_vector(mesh, shape.faces.triangles[k]).norm();
    if (area >= share * shape.area) break;
  }
  return {top, reached + sign * round_off * shape.size().y(), area / shape.area};
}

Support choose_support(const TetMesh& mesh, const BodyShape& shape, double share) {
  const Support underside = support_at(false, mesh, shape, share);
  if (is_balanced(mesh, shape, underside)) return underside;
  const Support top = support_at(true, mesh, shape, share);
  return is_balanced(mesh, shape, top) ? top : underside;
}

}  // namespace heml
