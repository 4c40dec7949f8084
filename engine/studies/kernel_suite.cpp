#include <fmt/format.h>

#include <studies/bench.hpp>
#include <studies/force_timing.hpp>

namespace heml {
namespace {

struct Cube {
  int n;
  bool irregular;
};

std::vector<Cube> cubes(bool quick) {
  if (quick) return {{4, false}, {4, true}, {9, true}};
  std::vector<Cube> list;
  for (const int n : {4, 9, 13, 27, 58})
    for (const bool irregular : {false, true}) list.push_back({n, irregular});
  return list;
}

}  // namespace

std::vector<BenchRow> kernel_suite(const BenchOptions& options) {
  std::vector<BenchRow> rows;
  const auto list = cubes(options.quick);
  const auto materials = bench_materials();
  double done = 0;
  for (const Cube& cube : list) {
    const BenchBody body = bench_cube(cube.n, cube.irregular);
    for (const Material& material : materials) {
      options.progress(fmt::format("kernel: {}, {}", body.name, material.law),
                       done++ / static_cast<double>(list.size() * materials.size()));
      TimingLimits limits;
      limits.seconds = options.quick ? 0.15 : 1.5;
      limits.min_rounds = options.quick ? 3 : 5;
      limits.min_sample = options.quick ? 2e-4 : 1e-3;
      for (const ForceTiming& timing : time_forces(body, material, limits)) rows.push_back(force_row(timing, body));
    }
  }
  return rows;
}

}  // namespace heml
