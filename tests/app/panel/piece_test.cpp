#include <app/panel/piece.hpp>
#include <cmath>

#include "driver.hpp"

namespace heml::piece_test {

using namespace heml::test;

namespace {

Frame small_frame() {
  Frame frame;
  frame.surface_mesh = std::make_shared<const SurfaceMesh>(small_surface());
  frame.positions = frame.surface_mesh->rest;
  return frame;
}

/// The tetrahedron of small_surface(), whose nodes are 10 to 13, and another one apart from it.
void add_solid(Frame& frame) {
  auto solid = std::make_shared<Solid>();
  solid->rest.assign(20, Vec3f::Zero());
  for (std::size_t k = 0; k < 4; ++k) solid->rest[10 + k] = frame.positions[k];
  solid->rest[15] = {1, 0, 0};
  solid->rest[16] = {0, 1, 0};
  solid->rest[17] = {0, 0, 1};
  solid->tets = {{10, 11, 12, 13}, {14, 15, 16, 17}};
  frame.solid_positions = solid->rest;
  frame.solid = std::move(solid);
}

}  // namespace

TEST_CASE("a piece has the volume and the area of what hangs together with a node") {
  panel::Piece piece;
  Frame frame = small_frame();
  CHECK_FALSE(piece.size_of(11, frame));  // no solid yet
  add_solid(frame);
  const auto size = piece.size_of(11, frame);
  REQUIRE(size);
  CHECK(size->volume == doctest::Approx(1e-3 / 6));
  CHECK(size->area == doctest::Approx(3 * 0.005 + std::sqrt(3.0) / 2 * 0.01));
  const auto other = piece.size_of(15, frame);
  REQUIRE(other);
  CHECK(other->volume == doctest::Approx(1.0 / 6));
  CHECK_FALSE(piece.size_of(3, frame));  // a node of no element
  CHECK_FALSE(piece.size_of(99, frame));
}

TEST_CASE("a piece is measured as it lies now, and found anew when the mesh has changed") {
  panel::Piece piece;
  Frame frame = small_frame();
  add_solid(frame);
  REQUIRE(piece.size_of(11, frame));
  for (Vec3f& x : frame.solid_positions) x *= 2;
  CHECK(piece.size_of(11, frame)->volume == doctest::Approx(8e-3 / 6));
  Solid joined = *frame.solid;
  joined.tets[1][0] = 10;  // hangs on the first tetrahedron now
  frame.solid = std::make_shared<const Solid>(joined);
  CHECK(piece.size_of(11, frame)->volume == doctest::Approx(8e-3 / 6 + 8.0 / 6));
}

}  // namespace heml::piece_test
