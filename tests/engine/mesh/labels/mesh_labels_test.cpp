#include <doctest/doctest.h>

#include <algorithm>
#include <heml/base/error.hpp>
#include <heml/base/warning_collector.hpp>
#include <heml/mesh/faces.hpp>
#include <heml/mesh/labels/clean_labels.hpp>
#include <heml/mesh/labels/mesh_labels.hpp>
#include <heml/mesh/quality.hpp>
#include <set>

#include "engine/mesh/labels/volumes.hpp"

namespace heml::mesh_labels_test {
namespace {

bool is_in(const Vec3& x, const Vec3& centre, const Vec3& radii) {
  return (x - centre).cwiseQuotient(radii).squaredNorm() < 1;
}

/// A body of 180 mm with an organ in it that has another inside, and one that touches its surface.
LabelMap nested(int n) {
  return test::phantom(n, {0, 3, 4, 9, 12}, [](const Vec3& x) {
    if (is_in(x, {0.045, -0.015, 0}, {0.045, 0.03, 0.03})) return 4;
    if (is_in(x, {-0.03, 0.01, 0}, {0.025, 0.022, 0.024})) return 3;
    if (is_in(x, {-0.02, 0.01, 0}, {0.05, 0.04, 0.045})) return 2;
    return is_in(x, Vec3::Zero(), {0.09, 0.07, 0.08}) ? 1 : 0;
  });
}

void check_conforming(const TetMesh& mesh) {
  const auto counts = face_counts(mesh.tets, static_cast<int>(mesh.nodes.size()));
  CHECK(*std::max_element(counts.begin(), counts.end()) <= 2);
  for (const Tet& tet : mesh.tets)
    REQUIRE(signed_volume(mesh.nodes[tet[0]], mesh.nodes[tet[1]], mesh.nodes[tet[2]], mesh.nodes[tet[3]]) > 0);
}

}  // namespace

TEST_CASE("nested labels: conforming, with their volumes, in number and without bad angles") {
  const LabelMap map = nested(64);
  LabelMeshOptions options;
  options.tets = 30000;
  LabelMeshing meshing = mesh_labels(map, options);
  check_conforming(meshing.mesh);
  CHECK(meshing.mesh.tets.size() > 0.75 * options.tets);
  CHECK(meshing.mesh.tets.size() < 1.25 * options.tets);
  CHECK(meshing.below.empty());
  REQUIRE(meshing.labels.size() == 4);
  const auto counts = count_labels(map);
  for (std::size_t k = 0; k < 4; ++k) {
    const LabelMeshing::Label& label = meshing.labels[k];
    CHECK(label.value == map.values[k + 1]);
    CHECK(label.voxel_volume == doctest::Approx(static_cast<double>(counts[k + 1]) * map.voxel_volume()));
    CHECK(std::abs(label.mesh_volume / label.voxel_volume - 1) < 0.01);
  }
  CHECK(std::set<int>(meshing.mesh.regions.begin(), meshing.mesh.regions.end()) == std::set{3, 4, 9, 12});
  const QualityReport report = check_tets(meshing.mesh);
  CHECK(report.worst_dihedral >= 10);
  CHECK(report.components == 1);
  CHECK(report.nonmanifold_edges == 0);
}

TEST_CASE("a ball: its surface follows the ball, not the voxels") {
  const double radius = 0.08;
  const LabelMap map =
      test::phantom(50, {0, 1}, [&](const Vec3& x) { return is_in(x, Vec3::Zero(), Vec3::Constant(radius)) ? 1 : 0; });
  const TetMesh mesh = mesh_labels(map, {.tets = 12000}).mesh;
  const auto counts = face_counts(mesh.tets, static_cast<int>(mesh.nodes.size()));
  double sum = 0, largest = 0;
  int faces = 0;
  for (std::size_t f = 0; f < counts.size(); ++f) {
    if (counts[f] != 1) continue;
    Vec3 middle = Vec3::Zero();
    for (const int a : tet_faces[f % 4]) middle += mesh.nodes[mesh.tets[f / 4][static_cast<std::size_t>(a)]] / 3;
    sum += std::abs(middle.norm() - radius);
    largest = std::max(largest, std::abs(middle.norm() - radius));
    ++faces;
  }
  const double voxel = 0.2 / 50;
  CHECK(sum / faces < 0.15 * voxel);
  CHECK(largest < 0.5 * voxel);
}

TEST_CASE("elements are larger inside than at the surface") {
  const LabelMap map =
      test::phantom(50, {0, 1}, [](const Vec3& x) { return is_in(x, Vec3::Zero(), Vec3::Constant(0.09)) ? 1 : 0; });
  const TetMesh mesh = mesh_labels(map, {.tets = 80000}).mesh;
  double inner = 0, outer = 0;
  for (const Tet& tet : mesh.tets) {
    const auto& x = mesh.nodes;
    const double volume = signed_volume(x[tet[0]], x[tet[1]], x[tet[2]], x[tet[3]]);
    const double distance = ((x[tet[0]] + x[tet[1]] + x[tet[2]] + x[tet[3]]) / 4).norm();
    double& most = distance < 0.04 ? inner : outer;
    if (distance < 0.04 || distance > 0.085) most = std::max(most, volume);
  }
  CHECK(inner > 10 * outer);  // about 1.5 in a lattice of equal cells
}

TEST_CASE("the same map gives the same mesh") {
  const LabelMap map = nested(32);
  const TetMesh a = mesh_labels(map, {.tets = 5000}).mesh, b = mesh_labels(map, {.tets = 5000}).mesh;
  CHECK(a.nodes == b.nodes);
  CHECK(a.tets == b.tets);
  CHECK(a.regions == b.regions);
}

TEST_CASE("voxels of unequal sides in a turned frame") {
  LabelMap map = nested(40);
  const double volume = map.voxel_volume();
  const Mat3 turn = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  map.axes = turn * Vec3(0.8, 1, 1.6).asDiagonal() * map.axes;
  map.axes.col(0) *= -1;
  LabelMeshing meshing = mesh_labels(map, {.tets = 20000});
  check_conforming(meshing.mesh);
  CHECK(check_tets(meshing.mesh).worst_dihedral >= 10);
  CHECK(meshing.labels[0].voxel_volume == doctest::Approx(1.28 * volume * static_cast<double>(count_labels(map)[1])));
  CHECK(meshing.labels[0].mesh_volume == doctest::Approx(meshing.labels[0].voxel_volume).epsilon(0.01));
}

TEST_CASE("specks and small holes are removed with a word, labels that touch the border are closed") {
  LabelMap map = test::phantom(40, {0, 1, 2}, [](const Vec3& x) { return x.x() < 0.03 ? 1 : 2; });
  map.voxels[map.index(20, 20, 20)] = 0;
  map.voxels[map.index(5, 5, 5)] = 2;
  const WarningCollector warnings;
  LabelMeshing meshing = mesh_labels(map, {.tets = 8000});
  REQUIRE(warnings.texts().size() == 2);
  CHECK(warnings.texts()[0] == "phantom: 1 small hole was filled");
  CHECK(warnings.texts()[1] == "phantom: label 2: 1 speck apart from it left out");
  check_conforming(meshing.mesh);
  const QualityReport report = check_tets(meshing.mesh);
  CHECK(report.volume == doctest::Approx(0.008).epsilon(0.01));
  CHECK(report.nonmanifold_edges == 0);
}

TEST_CASE("a label that is finer than the elements is named") {
  const LabelMap map = test::phantom(60, {0, 1, 2}, [](const Vec3& x) {
    if (is_in(x, {0.05, 0, 0}, Vec3::Constant(0.008))) return 2;
    return is_in(x, Vec3::Zero(), Vec3::Constant(0.09)) ? 1 : 0;
  });
  const WarningCollector warnings;
  mesh_labels(map, {.tets = 500});
  REQUIRE_FALSE(warnings.texts().empty());
  CHECK(warnings.texts().back().starts_with("phantom: label 2"));
}

}  // namespace heml::mesh_labels_test
