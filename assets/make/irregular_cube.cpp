#include <algorithm>
#include <random>

#include "fill.hpp"
#include "improve.hpp"
#include "organ.hpp"
#include "reconnect.hpp"

namespace heml::make {
namespace {

constexpr double side = 0.1;    // m
constexpr double edge = 0.025;  // m, about the distance between neighbours

/// Adds points where `place` puts three random numbers of [0, 1), none nearer to another than a distance that shrinks
/// slowly with every refusal.
template <class Place>
void scatter(std::vector<Vec3>& points, int count, std::mt19937& random, const Place& place) {
  const auto number = [&] { return static_cast<double>(random()) / 4294967296.0; };
  double apart = edge;
  while (count > 0) {
    const double u = number(), v = number(), w = number();
    const Vec3 p = place(u, v, w);
    if (std::ranges::all_of(points, [&](const Vec3& q) { return (p - q).norm() > apart; })) {
      points.push_back(p);
      --count;
    } else {
      apart *= 0.9995;
    }
  }
}

/// Corners, edges in quarters that are not quite even, then faces and inside.
std::vector<Vec3> cloud(unsigned seed, int on_face, int inside) {
  std::mt19937 random(seed);
  std::vector<Vec3> points;
  for (int corner = 0; corner < 8; ++corner)
    points.push_back(side * Vec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1));
  for (int axis = 0; axis < 3; ++axis)
    for (int line = 0; line < 4; ++line)
      for (int quarter = 1; quarter < 4; ++quarter) {
        Vec3 p;
        p[axis] = side * (quarter + 0.3 * (random() / 4294967296.0 - 0.5)) / 4;
        p[(axis + 1) % 3] = line & 1 ? side : 0;
        p[(axis + 2) % 3] = line & 2 ? side : 0;
        points.push_back(p);
      }
  for (int face = 0; face < 6; ++face)
    scatter(points, on_face, random, [&](double u, double v, double) {
      Vec3 p;
      p[face / 2] = face % 2 ? side : 0;
      p[(face / 2 + 1) % 3] = side * u;
      p[(face / 2 + 2) % 3] = side * v;
      return p;
    });
  scatter(points, inside, random, [](double u, double v, double w) { return Vec3(side * Vec3(u, v, w)); });
  return points;
}

}  // namespace

TetMesh irregular_cube() {
  const std::vector<Vec3> points = cloud(15, 16, 11);
  TetMesh mesh = delaunay(points);
  // What lies on a face, an edge or a corner stays there.
  const Constraint stay = [&](int n, const Vec3& p) {
    Vec3 place = p.cwiseMax(0.002).cwiseMin(side - 0.002);
    for (int axis = 0; axis < 3; ++axis)
      if (points[n][axis] == 0 || points[n][axis] == side) place[axis] = points[n][axis];
    return place;
  };
  const Quality quality{edge};
  for (int round = 0; round < 6; ++round) {
    for (int sweep = 0; sweep < 10 && reconnect(mesh, {quality, 0.3, 0.999}); ++sweep) {
    }
    smooth(mesh, quality, stay, 0.35, 3);
  }
  mesh.source = "irregular_cube";
  return mesh;
}

}  // namespace heml::make
