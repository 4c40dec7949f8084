// The validation study: verdicts, resumed runs, and worlds that are wrong on purpose.
#include <doctest/doctest.h>

#include <cmath>
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

}  // namespace heml::validation_study_test
