#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <heml/scenario/haptic_run.hpp>

namespace heml::haptic_run_test {
namespace {

/// A bar fixed at x = 0, grasped at its other end after the first tick.
Scene grasped(double step) {
  const std::string patch = fmt::format(R"({{
    "mesh": {{"box": {{"size": [0.2, 0.1, 0.1], "cells": [4, 2, 2]}}}},
    "solver": {{"integrator": "backward_euler", "step": {}, "rate": null, "duration": 1.2, "damping": 4}},
    "events": [{{"step": 1, "grasp": {{"point": [0.2, 0.05, 0.05], "radius": 0.06}}}}]}})",
                                        step);
  return test::small_scene_with(patch);
}

/// A slow oscillation about the position of the grasp.
HandleTrajectory handle() {
  HandleTrajectory path;
  for (int k = 0; k <= 120; ++k) {
    const double t = k * 0.01, swing = 1 - std::cos(6 * std::max(0.0, t - 0.1));
    path.times.push_back(t);
    path.positions.push_back(Vec3(0.2, 0.05, 0.05) + 0.01 * swing * Vec3(0.3, -1, 0.2));
  }
  return path;
}

}  // namespace

TEST_CASE(
    "a hand served between ticks of 1/60 s feels nearly what it feels of an engine at a thousand ticks a second") {
  const HapticLimits limits{2000, 1000, 20};
  const HapticRun often = run_with_handle(grasped(1e-3), handle(), limits),
                  seldom = run_with_handle(grasped(1.0 / 60), handle(), limits);
  REQUIRE(!often.halt);
  REQUIRE(!seldom.halt);
  double size = 0, difference = 0;
  for (std::size_t k = 300; k < 1150; ++k) {
    size += often.samples[k].force.squaredNorm();
    difference += (often.samples[k].force - seldom.samples[k].force).squaredNorm();
    CHECK(seldom.samples[k].time == doctest::Approx(1e-3 * static_cast<double>(k)));
  }
  MESSAGE("relative difference " << std::sqrt(difference / size));
  CHECK(std::sqrt(difference / size) < 0.1);
}

TEST_CASE("the same hand feels the same forces again, to the bit") {
  const HapticRun one = run_with_handle(grasped(1.0 / 60), handle()),
                  again = run_with_handle(grasped(1.0 / 60), handle());
  REQUIRE(one.samples.size() == again.samples.size());
  for (std::size_t k = 0; k < one.samples.size(); ++k) CHECK(one.samples[k].force == again.samples[k].force);
}

TEST_CASE("a hand's file is read, and errors name the line") {
  const TemporaryFolder folder;
  const HandleTrajectory path = read_handle_csv(folder.file("hand.csv", "time,x,y,z\n0,0,0,0\n0.5, 1,2,3\n\n"));
  CHECK(path.at(-1) == Vec3::Zero());
  CHECK((path.at(0.25) - Vec3(0.5, 1, 1.5)).norm() < 1e-15);
  CHECK(path.at(2) == Vec3(1, 2, 3));
  const auto refused = [&](const std::string& text) {
    return refusal([&] { read_handle_csv(folder.file("wrong.csv", text)); });
  };
  CHECK(says(refused("t,x\n"), "line 1: is 't,x' (must be the header time,x,y,z"));
  CHECK(says(refused("time,x,y,z\n0,0,0\n"), "line 2: is '0,0,0'"));
  CHECK(says(refused("time,x,y,z\n0,0,0,0\n0,1,1,1\n"), "line 3: is of 0 s, after 0 s"));
  CHECK(says(refused("time,x,y,z\n0,0,nan,0\n"), "line 2"));
  CHECK(says(refused("time,x,y,z\n"), "has no position of the handle"));
  CHECK(says(
      refusal([&] { run_with_handle(test::small_scene_with(R"({"solver": {"integrator": "static"}})"), path); }),
      "solver.integrator"));
}

}  // namespace heml::haptic_run_test
