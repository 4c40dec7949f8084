#include <doctest/doctest.h>

#include <heml/mesh/edit.hpp>
#include <heml/mesh/field_of_piece.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/improve/transfer_fields.hpp>
#include <heml/mesh/quadratic.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/mesh/refine.hpp>
#include <heml/mesh/subdivide.hpp>

namespace heml::field_of_piece_test {
namespace {

/// A direction that turns along the body.
Vec3 direction_at(const Vec3& X) { return Vec3(1 - 0.2 * X.z(), 0.5 * X.x() - 0.3 * X.y(), 0.4 * X.z() + 0.1); }

Vec3 place_of(const TetMesh& mesh, std::size_t t, std::size_t q) {
  const auto corners = rest_corners(mesh, mesh.tets[t]);
  Vec3 sum = Vec3::Zero();
  for (std::size_t c = 0; c < 4; ++c) sum += point_coordinate(q, c) * corners[c];
  return sum;
}

/// With that direction at the integration points, of either sign.
TetMesh with_directions(TetMesh mesh) {
  ElementField field{"fibre", point_components, {}};
  for (std::size_t k = 0; k < element_points * mesh.tets.size(); ++k) {
    const double sign = k * k % 7 < 3 ? -1 : 1;
    const Vec3 direction = sign * direction_at(place_of(mesh, k / element_points, k % element_points));
    field.values.insert(field.values.end(), direction.begin(), direction.end());
  }
  mesh.fields = {{"number", 1, {}}, field};
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.fields[0].values.push_back(static_cast<double>(t));
  return mesh;
}

/// The largest difference from that direction at the points of elements from `first` on, whatever the sign.
double worst(const TetMesh& mesh, std::size_t first = 0) {
  const ElementField& field = mesh.fields.at(1);
  REQUIRE(field.values.size() == point_components * mesh.tets.size());
  double most = 0;
  for (std::size_t k = element_points * first; k < element_points * mesh.tets.size(); ++k) {
    const Vec3 expected = direction_at(place_of(mesh, k / element_points, k % element_points)).normalized();
    const Vec3 found = Eigen::Map<const Vec3>(&field.values[3 * k]);
    most = std::max(most, std::min((found - expected).norm(), (found + expected).norm()));
  }
  return most;
}

}  // namespace

TEST_CASE("directions at integration points go on linearly in the parts of elements") {
  const TetMesh mesh = with_directions(make_box(Vec3(1, 1, 1), {2, 2, 2}));
  SUBCASE("subdivided") {
    const TetMesh finer = subdivide_uniformly(mesh).mesh;
    CHECK(worst(finer) < 1e-14);
    CHECK(finer.fields[0].values[8 * 7 + 3] == 7);
  }
  SUBCASE("refined") {
    const Refinement finer = refine_longest_edge(mesh, {3, 8, 20});
    CHECK(finer.mesh.tets.size() > mesh.tets.size());
    std::vector<double> numbers(finer.parents.begin(), finer.parents.end());
    CHECK(finer.mesh.fields[0].values == numbers);
    CHECK(worst(finer.mesh) < 1e-14);
  }
  SUBCASE("cut off by an edit") {
    TetMesh cut = mesh;
    const auto [a, b, c, d] = cut.tets[5];
    MeshEdit edit;
    edit.removed = {5};
    edit.nodes = {{a, b, 0.3}};
    const int middle = static_cast<int>(cut.nodes.size());
    edit.added = {{a, middle, c, d}, {middle, b, c, d}};
    edit.parents = {5, 5};
    append(edit, cut);
    CHECK(worst(cut, mesh.tets.size()) < 1e-14);
    CHECK(cut.fields[0].values.back() == 5);
  }
  SUBCASE("meshed anew") {
    TetMesh anew = make_box(Vec3(1, 1, 1), {3, 3, 3});
    transfer_fields(mesh, anew);
    CHECK(worst(anew) < 1e-14);
  }
}

TEST_CASE("directions at integration points keep their places where an element is wound the other way") {
  TetMesh mesh = with_directions(make_box(Vec3(1, 1, 1), {2, 2, 2}));
  TetMesh turned = mesh;
  for (const std::size_t t : {4u, 11u}) {
    std::swap(turned.tets[t][2], turned.tets[t][3]);
    double* values = &turned.fields[1].values[point_components * t];
    std::swap_ranges(values + 6, values + 9, values + 9);
  }
  check_tets(turned);
  CHECK(turned.tets == mesh.tets);
  CHECK(turned.fields[1].values == mesh.fields[1].values);
}

}  // namespace heml::field_of_piece_test
