#include <doctest/doctest.h>

#include <heml/scenario/feb_curve.hpp>

#include "engine/mesh/files.hpp"
#include "engine/scenario/feb_files.hpp"

namespace heml::feb_curve_test {

namespace {

struct Told {
  double at_end;
  std::optional<double> ramp_time;
  bool refused;
};

/// Of the value of a file with one curve.
Told factor(const std::string& curve, double end, const std::string& value = "<v lc=\"1\">3</v>") {
  const std::string text = "<a><LoadData>" + curve + "</LoadData>" + value + "</a>";
  const XmlDocument document("a.feb", text);
  const FebCurves curves({*document.root().child("LoadData")}, end);
  FebFindings findings;
  const FebFactor found = curves.factor_of(*document.root().child("v"), findings);
  return {found.at_end, found.ramp_time, !refusal([&] { findings.throw_refused("a.feb"); }).empty()};
}

Told factor_by(const std::string& points, double end) { return factor(test::feb_curve_text("2.5", points), end); }

std::string with_extend(std::string curve, const std::string& attributes) {
  return curve.replace(curve.find("type=\"linear\""), 13, attributes);
}

}  // namespace

TEST_CASE("a curve that grows linearly and stays is a ramp") {
  for (const char* version : {"2.5", "3.0", "4.0"}) {
    const Told told = factor(test::feb_curve_text(version, "0,0 0.5,2 1,2"), 1);
    CHECK(told.at_end == 2);
    CHECK(told.ramp_time == 0.5);
  }
  CHECK(factor_by("0,0 1,1", 1).ramp_time == 1.0);
  CHECK(factor_by("0,0 0.25,0.25 1,1", 1).ramp_time == 1.0);
  CHECK(factor_by("0,0 1,-4", 3).at_end == -4);
  CHECK(factor_by("0,0 1,-4", 3).ramp_time == 1.0);
}

TEST_CASE("a curve may be cut by the end of the analysis") {
  const Told told = factor_by("0,0 2,1", 0.5);
  CHECK(told.at_end == 0.25);
  CHECK(told.ramp_time == 0.5);
}

TEST_CASE("constant curves and values without one hold from the start") {
  CHECK(factor_by("0,3", 1).at_end == 3);
  CHECK(factor_by("0,3", 1).ramp_time == 0.0);
  CHECK(factor_by("0,3 1,3", 1).ramp_time == 0.0);
  const Told without = factor("", 1, "<v>3</v>");
  CHECK(without.at_end == 1);
  CHECK(without.ramp_time == 0.0);
}

TEST_CASE("any other course has a value at the end and is no ramp") {
  for (const char* points : {"0,1 1,2", "0,0 0.5,1 1,0.5", "0,0 0.5,0 1,1", "0,0 0.2,1 1,2"}) {
    CAPTURE(points);
    CHECK_FALSE(factor_by(points, 1).ramp_time);
    CHECK_FALSE(factor_by(points, 1).refused);
  }
  CHECK(factor_by("0,0 0.5,1 1,0.5", 1).at_end == 0.5);
}

TEST_CASE("steps and extensions follow the manual") {
  const std::string linear = test::feb_curve_text("2.5", "0,0 1,1");
  CHECK(factor(with_extend(linear, "type=\"linear\" extend=\"extrapolate\""), 3).at_end == 3);
  CHECK(factor(with_extend(linear, "type=\"linear\" extend=\"extrapolate\""), 3).ramp_time == 3.0);
  CHECK(factor(with_extend(linear, "type=\"step\""), 0.5).at_end == 1);
  CHECK(factor(with_extend(linear, "type=\"smooth\""), 1).at_end == 1);
  CHECK_FALSE(factor(with_extend(linear, "type=\"smooth\""), 1).ramp_time);
  CHECK(factor(with_extend(linear, "type=\"smooth\""), 0.5).refused);
  CHECK(factor(with_extend(linear, "type=\"linear\" extend=\"repeat\""), 3).refused);
  CHECK(factor(linear, 1, "<v lc=\"2\">3</v>").refused);
}

TEST_CASE("a damaged curve is refused with its line") {
  const auto message = [](const std::string& curve) { return refusal([&] { factor(curve, 1); }); };
  CHECK(message("<loadcurve id=\"1\"/>").find("line 1: a load curve without points") != std::string::npos);
  CHECK(message("<loadcurve id=\"x\"/>").find("should be a whole number") != std::string::npos);
  CHECK(message(test::feb_curve_text("2.5", "0,0 0,1")).find("do not ascend in time") != std::string::npos);
  CHECK(message("<loadcurve id=\"1\"><point>1</point></loadcurve>").find("should be 2 numbers") != std::string::npos);
}

}  // namespace heml::feb_curve_test
