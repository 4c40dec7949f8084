// Numbers of a scene from places that a closed form, or a scene with other numbers, gives.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <engine/mesh/files.hpp>
#include <heml/base/error.hpp>
#include <heml/scenario/report.hpp>
#include <heml/scenario/solve.hpp>
#include <random>
#include <studies/scene_fit.hpp>

namespace heml::scene_fit_test {

namespace {

Scene block(double young, double poisson, double traction) {
  return parse_scene(fmt::format(R"({{
    "schema_version": 1, "name": "block",
    "mesh": {{"box": {{"size": [0.2, 0.1, 0.1], "cells": [4, 2, 2]}}}},
    "materials": [{{"law": "stvk", "young": {}, "poisson": {}, "density": 500}}],
    "boundary": [{{"box": [[-1, -1, -1], [0, 1, 1]], "fix": true}}],
    "loads": [{{"box": [[0.2, -1, -1], [1, 1, 1]], "traction": [{}, 0, 0]}}],
    "solver": {{"threads": 1}}
  }})",
                                 young, poisson, traction),
                     "folder/scene.json");
}

MeasuredPlaces places_in(Scene scene, double noise) {
  scene.solver.integrator = Integrator::static_equilibrium;
  scene.solver.tolerance = 1e-11;
  const auto world = load_world(scene);
  REQUIRE(solve(scene, *world).converged);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  MeasuredPlaces measured;
  const std::vector<Vec3> x = world->positions();
  for (std::size_t n = 5; n < x.size(); n += 2) {
    measured.nodes.push_back(static_cast<int>(n));
    measured.places.push_back(x[n] + noise * Vec3(normal(random), normal(random), normal(random)));
    if (noise > 0) measured.sigma.push_back(noise);
  }
  return measured;
}

}  // namespace

TEST_CASE("scene fit: the modulus of a rod is that of Hooke's law") {
  const double young = 5000, traction = 0.01;  // a strain of 2e-6: Poisson's ratio 0 leaves the cross section as it is
  const Scene scene = block(2000, 0, traction);
  MeasuredPlaces measured;
  const std::vector<Vec3> rest = load_world(scene)->positions();
  for (std::size_t n = 0; n < rest.size(); ++n) {
    measured.nodes.push_back(static_cast<int>(n));
    measured.places.push_back(rest[n] + Vec3(traction / young * rest[n].x(), 0, 0));
  }
  const SceneFit fit = fit_scene(scene, measured, {{"materials[0].young", {}}});
  CHECK(fit.converged);
  CHECK(fit.numbers[0].initial == doctest::Approx(2000));
  CHECK(fit.numbers[0].value == doctest::Approx(young).epsilon(1e-5));
}

TEST_CASE("scene fit: two numbers are found again, with intervals that hold them") {
  const Scene truth = block(5000, 0.3, 800);
  const std::vector<FitStart> starts{{"materials[0].young", 3000.}, {"materials[0].poisson", 0.2}};
  const SceneFit exact = fit_scene(block(3000, 0.3, 800), places_in(truth, 0), starts);
  CHECK(exact.numbers[0].value == doctest::Approx(5000).epsilon(1e-5));
  CHECK(exact.numbers[1].value == doctest::Approx(0.3).epsilon(1e-4));
  CHECK(exact.rms < 1e-8);

  const SceneFit noisy = fit_scene(truth, places_in(truth, 1e-4), starts);
  CHECK(noisy.converged);
  CHECK(noisy.rms == doctest::Approx(1e-4).epsilon(0.2));
  for (std::size_t i = 0; i < 2; ++i) {
    const double value = i ? 0.3 : 5000;
    CHECK(noisy.numbers[i].standard_error > 0);
    CHECK(std::abs(noisy.numbers[i].value - value) < 3 * noisy.numbers[i].standard_error);
  }
  CHECK(load_setup(noisy.scene).materials.size() == 1);
  const SceneFit again = fit_scene(noisy.scene, places_in(truth, 1e-4), {{"materials[0].young", {}}});
  CHECK(again.numbers[0].value == doctest::Approx(noisy.numbers[0].value).epsilon(1e-3));
}

TEST_CASE("scene fit: moduli of a law are found from starts far off, to either side") {
  const auto bar = [](double K1, double kappa) {
    return parse_scene(fmt::format(R"({{
      "schema_version": 1, "mesh": {{"box": {{"size": [0.1, 0.02, 0.02], "cells": [5, 1, 1]}}}},
      "materials": [{{"law": "neo_hookean_iso", "K1": {}, "kappa": {}}}],
      "boundary": [{{"box": [[-1, -1, -1], [1e-6, 1, 1]], "fix": true}}],
      "loads": [{{"box": [[0.0999, -1, -1], [1, 1, 1]], "traction": [200, -20, 0]}}],
      "solver": {{"threads": 1}}
    }})",
                                   K1, kappa),
                       "bar.json");
  };
  const MeasuredPlaces measured = places_in(bar(1000, 2e4), 1e-5);
  const std::pair<double, double> starts[] = {{10, 6e3}, {1e4, 200}, {1e5, 2e5}, {300, 2e6}};
  for (const auto& start : starts) {
    const double K1 = start.first, kappa = start.second;
    CAPTURE(K1);
    CAPTURE(kappa);
    const SceneFit fit = fit_scene(bar(1000, 2e4), measured, {{"materials[0].K1", K1}, {"materials[0].kappa", kappa}});
    CHECK(fit.converged);
    CHECK(fit.numbers[0].value == doctest::Approx(1000).epsilon(0.01));
    CHECK(fit.numbers[1].value == doctest::Approx(2e4).epsilon(0.05));
  }
}

TEST_CASE("scene fit: a bar that would hang straight down is found as stiff as it is") {
  const auto bar = [](double K1, double kappa) {
    return parse_scene(fmt::format(R"({{
      "schema_version": 1, "mesh": {{"box": {{"size": [0.1, 0.02, 0.02], "cells": [4, 1, 1]}}}},
      "materials": [{{"law": "neo_hookean_iso", "K1": {}, "kappa": {}, "density": 1000}}],
      "boundary": [{{"box": [[-1, -1, -1], [1e-6, 1, 1]], "fix": true}}],
      "gravity": [0, -9.81, 0], "solver": {{"threads": 1}}
    }})",
                                   K1, kappa),
                       "bar.json");
  };
  const MeasuredPlaces measured = places_in(bar(6000, 1e5), 1e-5);
  const SceneFit fit = fit_scene(bar(600, 5e6), measured, {{"materials[0].K1", {}}, {"materials[0].kappa", {}}});
  CHECK(fit.converged);
  CHECK(fit.numbers[0].value == doctest::Approx(6000).epsilon(0.01));
  CHECK(fit.numbers[1].value == doctest::Approx(1e5).epsilon(0.05));
}

TEST_CASE("scene fit: what the places do not tell is said") {
  const Scene scene = block(5000, 0.3, 800);
  const MeasuredPlaces measured = places_in(scene, 1e-4);
  const SceneFit fit = fit_scene(scene, measured, {{"materials[0].young", {}}, {"loads[0].traction[0]", {}}});
  CHECK(std::isinf(fit.numbers[0].standard_error));  // load and modulus alone set no scale
  CHECK(std::isinf(fit.numbers[1].standard_error));
  MeasuredPlaces beyond = measured;
  beyond.nodes[0] = 1000;
  CHECK_THROWS_AS(fit_scene(scene, beyond, {{"materials[0].young", {}}}), InputError);
  CHECK_THROWS_AS(fit_scene(scene, measured, {{"materials[1].young", {}}}), InputError);
  CHECK_THROWS_AS(fit_scene(scene, measured, {{"materials[0].poisson", 0.7}}), InputError);
}

TEST_CASE("scene fit: a table of places is read, or refused by line") {
  const TemporaryFolder folder;
  const auto read = [&](const char* text) { return read_places_csv(folder.file("places.csv", text)); };
  const MeasuredPlaces measured = read("# scan\nnode,x,y,z,sigma\n3,1,2,3,0.5\n\n7,4,5e-1,6,1\n");
  CHECK(measured.nodes == std::vector{3, 7});
  CHECK(measured.places[1] == Vec3(4, 0.5, 6));
  CHECK(measured.sigma == std::vector{0.5, 1.0});
  CHECK(read("node,x,y,z\n0,0,0,0\n").sigma.empty());
  for (const char* text : {"", "node,x,y\n1,2,3\n", "node,x,y,z\n", "node,x,y,z\n-1,0,0,0\n", "node,x,y,z\n1,0,0\n",
                           "node,x,y,z\n1,0,0,nan\n", "node,x,y,z\n1.5,0,0,0\n", "node,x,y,z,sigma\n1,0,0,0,0\n",
                           "node,x,y,z\n1,0,0,0,0\n"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(read(text), InputError);
  }
}

}  // namespace heml::scene_fit_test
