#include <app/panel/measure.hpp>
#include <cmath>
#include <sstream>

#include "driver.hpp"

namespace heml::measure_test {

using namespace heml::test;

namespace {

/// A point at a node of small_surface().
render::SurfacePoint at_node(int node) { return {{node, node, node}, {1, 0, 0}}; }

Frame small_frame() {
  Frame frame;
  frame.surface_mesh = std::make_shared<const SurfaceMesh>(small_surface());
  frame.positions = frame.surface_mesh->rest;
  return frame;
}

}  // namespace

TEST_CASE("two points have a distance, three two of them and the angle at the second") {
  panel::Measure measure;
  Frame frame = small_frame();
  measure.add(at_node(11));
  measure.update(frame);
  CHECK(std::isnan(measure.now().distance));
  measure.add(at_node(10));
  measure.update(frame);
  CHECK(measure.now().distance == doctest::Approx(0.1));
  CHECK(std::isnan(measure.now().angle));
  measure.add(at_node(12));
  measure.update(frame);
  CHECK(measure.now().distance == doctest::Approx(0.1));
  CHECK(measure.now().second == doctest::Approx(0.1));
  CHECK(measure.now().angle == doctest::Approx(90));
  measure.add(at_node(10));
  CHECK(measure.points().size() == 1);
  measure.add(at_node(11));
  measure.add(at_node(12));
  measure.update(frame);
  CHECK(measure.now().angle == doctest::Approx(45));
}

TEST_CASE("points follow the tissue between its nodes, and a point that is cut away is not known") {
  panel::Measure measure;
  Frame frame = small_frame();
  measure.add({{10, 11, 12}, {0.5f, 0.25f, 0.25f}});
  measure.add(at_node(13));
  measure.update(frame);
  const double before = measure.now().distance;
  CHECK(before == doctest::Approx((Vec3(0.025, 0.025, 0) - Vec3(0, 0, 0.1)).norm()));
  for (Vec3f& x : frame.positions) x *= 2;
  measure.update(frame);
  CHECK(measure.now().distance == doctest::Approx(2 * before));
  SurfaceMesh less = small_surface();
  less.nodes[3] = 14;
  frame.surface_mesh = std::make_shared<const SurfaceMesh>(less);
  measure.update(frame);
  CHECK(std::isnan(measure.now().distance));
}

TEST_CASE("a point whose triangle a cut has parted is not known, nor one whose nodes come back elsewhere") {
  panel::Measure measure;
  Frame frame = small_frame();
  measure.add({{10, 11, 12}, {0.5f, 0.25f, 0.25f}});
  measure.add(at_node(13));
  measure.update(frame);
  const double before = measure.now().distance;
  CHECK(std::isfinite(before));
  SurfaceMesh parted = small_surface();
  std::erase_if(parted.triangles, [](const auto& t) { return std::count(t.begin(), t.end(), 3) == 0; });
  frame.surface_mesh = std::make_shared<const SurfaceMesh>(parted);
  measure.update(frame);
  CHECK(std::isnan(measure.now().distance));
  SurfaceMesh elsewhere = small_surface();
  for (Vec3f& X : elsewhere.rest) X += Vec3f(0.01f, 0, 0);
  frame.surface_mesh = std::make_shared<const SurfaceMesh>(elsewhere);
  measure.update(frame);
  CHECK(std::isnan(measure.now().distance));
  frame.surface_mesh = std::make_shared<const SurfaceMesh>(small_surface());
  measure.update(frame);
  CHECK(measure.now().distance == before);
}

TEST_CASE("the value of the field is interpolated at the last point") {
  panel::Measure measure;
  Frame frame = small_frame();
  frame.field = Field::von_mises;
  frame.values = {4, 8, 16, 0};
  measure.add({{10, 11, 12}, {0.5f, 0.25f, 0.25f}});
  measure.update(frame);
  CHECK(measure.now().value == doctest::Approx(8));
}

TEST_CASE("what is measured is kept once a tick, not in the past, and written as a table") {
  panel::Measure measure;
  Frame frame = small_frame();
  measure.add(at_node(10));
  measure.add(at_node(11));
  for (const long tick : {5, 6, 6, 4, 9}) {
    frame.tick = tick;
    frame.time = 0.1 * static_cast<double>(tick);
    measure.update(frame);
  }
  REQUIRE(measure.kept().size() == 3);
  std::istringstream lines(measure.csv());
  std::string head, row;
  std::getline(lines, head);
  std::getline(lines, row);
  CHECK(head ==
        "time_s,x1_m,y1_m,z1_m,x2_m,y2_m,z2_m,distance_1_2_m,distance_2_3_m,angle_deg,field,value,piece_area_m2,"
        "piece_volume_m3");
  CHECK(row == "0.5,0,0,0,0.100000001,0,0,0.100000001,,,none,,,");
  frame.tick = 10;
  frame.time = 0;  // a reset
  measure.update(frame);
  CHECK(measure.kept().size() == 1);
  measure.add(at_node(12));
  CHECK(measure.kept().empty());
}

}  // namespace heml::measure_test
