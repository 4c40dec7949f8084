#pragma once
// Bodies with bad elements, and what every operation promises.
#include <doctest/doctest.h>

#include <heml/mesh/faces.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/improve/surface_tree.hpp>
#include <map>

#include "support.hpp"

namespace heml::test {

inline double volume_of(const TetMesh& mesh, std::size_t t) {
  const Tet& tet = mesh.tets[t];
  return signed_volume(mesh.nodes[tet[0]], mesh.nodes[tet[1]], mesh.nodes[tet[2]], mesh.nodes[tet[3]]);
}

inline std::map<int, double> volumes_of_regions(const TetMesh& mesh) {
  std::map<int, double> volumes;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) volumes[mesh.regions[t]] += volume_of(mesh, t);
  return volumes;
}

inline double area_of(const TriangleMesh& surface) {
  double area = 0;
  for (const auto& [a, b, c] : surface.triangles)
    area += (surface.nodes[b] - surface.nodes[a]).cross(surface.nodes[c] - surface.nodes[a]).norm() / 2;
  return area;
}

/// A box of 0.1 m in two regions, its nodes displaced by up to `amount` of a cell. The boundary is flat, and so
/// is the interface at x = 0.05 m.
inline TetMesh shaken_box(int cells, double amount, std::uint64_t seed = 1) {
  TetMesh mesh = make_box(Vec3::Constant(0.1), {cells, cells, cells});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    Vec3 centre = Vec3::Zero();
    for (const int n : mesh.tets[t]) centre += mesh.nodes[n] / 4;
    mesh.regions[t] = centre[0] < 0.05 ? 4 : 7;
  }
  std::mt19937_64 random(seed);
  for (Vec3& x : mesh.nodes) {
    Vec3 move = random_vector(random, amount * 0.1 / cells);
    Eigen::Array3i on_plane;
    for (int axis = 0; axis < 3; ++axis)
      on_plane[axis] = x[axis] < 1e-9 || x[axis] > 0.1 - 1e-9 || (axis == 0 && std::abs(x[0] - 0.05) < 1e-9);
    if (on_plane.any()) move *= std::min(1.0, 0.2 / amount);  // so that no face is folded
    for (int axis = 0; axis < 3; ++axis)
      if (!on_plane[axis]) x[axis] += move[axis];
  }
  return mesh;
}

/// No face of more than two elements, no element without volume; regions of the same volume, boundary and interfaces of
/// the same area: conforming, without gaps or overlaps.
inline void check_same_body(const TetMesh& before, const TetMesh& after) {
  for (const auto count : face_counts(after.tets, static_cast<int>(after.nodes.size()))) CHECK(count <= 2);
  int inverted = 0;
  for (std::size_t t = 0; t < after.tets.size(); ++t) inverted += !(volume_of(after, t) > 0);
  CHECK(inverted == 0);
  const auto volumes = volumes_of_regions(after);
  CHECK(volumes.size() == volumes_of_regions(before).size());
  for (const auto& [region, volume] : volumes_of_regions(before))
    CHECK(volumes.at(region) == doctest::Approx(volume).epsilon(1e-9));
  CHECK(area_of(constrained_surface(after)) == doctest::Approx(area_of(constrained_surface(before))).epsilon(1e-9));
}

}  // namespace heml::test
