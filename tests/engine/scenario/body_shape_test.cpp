#include <doctest/doctest.h>

#include <heml/base/error.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/scenario/body_shape.hpp>

namespace heml::body_shape_test {

namespace {

template <class Map>
TetMesh mapped_box(const std::array<int, 3>& cells, const Map& map) {
  TetMesh mesh = make_box(Vec3(1, 1, 1), cells);
  for (Vec3& x : mesh.nodes) x = map(x);
  return mesh;
}

/// A dome: round below y, flat below z.
TetMesh dome() {
  return mapped_box({6, 6, 3}, [](const Vec3& x) {
    const double u = 2 * x.x() - 1, v = 2 * x.y() - 1;
    const double in_disc = std::sqrt(1 - v * v / 2), in_disc_v = std::sqrt(1 - u * u / 2);
    const Vec3 disc(u * in_disc, v * in_disc_v, 0);
    return Vec3(disc.x(), disc.y(), x.z() * std::sqrt(std::max(0.0, 1.05 - disc.squaredNorm())));
  });
}

/// A broad head on a thin stem under one end of it.
TetMesh gallows() {
  return mapped_box({4, 4, 4}, [](const Vec3& x) {
    return x.y() > 0.6 ? Vec3(x.x(), x.y(), x.z()) : Vec3(0.1 * x.x(), x.y(), x.z());
  });
}

}  // namespace

TEST_CASE("a mesh whose elements are all given twice has no shape") {
  TetMesh mesh = make_box(Vec3(1, 1, 1), {1, 1, 1});
  const std::vector<Tet> once = mesh.tets;
  mesh.tets.insert(mesh.tets.end(), once.begin(), once.end());
  CHECK_THROWS_AS(shape_of(mesh), InputError);
}

TEST_CASE("the shape of a box") {
  const TetMesh mesh = make_box(Vec3(0.1, 0.2, 0.3), {2, 3, 4}, Vec3(1, 2, 3));
  const BodyShape shape = shape_of(mesh);
  CHECK((shape.low - Vec3(1, 2, 3)).norm() < 1e-12);
  CHECK((shape.size() - Vec3(0.1, 0.2, 0.3)).norm() < 1e-12);
  CHECK((shape.centre - Vec3(1.05, 2.1, 3.15)).norm() < 1e-12);
  CHECK(shape.area == doctest::Approx(2 * (0.02 + 0.03 + 0.06)).epsilon(1e-12));
  for (int axis = 0; axis < 3; ++axis) CHECK(flat_base(mesh, shape, axis) == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("a unit is one in which the body is an organ's size") {
  CHECK(guess_unit(0.15).name == "metres");
  CHECK(guess_unit(1.9).scale == 1);
  CHECK(guess_unit(15.3).name == "centimetres");
  CHECK(guess_unit(15.3).scale == 0.01);
  CHECK(guess_unit(120).name == "millimetres");
  CHECK(guess_unit(2.14).name == "");  // 2 cm or 2 mm
  CHECK(guess_unit(2.14).scale * 2.14 == doctest::Approx(0.2).epsilon(1e-12));
  CHECK(guess_unit(1e-5).scale * 1e-5 == doctest::Approx(0.2).epsilon(1e-12));
}

TEST_CASE("z points up where a body is flat below z alone") {
  const TetMesh body = dome();
  CHECK(guess_up(body, shape_of(body)) == UpAxis::z);
  TetMesh turned = body;
  for (Vec3& x : turned.nodes) x = Vec3(x.x(), x.z(), -x.y());
  CHECK(guess_up(turned, shape_of(turned)) == UpAxis::y);
  const TetMesh box = make_box(Vec3(1, 1, 1), {2, 2, 2});
  CHECK(guess_up(box, shape_of(box)) == UpAxis::y);
}

TEST_CASE("a box rests on its underside, which is a sixth of its surface") {
  const TetMesh mesh = make_box(Vec3(1, 1, 1), {4, 4, 4}, Vec3(0, 7, 0));
  const Support support = choose_support(mesh, shape_of(mesh), 0.12);
  CHECK_FALSE(support.top);
  CHECK(support.height == doctest::Approx(7).epsilon(1e-6));
  CHECK(support.height >= 7);  // the nodes of the underside belong to it
  CHECK(support.area >= 0.12);
  CHECK(support.area <= 1.0 / 6 + 1e-9);
}

TEST_CASE("a body that would topple on its underside hangs from its top") {
  const TetMesh mesh = gallows();
  const BodyShape shape = shape_of(mesh);
  const Support support = choose_support(mesh, shape, 0.12);
  CHECK(support.top);
  CHECK(support.height > 0.5);
  TetMesh over = mesh;
  for (Vec3& x : over.nodes) x = Vec3(x.x(), -x.y(), -x.z());
  CHECK_FALSE(choose_support(over, shape_of(over), 0.12).top);
}

}  // namespace heml::body_shape_test
