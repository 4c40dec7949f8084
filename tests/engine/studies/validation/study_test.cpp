// The validation study: verdicts, resumed runs, and worlds that are wrong on purpose.
#include <doctest/doctest.h>

#include <cmath>
#include <studies/validation/body.hpp>
#include <studies/validation/study.hpp>

namespace heml::validation_study_test {

using namespace heml::validation;

namespace {

Row row(double ours, double limit) {
  Row r;
  r.quantity = "displacement";
  r.ours = ours, r.reference = 2, r.limit = limit;
  return r;
}

std::size_t shortfalls_of(const Finding& finding) { return shortfalls({{&benchmarks()[0], finding}}).size(); }

}  // namespace

TEST_CASE("validation: a row holds within its limit, and no number misses") {
  CHECK(row(2.02, 0.011).verdict() == Verdict::holds);
  CHECK(row(1.97, 0.011).verdict() == Verdict::misses);
  CHECK(row(std::nan(""), 0.011).verdict() == Verdict::misses);
  CHECK(row(1, std::nan("")).verdict() == Verdict::compared);
  Row stopped = row(2, 0.01);
  stopped.failed = "unstable";
  CHECK(stopped.verdict() == Verdict::fails);
  CHECK(shortfalls_of({{row(2, 0.1), row(3, 0.1), row(3, std::nan(""))}, {}}) == 1);
}

TEST_CASE("validation: the elastica holds, and a softer beam is noticed") {
  CHECK(shortfalls_of(elastica({true, make_world})) == 0);
  const MakeWorld softer = [](WorldSetup setup) {
    for (double& modulus : setup.materials[0].material.parameters) modulus *= 0.97;
    return make_world(std::move(setup));
  };
  CHECK(shortfalls_of(elastica({true, softer})) > 0);
}

TEST_CASE("validation: pressure of another strength is noticed by the thick walls") {
  const MakeWorld weaker = [](WorldSetup setup) {
    setup.loads[0].pressure *= 0.85;
    return make_world(std::move(setup));
  };
  CHECK(shortfalls_of(thick_cylinder({true, make_world})) < shortfalls_of(thick_cylinder({true, weaker})));
}

TEST_CASE("validation: Land's beam holds, and a softer one is noticed") {
  CHECK(shortfalls_of(land_beam({true, make_world})) == 0);
  const MakeWorld softer = [](WorldSetup setup) {
    setup.materials[0].material.parameters[1] *= 0.95;  // bf
    return make_world(std::move(setup));
  };
  CHECK(shortfalls_of(land_beam({true, softer})) > 0);
}

TEST_CASE("validation: a ball in contact holds, and a softer block is noticed") {
  CHECK(shortfalls_of(ball_contact({true, make_world})) == 0);
  const MakeWorld softer = [](WorldSetup setup) {
    setup.materials[0].material.parameters[0] *= 0.9;
    return make_world(std::move(setup));
  };
  CHECK(shortfalls_of(ball_contact({true, softer})) > 0);
}

TEST_CASE("validation: materials with memory hold, and other memories are noticed") {
  const MakeWorld slower = [](WorldSetup setup) {
    for (PronyTerm& branch : setup.materials[0].material.relaxation) branch.tau *= 1.1;
    return make_world(std::move(setup));
  };
  const MakeWorld softer = [](WorldSetup setup) {
    setup.materials[0].material.plasticity->hardening *= 0.9;
    return make_world(std::move(setup));
  };
  for (const auto run : {creep, viscous_loop}) {
    CHECK(shortfalls_of(run({true, make_world})) == 0);
    CHECK(shortfalls_of(run({true, slower})) > 0);
  }
  CHECK(shortfalls_of(plastic_cycle({true, make_world})) == 0);
  CHECK(shortfalls_of(plastic_cycle({true, softer})) > 0);
}

TEST_CASE("validation: material points are carried by the motion of their elements") {
  const Material material = rubber(1e3, 1e4);
  const auto curved = [](const Vec3& X) { return Vec3(X.x() + 0.1 * X.y() * X.y(), X.y(), X.z()); };
  for (const char* element : {"p1", "p2"}) {
    const bool quadratic = element[1] == '2';
    const Map map = quadratic ? Map(curved) : Map();
    const WorldSetup setup = make_body(cubic_cup(2, 2, 1, 1, 2), element, material, map);
    std::vector<Vec3> x;
    Mat3 F;
    F << 1.2, 0.1, 0, -0.2, 0.9, 0.3, 0.1, 0, 1.1;
    for (const Vec3& X : setup.mesh.nodes) x.push_back(F * X);
    for (const Vec3& cube : {Vec3(0.1, -0.2, -1.3), Vec3(1.6, 0.3, 0.5), Vec3(-0.4, -1.1, 0.9)}) {
      const Vec3 point = quadratic ? curved(cube) : cube;
      CHECK((carried(setup, x, {point}).front() - F * point).norm() < 1e-9);
    }
  }
}

}  // namespace heml::validation_study_test
