#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <fstream>
#include <heml/base/warning_collector.hpp>
#include <heml/scenario/positions_csv.hpp>
#include <heml/scenario/solve.hpp>
#include <heml/scenario/text_file.hpp>
#include <utility>
#include <vector>

namespace heml::solve_test {
namespace {

constexpr double g = 9.81, step = 1e-3;

/// A body in free fall: without other forces every node moves like a point mass.
std::string falling(const std::string& patch) {
  Json scene = test::small_scene();
  scene.merge_patch(Json::parse(R"({
    "boundary": null, "gravity": [0, -9.81, 0], "materials": [{"law": "stvk", "young": 100, "poisson": 0.3}],
    "solver": {"integrator": "symplectic_euler", "rate": null, "step": 1e-3, "duration": 0.0104}})"));
  scene.merge_patch(Json::parse(patch));
  return scene.dump();
}

/// Free fall of a point by symplectic Euler; m, m/s.
struct Fall {
  double y = 0, v = 0;
};
Fall fall_through(const std::vector<double>& steps, double gravity = g) {
  Fall fall;
  for (const double h : steps) {
    fall.v -= gravity * h;
    fall.y += fall.v * h;
  }
  return fall;
}

Json report_in(const TemporaryFolder& folder) { return Json::parse(read_text_file(folder / "report.json")); }

void check_fallen(const std::filesystem::path& csv, const Scene& scene, double y) {
  const std::vector<Vec3> rest = load_setup(scene).mesh.nodes;
  const std::vector<Vec3> positions = read_positions_csv(csv, static_cast<int>(rest.size()));
  for (std::size_t i = 0; i < rest.size(); ++i) CHECK((positions[i] - rest[i] - Vec3(0, y, 0)).norm() < 1e-15);
}

}  // namespace

TEST_CASE("lands on output times and on the duration by shortened steps") {
  const TemporaryFolder folder;
  const Scene scene = parse_scene(falling(R"({"outputs": {"times": [0.0025, 0.001, 0.0027]}})"), "fall.json");
  double last = 0;
  const auto progress = [&](double fraction) { CHECK(fraction > std::exchange(last, fraction)); };
  const SolveResult result = solve(scene, folder / "", progress);
  CHECK(!result.halt);
  CHECK(result.time == doctest::Approx(0.0104).epsilon(1e-12));
  const double h = step;
  check_fallen(folder / "positions_1.csv", scene, fall_through({h}).y);
  check_fallen(folder / "positions_0.csv", scene, fall_through({h, h, h / 2}).y);
  check_fallen(folder / "positions_2.csv", scene, fall_through({h, h, h / 2, 0.0002}).y);
  const Fall end = fall_through({h, h, h / 2, 0.0002, 0.0003, h, h, h, h, h, h, h, 0.0004});
  check_fallen(folder / "positions.csv", scene, end.y);

  const Json report = report_in(folder);
  const double mass = 1000 * 0.2 * 0.1 * 0.1;
  CHECK(report["converged"] == true);
  CHECK(report["load"] == 1);
  CHECK(report["steps"] == 13);
  CHECK(report["kinetic_energy"].get<double>() == doctest::Approx(mass * end.v * end.v / 2).epsilon(1e-9));
  CHECK(report["potential_energy"].get<double>() == doctest::Approx(mass * g * end.y).epsilon(1e-9));
  CHECK(std::abs(report["elastic_energy"].get<double>()) < 1e-15);
  CHECK(report["min_J"].get<double>() == doctest::Approx(1).epsilon(1e-9));
  CHECK(report["max_J"].get<double>() == doctest::Approx(1).epsilon(1e-9));
  CHECK(report["inverted"] == 0);
  CHECK(report["reaction"] == Json::array());
  CHECK(report["nodes"] == 12);
  CHECK(report["tets"] == 10);
  CHECK(report["state_hash"].get<std::string>().size() == 16);
  CHECK(report["wall_seconds"].get<double>() >= 0);
  for (const char* key : {"iterations", "residual"}) CHECK(report.contains(key));
}

TEST_CASE("plays the scene's events while it solves") {
  const TemporaryFolder folder;
  const Scene scene = parse_scene(
      falling(R"({"solver": {"duration": 0.01}, "events": [{"at": 0.004, "gravity": [0, 0, 0]}]})"), "fall.json");
  solve(scene, folder / "");
  const Fall before = fall_through(std::vector<double>(4, step));
  check_fallen(folder / "positions.csv", scene, before.y + 6 * step * before.v);
}

TEST_CASE("gives the state at time 0 and the last state when they are asked for as outputs") {
  const TemporaryFolder folder;
  const char* patch = R"({"solver": {"duration": 0.01}, "outputs": {"times": [0, 0.01], "vtu": true}})";
  const Scene scene = parse_scene(falling(patch), "fall.json");
  solve(scene, folder / "");
  check_fallen(folder / "positions_0.csv", scene, 0);
  CHECK(read_text_file(folder / "positions_1.csv") == read_text_file(folder / "positions.csv"));
  for (const char* name : {"positions.vtu", "positions_0.vtu", "positions_1.vtu"})
    CHECK(std::filesystem::exists(folder / name));
}

TEST_CASE("writes what was reached when a step is unstable, and leaves no output of an earlier run") {
  const TemporaryFolder folder;
  folder.file("positions_1.csv", "of an earlier run");
  const Scene scene = test::small_scene_with(R"({"gravity": [0, -9.81, 0], "materials": [{"law": "stvk", "young": 1e7,
    "poisson": 0.3}], "solver": {"rate": null, "step": 0.05, "duration": 100}, "outputs": {"times": [0, 100]}})");
  const SolveResult result = solve(scene, folder / "");
  REQUIRE(result.halt);
  CHECK(result.time < 100);
  const Json report = report_in(folder);
  CHECK(report["converged"] == false);
  CHECK(report["halt"]["message"] == result.halt->message);
  for (const Vec3& x : read_positions_csv(folder / "positions.csv", 12)) CHECK(x.allFinite());
  CHECK(std::filesystem::exists(folder / "positions_0.csv"));
  CHECK(!std::filesystem::exists(folder / "positions_1.csv"));
}

TEST_CASE("gives the support's reaction of a constrained body under its weight") {
  const TemporaryFolder folder;
  const Scene scene = test::small_scene_with(
      R"({"gravity": [0, -9.81, 0], "solver": {"damping": 20, "duration": 3}, "materials": [{"law": "neo_hookean",
      "young": 1e5, "poisson": 0.3}]})");
  CHECK(!solve(scene, folder / "").halt);
  const Json reaction = report_in(folder)["reaction"];
  REQUIRE(reaction.size() == 1);
  CHECK(reaction[0][1].get<double>() == doctest::Approx(2 * g).epsilon(1e-4));  // 2 kg
}

namespace {

/// A bar that is stretched by 50 %, statically.
std::string drawn_out(const std::string& patch) {
  Json scene = test::small_scene();
  scene.merge_patch(Json::parse(R"({
    "boundary": [{"box": [[0, -1, -1], [0, 1, 1]], "fix": true},
                 {"box": [[0.2, -1, -1], [0.2, 1, 1]], "translate": [0.1, 0, 0], "over": 7}],
    "solver": {"integrator": "static", "tolerance": 1e-10, "rate": null, "duration": 3}})"));
  scene.merge_patch(Json::parse(patch));
  return scene.dump();
}

}  // namespace

TEST_CASE("solves a static scene and lands on fractions of its load") {
  const TemporaryFolder folder;
  const Scene scene = parse_scene(drawn_out(R"({"outputs": {"times": [0.5, 0, 1]}})"), "draw.json");
  CHECK(!solve(scene, folder / "").halt);
  const std::vector<Vec3> rest = load_setup(scene).mesh.nodes;
  const auto far_x = [&](const char* name) {
    const std::vector<Vec3> x = read_positions_csv(folder / name, static_cast<int>(rest.size()));
    for (std::size_t n = 0; n < rest.size(); ++n)
      if (rest[n].x() > 0.199) return x[n].x();
    return 0.0;
  };
  CHECK(far_x("positions_0.csv") == doctest::Approx(0.25).epsilon(1e-14));
  CHECK(far_x("positions_1.csv") == doctest::Approx(0.2).epsilon(1e-14));
  CHECK(far_x("positions_2.csv") == doctest::Approx(0.3).epsilon(1e-14));
  CHECK(read_text_file(folder / "positions_2.csv") == read_text_file(folder / "positions.csv"));
  const Json report = report_in(folder);
  CHECK(report["converged"] == true);
  CHECK(report["load"] == 1);
  CHECK(report["residual"].get<double>() <= 1e-10);
  CHECK(report["iterations"].get<int>() > 0);
  CHECK(report["steps"].get<int>() >= 3);
  CHECK(report["kinetic_energy"] == 0);
  CHECK(report["inverted"] == 0);
  CHECK(report["reaction"][1][0].get<double>() > 0);
  CHECK(report["reaction"][0][0].get<double>() ==
        doctest::Approx(-report["reaction"][1][0].get<double>()).epsilon(1e-8));
}

TEST_CASE("writes the last equilibrium and the fraction of the load where a static scene has no other") {
  const TemporaryFolder folder;
  const Scene scene = parse_scene(drawn_out(R"({"boundary": [{"box": [[0, -1, -1], [0, 1, 1]], "fix": true},
                                 {"box": [[0.2, -1, -1], [0.2, 1, 1]], "translate": [-0.19, 0, 0]}],
                    "outputs": {"times": [0.01, 1]}})"),
                                  "crush.json");
  const SolveResult result = solve(scene, folder / "");
  REQUIRE(result.halt);
  const Json report = report_in(folder);
  CHECK(report["converged"] == false);
  CHECK(report["halt"]["cause"] == "not_converged");
  CHECK(report["load"].get<double>() > 0.01);
  CHECK(report["load"].get<double>() < 1);
  CHECK(report["residual"].get<double>() <= 1e-10);
  CHECK(report["min_J"].get<double>() > 0);
  CHECK(std::filesystem::exists(folder / "positions_0.csv"));
  CHECK(!std::filesystem::exists(folder / "positions_1.csv"));
}

TEST_CASE("refuses output times that are no fractions of a static load") {
  const TemporaryFolder folder;
  for (const char* times : {"1.5", "2"}) {
    const std::string patch = std::string(R"({"outputs": {"times": [0.5, )") + times + "]}}";
    CHECK(says(refusal([&] { solve(parse_scene(drawn_out(patch), "draw.json"), folder / ""); }),
                     "fractions of the load"));
  }
}

TEST_CASE("runs a scene by each implicit method") {
  for (const char* integrator : {"backward_euler", "bdf2", "tr_bdf2", "auto"}) {
    const TemporaryFolder folder;
    const Scene scene = test::small_scene_with(std::string(R"({"gravity": [0, -9.81, 0], "solver": {"rate": null,
      "step": 0.02, "duration": 0.1, "integrator": ")") +
                                               integrator + "\"}}");
    CHECK(!solve(scene, folder / "").halt);
    const Json report = report_in(folder);
    CHECK(report["time"].get<double>() == doctest::Approx(0.1));
    CHECK(report["steps"] == 5);
    CHECK(report["iterations"].get<int>() >= 5);
    CHECK(report["potential_energy"].get<double>() < 0);
  }
}

TEST_CASE("a static scene in float ends at the tolerance of float, also where its values are round-off before") {
  const TemporaryFolder folder;
  const Json scene = Json::parse(R"({"schema_version": 1,
    "mesh": {"box": {"size": [0.1, 0.04, 0.04], "cells": [4, 2, 2]}},
    "materials": [{"law": "mooney_rivlin", "K1": 1000, "K2": 300, "kappa": 2e5}],
    "boundary": [{"box": [[-1, -1, -1], [1e-9, 1, 1]], "fix": true},
                 {"box": [[0.0499, -1, -1], [0.0501, 1e-9, 1]], "translate": [0, 0.004, 0]}],
    "gravity": [0, -9.81, 0], "loads": [{"box": [[0.0999, -1, -1], [1, 1, 1]], "traction": [5, -10, 0]}],
    "solver": {"integrator": "static", "element": "p2", "precision": "float"}})");
  CHECK_FALSE(solve(parse_scene(scene.dump(), "box.json"), folder / "").halt);
  const Json report = report_in(folder);
  CHECK(report["converged"] == true);
  CHECK(report["residual"].get<double>() <= 1e-4);
}

TEST_CASE("tells of events that a static scene leaves out, and of a force on nodes of no element") {
  const TemporaryFolder folder;
  folder.file("loose.mesh",
              "MeshVersionFormatted 2\nDimension 3\nVertices\n5\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n5 5 5 0\n"
              "Tetrahedra\n1\n1 2 3 4 0\nEnd\n");
  const Json scene = Json::parse(R"({"schema_version": 1, "mesh": {"file": "loose.mesh"},
    "materials": [{"law": "neo_hookean", "young": 1e4, "poisson": 0.3}],
    "boundary": [{"nodes": [0, 1, 2], "fix": true}], "loads": [{"nodes": [3, 4], "force": [0, 0, 1]}],
    "solver": {"integrator": "static"},
    "events": [{"step": 0, "gravity": [0, 0, -1]}, {"step": 3, "gravity": [0, 0, 0]}]})");
  const WarningCollector warnings;
  CHECK_FALSE(solve(parse_scene(scene.dump(), (folder / "scene.json").string()), folder / "out").halt);
  const auto tells = [&](const std::string& words) {
    return std::any_of(warnings.texts().begin(), warnings.texts().end(),
                       [&](const std::string& text) { return text.find(words) != std::string::npos; });
  };
  CHECK(tells("scene.json: 1 of 2 events are left out"));
  CHECK(tells("loads[0]: 1 of its 2 nodes belong to no element"));
}

TEST_CASE("tells of given steps that backward Euler takes where another method's rounding is above the tolerance") {
  const TemporaryFolder folder;
  const Json scene =
      Json::parse(R"({"schema_version": 1, "mesh": {"box": {"size": [0.1, 0.04, 0.04], "cells": [4, 2, 2]}},
    "materials": [{"law": "neo_hookean", "young": 1e4, "poisson": 0.3}], "gravity": [0, -3, 0],
    "boundary": [{"box": [[-1, -1, -1], [1e-9, 1, 1]], "fix": true}], "initial": {"velocity": [0.1, 0.2, 0]},
    "solver": {"integrator": "tr_bdf2", "step": 1.25e-4, "duration": 0.005, "tolerance": 1e-10}})");
  const WarningCollector warnings;
  CHECK_FALSE(solve(parse_scene(scene.dump(), "box.json"), folder / "").halt);
  CHECK(report_in(folder)["damped_steps"] > 0);
  REQUIRE(warnings.texts().size() == 1);
  CHECK(warnings.texts()[0].find("of 40 steps did not converge by tr_bdf2; backward Euler took them") !=
        std::string::npos);
}

TEST_CASE("tells once of written states with inverted elements, and of none in a run without them") {
  const TemporaryFolder folder;
  const auto told = [&](const std::string& patch) {
    Json scene = test::small_scene();  // stvk, which has energy at J <= 0 too
    scene.merge_patch(Json::parse(R"({"mesh": {"box": {"cells": [1, 1, 1]}},
      "outputs": {"times": [0, 0.02, 0.04]}, "solver": {"duration": 0.04}})"));
    scene.merge_patch(Json::parse(patch));
    const WarningCollector warnings;
    CHECK_FALSE(solve(parse_scene(scene.dump(), "box.json"), folder / "").halt);
    return warnings.texts();
  };
  const std::vector<std::string> moved = told(R"({"boundary": [{"box": [[0, -1, -1], [0, 1, 1]], "fix": true},
    {"box": [[0.2, -1, -1], [1, 1, 1]], "translate": [-0.3, 0, 0]}]})");
  REQUIRE(moved.size() == 1);
  CHECK(says(moved[0], {"box.json: positions_0: 5 of 5 elements are inverted or flat (J ≤ 0)", "with J = -0.5",
                        "so have 3 of the states after it"}));
  CHECK(report_in(folder)["inverted"] == 5);
  CHECK(told(R"({"gravity": [0, -1, 0]})").empty());
}

TEST_CASE("refuses an output folder that is a file") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.file("out", "");
  CHECK(says(refusal([&] { solve(test::small_scene_with("{}"), file); }), "out: cannot be made"));
  CHECK(says(refusal([&] { solve(test::small_scene_with("{}"), file / "in"); }), "cannot be made"));
}

}  // namespace heml::solve_test
