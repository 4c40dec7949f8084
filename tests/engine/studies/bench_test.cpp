#include <doctest/doctest.h>

#include <set>
#include <studies/bench.hpp>
#include <studies/force_timing.hpp>
#include <thread>

namespace heml::bench_test {

TEST_CASE("works timed in turn are all run, their least time is no more than the median") {
  int runs[2] = {0, 0};
  TimingLimits limits;
  limits.seconds = 0;
  limits.min_rounds = 4;
  limits.min_sample = 1e-5;
  const auto times = time_interleaved({[&] { ++runs[0]; }, [&] { ++runs[1]; }}, limits);
  REQUIRE(times.size() == 2);
  for (int k = 0; k < 2; ++k) {
    CHECK(runs[k] > 4);
    CHECK(times[static_cast<std::size_t>(k)].samples == 4);
    CHECK(times[static_cast<std::size_t>(k)].min > 0);
    CHECK(times[static_cast<std::size_t>(k)].min <= times[static_cast<std::size_t>(k)].median);
    CHECK(times[static_cast<std::size_t>(k)].spread >= 0);
  }
}

TEST_CASE("a force evaluation is timed in both precisions, every instruction set and number of threads") {
  const BenchBody body = bench_cube(2, true);
  TimingLimits limits;
  limits.seconds = 0;
  limits.min_rounds = 1;
  limits.min_sample = 1e-6;
  for (const Material& material : bench_materials()) {
    CAPTURE(material.law);
    const auto timings = time_forces(body, material, limits);
    REQUIRE(timings.size() == 1 + 2 * kernels_of(material).size() * bench_threads().size());
    CHECK(timings.front().naive);
    CHECK_FALSE(force_row(timings.front(), body).ratio_to_naive);
    const BenchRow naive = force_row(timings.front(), body);
    std::set<std::tuple<std::string, std::string, int>> kinds;
    for (std::size_t k = 1; k < timings.size(); ++k) {
      // What a reader of the rows takes it for: how many times less a tetrahedron takes than of the naive loop.
      const BenchRow row = force_row(timings[k], body);
      REQUIRE(row.ratio_to_naive);
      CHECK(*row.ratio_to_naive * row.min == doctest::Approx(naive.min));
      kinds.insert({row.precision, row.isa, row.threads});
    }
    CHECK(kinds.size() + 1 == timings.size());
  }
}

TEST_CASE("an irregular cube keeps its surface and turns no tetrahedron over") {
  const BenchBody body = bench_cube(5, true);
  for (const Tet& tet : body.mesh.tets) {
    const auto node = [&](std::size_t a) { return body.mesh.nodes[static_cast<std::size_t>(tet[a])]; };
    CHECK(signed_volume(node(0), node(1), node(2), node(3)) > 0);
  }
  double volume = 0;
  for (const Tet& tet : body.mesh.tets) {
    const auto node = [&](std::size_t a) { return body.mesh.nodes[static_cast<std::size_t>(tet[a])]; };
    volume += signed_volume(node(0), node(1), node(2), node(3));
  }
  CHECK(volume == doctest::Approx(1e-3));
}

TEST_CASE("rows become JSON with the documented fields, and a table of whole lines") {
  BenchRow row;
  row.suite = "kernel";
  row.name = "force";
  row.mesh = "regular cube 4";
  row.nodes = 125, row.tets = 320;
  row.law = "stvk", row.precision = "double", row.isa = "avx2", row.unit = "ns/tet";
  row.median = 12.5, row.min = 12;
  row.more = {{"spread", 0.1}, {"note", "said once"}};
  BenchRow ours = row;
  ours.ratio_to_naive = 3.25;
  const Json json = to_json({row, ours});
  REQUIRE(json.size() == 2);
  for (const char* key : {"suite", "name", "mesh", "nodes", "tets", "law", "precision", "isa", "threads", "median",
                          "min", "unit", "spread", "machine"})
    CHECK(json[0].contains(key));
  CHECK_FALSE(json[0].contains("ratio_to_naive"));
  CHECK(json[1]["ratio_to_naive"] == 3.25);
  CHECK(json[1]["min"] == 12);
  CHECK_FALSE(json[0]["machine"]["compiler"].get<std::string>().empty());
  CHECK(bench_table({row, ours}).find("12.00 (3.2×)") != std::string::npos);
  row.suite = ours.suite = "step";
  const std::string table = bench_table({row, ours});
  CHECK(table.find("## step") != std::string::npos);
  CHECK(table.find("3.25") != std::string::npos);
  const std::size_t note = table.find("said once");
  REQUIRE(note != std::string::npos);
  CHECK(table.find("said once", note + 1) == std::string::npos);
}

}  // namespace heml::bench_test
