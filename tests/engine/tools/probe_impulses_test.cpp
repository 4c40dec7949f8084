#include <doctest/doctest.h>

#include <cmath>
#include <heml/tools/probe_impulses.hpp>

namespace heml::probe_impulses_test {
namespace {

constexpr double h = 1e-3;  // s

/// Two faces with a common edge over a capsule along z of radius 1; the edge lies across it, at its top.
struct Roof {
  ContactBoundary boundary{{0, 1, 2, 3}, {{0, 1, 2}, {1, 0, 3}}};
  std::vector<double> before{-1, 1, 0, 1, 1, 0, 0, 1, 2, 0, 1, -2}, x, v, inverse_mass{1, 1, 1, 1};
  ContactSurface capsule{ContactSurface::Shape::capsule, Vec3(0, 0, -5), Vec3(0, 0, 5), 1, 0.5};
  ContactMemory memory;
  ProbeImpulses<double> probe;
  double impulse = 0;  // N s, in the last first half

  /// A step in which all nodes begin with a velocity. Returns the number of points with an impulse.
  int step(const Vec3& velocity) {
    v.clear();
    for (int n = 0; n < 4; ++n) v.insert(v.end(), velocity.begin(), velocity.end());
    probe.clear(4);
    probe.stop({capsule, capsule, h, 0, true, inverse_mass, boundary, before.data()}, memory.points, v.data());
    x = before;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += h * v[i];
    std::vector<AnchoredPoint> touched;
    probe.remember_first_half(capsule, 0, x.data(), memory.points, touched);
    std::sort(touched.begin(), touched.end());
    remember(memory.points, touched);
    int count = 0;
    impulse = 0;
    probe.each_impulse([&](const ContactPoint& point, const Vec3& given) {
      ++count;
      CHECK(point.count <= 2);
      CHECK(std::is_sorted(point.nodes.begin(), point.nodes.begin() + point.count));
      impulse += given.y();
    });
    probe.begin_second_half(capsule, inverse_mass, x.data(), memory.points, v.data());
    probe.solve(v.data());
    probe.remember_second_half(memory.points);
    before = x;
    return count;
  }
};

}  // namespace

TEST_CASE("faces that touch a probe at the same place have one point there, and nothing sinks in") {
  Roof roof;
  for (int k = 0; k < 20; ++k) {
    CHECK(roof.step(Vec3(0, -1e-2, 0)) <= 5);  // on edges: not twice as many
    for (std::size_t n = 0; n < 4; ++n) CHECK(roof.x[3 * n + 1] > 1 - 5e-6);
  }
  CHECK(roof.impulse == doctest::Approx(4 * 1e-2).epsilon(0.02));  // all that falls is stopped, and no more
}

TEST_CASE("points are remembered with their impulses and start with them") {
  Roof roof;
  for (int k = 0; k < 20; ++k) roof.step(Vec3(0, -1e-2, 0));
  double sum = 0;
  for (const AnchoredPoint& point : roof.memory.points)
    if (point.anchor.idle == 0) sum += point.halves[0].normal;
  CHECK(sum == doctest::Approx(roof.impulse).epsilon(1e-3));
}

TEST_CASE("friction on a probe holds below its coefficient and lets slide above") {
  for (const double along : {4e-3, 8e-3}) {
    Roof roof;
    const double start = roof.before[2];
    for (int k = 0; k < 20; ++k) roof.step(Vec3(0, -1e-2, along));
    const double moved = roof.before[2] - start;
    if (along < 0.5e-2)
      CHECK(std::abs(moved) < 1e-7);
    else
      CHECK(moved == doctest::Approx(20 * h * (along - 0.5e-2)).epsilon(0.05));
  }
}

TEST_CASE("what other contacts bring to a probe within a step is stopped as well") {
  Roof roof;
  for (std::size_t n = 0; n < 4; ++n) roof.before[3 * n + 1] = 9;  // far outside
  roof.v.assign(12, 0);
  const auto stop = [&] {
    roof.probe.stop({roof.capsule, roof.capsule, h, 0, true, roof.inverse_mass, roof.boundary, roof.before.data()}, {},
                    roof.v.data());
  };
  roof.probe.clear(4);
  stop();
  CHECK(roof.probe.empty());
  for (std::size_t n = 0; n < 4; ++n) roof.v[3 * n + 1] = -8.1 / h;  // to 0.1 inside
  stop();
  CHECK_FALSE(roof.probe.empty());
  for (const double along_edge : {0.0, 0.5, 1.0}) {
    const double y = 9 + h * ((1 - along_edge) * roof.v[1] + along_edge * roof.v[4]);
    CHECK(y > 1 - 5e-6);
  }
}

TEST_CASE("a probe meets faces that an edit made between two steps, where no node has moved") {
  Roof roof;
  const std::vector<Triangle> faces = roof.boundary.faces;
  roof.boundary.faces.clear();
  CHECK(roof.step(Vec3::Zero()) == 0);
  roof.boundary.faces = faces;
  CHECK(roof.step(Vec3(0, -1e-2, 0)) > 0);
}

}  // namespace heml::probe_impulses_test
