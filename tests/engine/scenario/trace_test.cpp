#include <doctest/doctest.h>

#include <cmath>
#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <heml/base/error.hpp>
#include <heml/scenario/solve.hpp>
#include <heml/scenario/text_file.hpp>
#include <sstream>
#include <vector>

namespace heml::trace_test {
namespace {

/// Cells of a CSV file by rows, the header first.
std::vector<std::vector<std::string>> table_in(const std::filesystem::path& path) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream text(read_text_file(path));
  for (std::string line; std::getline(text, line);) {
    std::istringstream cells(line);
    for (rows.emplace_back(); std::getline(cells, line, ',');) rows.back().push_back(line);
  }
  return rows;
}

Scene falling(const std::string& outputs) {
  Json scene = test::small_scene();
  scene.merge_patch(Json::parse(R"({"boundary": null, "gravity": [0, -9.81, 0],
    "solver": {"integrator": "symplectic_euler", "rate": null, "step": 1e-3, "duration": 0.0104}})"));
  scene["outputs"] = Json::parse(outputs);
  return parse_scene(scene.dump(), "fall.json");
}

}  // namespace

TEST_CASE("markers follow the mean of their nodes, a row a tick and one at the end") {
  const TemporaryFolder folder;
  const Scene scene = falling(R"({"markers": [{"name": "tip", "nodes": [3]}, {"box": [[-9, -9, -9], [9, 9, 9]]}]})");
  solve(scene, folder / "");
  const auto rows = table_in(folder / "markers.csv");
  CHECK(rows[0] == std::vector<std::string>{"time", "marker", "x", "y", "z", "vx", "vy", "vz"});
  REQUIRE(rows.size() == 1 + 2 * 12);  // at 0, after each of ten ticks, and at 0.0104 s
  const double start = std::stod(rows[1][3]);
  CHECK(rows[1][1] == "tip");
  CHECK(rows[2][1] == "1");
  // After k whole steps of symplectic Euler: v = −k g h, y = −k (k + 1)/2 g h².
  for (int k = 0; k <= 10; ++k) {
    const auto& row = rows[1 + 2 * static_cast<std::size_t>(k)];
    CHECK(std::stod(row[0]) == doctest::Approx(1e-3 * k));
    CHECK(std::stod(row[3]) - start == doctest::Approx(-k * (k + 1) / 2.0 * 9.81e-6).epsilon(1e-9));
    CHECK(std::stod(row[6]) == doctest::Approx(-9.81e-3 * k).epsilon(1e-9));
  }
  CHECK(std::stod(rows.back()[0]) == doctest::Approx(0.0104));
}

TEST_CASE("rows of markers and history come as often as asked, at the first tick at or after each multiple") {
  const TemporaryFolder folder;
  solve(falling(R"({"markers": [{"nodes": [0]}], "history": true, "every": 0.0025})"), folder / "");
  const auto markers = table_in(folder / "markers.csv"), history = table_in(folder / "history.csv");
  REQUIRE(markers.size() == 6);
  REQUIRE(history.size() == 6);
  const double times[] = {0, 0.003, 0.005, 0.008, 0.01};
  for (std::size_t k = 0; k < 5; ++k) {
    CHECK(std::stod(markers[k + 1][0]) == doctest::Approx(times[k]));
    CHECK(history[k + 1][0] == markers[k + 1][0]);
  }
  CHECK(history[0].size() == 9);  // no constrained nodes, so no reactions
  // m v²/2 of free fall quadruples when the time doubles.
  CHECK(std::stod(history[5][1]) / std::stod(history[3][1]) == doctest::Approx(4).epsilon(1e-9));
}

TEST_CASE("a time between rows that is shorter than any tick gives a row a tick") {
  const TemporaryFolder folder;
  solve(falling(R"({"history": true})"), folder / "a");
  solve(falling(R"({"history": true, "every": 5e-324})"), folder / "b");
  CHECK(table_in(folder / "b/history.csv") == table_in(folder / "a/history.csv"));
}

TEST_CASE("rows and landings are at the time since the start, also after an undo and a reset") {
  const TemporaryFolder folder;
  Scene scene = falling(R"({"markers": [{"nodes": [3]}], "history": true, "times": [0.0042, 0.008]})");
  const Command push = SetGravity{Vec3(0, 5, 0)};
  scene.events = {{2, push}, {5, StepHistory{-1}}, {7, Reset{}}};
  solve(scene, folder / "");
  const auto rows = table_in(folder / "markers.csv"), history = table_in(folder / "history.csv");
  std::vector<double> times, heights;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    times.push_back(std::stod(rows[k][0]));
    heights.push_back(std::stod(rows[k][3]));
    CHECK(history[k][0] == rows[k][0]);
  }
  const double expected[] = {0, 1, 2, 3, 4, 4.2, 5, 6, 7, 8, 9, 10, 10.4};  // ms
  REQUIRE(times.size() == std::size(expected));
  for (std::size_t k = 0; k < times.size(); ++k) CHECK(times[k] == doctest::Approx(1e-3 * expected[k]));
  CHECK(heights[7] - heights[0] == doctest::Approx(-6 * 9.81e-6));  // the third step without the push
  CHECK(heights[9] == heights[1]);                                  // the first after the reset
  const auto landed = table_in(folder / "positions_1.csv");
  CHECK(std::stod(landed[1 + 3][2]) == heights[9]);
}

TEST_CASE("tables that were not asked for are not written, and those of an earlier run go") {
  const TemporaryFolder folder;
  folder.file("markers.csv", "of an earlier run");
  folder.file("history.csv", "of an earlier run");
  solve(falling("{}"), folder / "");
  CHECK(!std::filesystem::exists(folder / "markers.csv"));
  CHECK(!std::filesystem::exists(folder / "history.csv"));
}

TEST_CASE("a marker that selects nothing is an error that names it, as is a name that breaks a table") {
  const TemporaryFolder folder;
  const auto problem_of = [&](const std::string& outputs) -> std::string {
    try {
      solve(falling(outputs), folder / "");
      return "none";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  CHECK(problem_of(R"({"markers": [{"nodes": [0]}, {"sphere": [[99, 0, 0], 1]}]})").find("outputs.markers[1]") !=
        std::string::npos);
  CHECK(problem_of(R"({"markers": [{"nodes": [0], "name": "a,b"}]})").find("outputs.markers[0].name") !=
        std::string::npos);
  CHECK(problem_of(R"({"every": 0})").find("outputs.every") != std::string::npos);
}

}  // namespace heml::trace_test
