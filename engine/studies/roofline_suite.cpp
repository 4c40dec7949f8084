#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <studies/bench.hpp>
#include <studies/force_timing.hpp>
#include <studies/machine.hpp>
#include <studies/operation_count.hpp>
#include <studies/peak.hpp>

namespace heml {
namespace {

constexpr const char* reached_note =
    "operations are those of one tetrahedron's code alone (studies/counting_scalar.hpp); fans share some of them, so "
    "that the "
    "processor does fewer than the rate says. Slow ones (divisions, roots, exponentials, logarithms) count as one, "
    "and take many times as long. Why not more: a fan's nodes lie apart, so that loads and stores of whole "
    "registers are followed by transposes; three passes over a fan write and "
    "read what does not fit the registers; and results of one are waited for in the next (a fifth of the cycles of "
    "Saint Venant-Kirchhoff in float). Small bodies run on one thread whatever the number: waking another costs more";

/// Peak rates by instruction set, precision and threads, with which kernels are compared.
struct Peaks {
  std::vector<BenchRow> arithmetic, bandwidth;

  double operations_per_ns(const ForceTiming& timing) const {
    for (const BenchRow& row : arithmetic)
      if (row.isa == timing.isa && row.precision == timing.precision && row.threads == timing.threads)
        return row.more["best"];
    return NAN;
  }
  double bytes_per_ns(const std::string& level, int threads) const {
    for (const BenchRow& row : bandwidth)
      if (row.name == "triad " + level && row.threads == threads) return row.more["best"];
    return NAN;
  }
};

TimingLimits limits_of(const BenchOptions& options) {
  TimingLimits limits;
  limits.seconds = options.quick ? 0.05 : 0.5;
  limits.min_rounds = 3;
  return limits;
}

/// `amount` (operations, bytes) per run, as 1e9 per second.
BenchRow rate_row(std::string name, const Timing& time, double amount, const char* unit, int threads) {
  BenchRow row;
  row.name = std::move(name);
  row.threads = threads;
  row.median = 1e-9 * amount / time.median;
  row.min = 1e-9 * amount / time.max;
  row.unit = unit;
  row.more = {{"best", 1e-9 * amount / time.min}, {"spread", time.spread}, {"samples", time.samples}};
  return row;
}

std::vector<BenchRow> arithmetic_rows(const BenchOptions& options) {
  constexpr long turns = 1000000;
  std::vector<BenchRow> rows;
  for (const int threads : bench_threads()) {
    ThreadTeam team(threads);
    for (const PeakLoop& loop : peak_loops()) {
      const auto work = [&] {
        team.parallel_for(static_cast<std::size_t>(threads), 1, [&](std::size_t, std::size_t) { loop.run(turns); });
      };
      const Timing time = time_interleaved({work}, limits_of(options)).front();
      BenchRow row = rate_row("peak arithmetic", time, threads * turns * loop.operations_per_turn, "GFLOP/s", threads);
      row.isa = loop.isa;
      row.precision = loop.precision;
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::vector<BenchRow> bandwidth_rows(const BenchOptions& options) {
  const Machine machine = this_machine();
  const struct {
    const char* level;
    std::size_t bytes;  ///< per thread; in total if shared
    bool shared;
  } sizes[] = {{"L1", machine.L1 / 2, false},
               {"L2", machine.L2 / 2, false},
               {"L3", machine.L3 / 2, true},
               {"DRAM", std::max<std::size_t>(4 * machine.L3, std::size_t{1} << 28), true}};
  std::vector<BenchRow> rows;
  for (const auto& size : sizes) {
    if (size.bytes < 4096) continue;  // no such cache, or its size is unknown
    for (const int threads : bench_threads()) {
      ThreadTeam team(threads);
      Triad triad(size.bytes * static_cast<std::size_t>(size.shared ? 1 : threads));
      const long turns = std::max(1L, static_cast<long>(5e7 / triad.bytes()));
      const Timing time = time_interleaved({[&] { triad.run(team, turns); }}, limits_of(options)).front();
      BenchRow row = rate_row(fmt::format("triad {}", size.level), time, static_cast<double>(turns) * triad.bytes(),
                              "GB/s", threads);
      row.precision = "double";
      row.more["bytes"] = triad.bytes();
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

/// The smallest cache level that holds the data of a kernel.
std::string level_of(double bytes, const Machine& machine, int threads) {
  if (bytes < static_cast<double>(machine.L1) * threads) return "L1";
  if (bytes < static_cast<double>(machine.L2) * threads) return "L2";
  return bytes < static_cast<double>(machine.L3) ? "L3" : "DRAM";
}

/// Divisions in the element code by its volume and by numbers; in the kernels these are constants.
constexpr double constant_divisions = 10;
constexpr std::size_t shared_from = 8192;  ///< elements; smaller bodies run on one thread (elastic/fan_forces.hpp)

/// The likely bottleneck, from the fractions of the peaks reached. slow: divisions, roots, … per tetrahedron.
std::string limit_of(double arithmetic, double bandwidth, double slow) {
  if (bandwidth > 0.6 && bandwidth > arithmetic) return "memory";
  if (slow > 2) return "divisions and roots, and what waits for them";
  if (arithmetic > 0.6) return "arithmetic, and moving nodes between lanes";
  return "moving nodes between lanes, waiting for results";
}

BenchRow reached_row(const ForceTiming& timing, const BenchBody& body, const Operations& counted, const Peaks& peaks) {
  const double of_all = 1 / static_cast<double>(body.mesh.tets.size());
  const double others = static_cast<double>(counted.others) * of_all;
  const double slow = std::max(others - constant_divisions, 0.0);
  const double operations = static_cast<double>(counted.multiplications_and_additions()) * of_all + others;
  const double tets = static_cast<double>(body.mesh.tets.size());
  BenchRow row = force_row(timing, body);
  const double best = 1e9 * timing.time.min / tets;  // ns/tet
  const std::string level = level_of(timing.bytes_per_tet * tets, this_machine(), timing.threads);
  row.unit = "GFLOP/s";
  row.median = operations / row.median;
  row.min = operations * tets / (1e9 * timing.time.max);
  row.more["operations_per_tet"] = operations;
  row.more["slow_operations_per_tet"] = slow;
  row.more["bytes_per_tet"] = timing.bytes_per_tet;
  row.more["ns_per_tet"] = best;
  row.more["memory_level"] = level;
  const double arithmetic = operations / best / peaks.operations_per_ns(timing);
  const double bandwidth = timing.bytes_per_tet / best / peaks.bytes_per_ns(level, timing.threads);
  row.more["fraction_of_arithmetic"] = arithmetic;
  row.more["fraction_of_bandwidth"] = bandwidth;
  const bool alone = timing.threads > 1 && body.mesh.tets.size() < shared_from;
  row.more["limit"] = alone ? "as on one thread: too small to share" : limit_of(arithmetic, bandwidth, slow);
  row.more["note"] = reached_note;
  row.remark = fmt::format("{:.0f} operations, {:.0f} bytes a tet: {:.0f} % of the arithmetic, {:.0f} % of {}",
                           operations, timing.bytes_per_tet, 100 * arithmetic, 100 * bandwidth, level);
  return row;
}

}  // namespace

std::vector<BenchRow> roofline_suite(const BenchOptions& options) {
  options.progress("roofline: arithmetic and bandwidth", 0);
  const Peaks peaks{arithmetic_rows(options), bandwidth_rows(options)};
  std::vector<BenchRow> rows = peaks.arithmetic;
  rows.insert(rows.end(), peaks.bandwidth.begin(), peaks.bandwidth.end());
  const std::vector<int> cubes = options.quick ? std::vector<int>{9} : std::vector<int>{9, 27};
  const auto materials = bench_materials();
  double done = 0;
  for (const int n : cubes) {
    const BenchBody body = bench_cube(n, false);
    for (const Material& material : materials) {
      options.progress(fmt::format("roofline: {}, {}", body.name, material.law),
                       done++ / static_cast<double>(cubes.size() * materials.size()));
      if (!find_law(material.law)->is_continuum) continue;
      const Operations operations = force_operations(body.mesh, material, body.x.data());
      for (const ForceTiming& timing : time_forces(body, material, limits_of(options)))
        if (!timing.naive) rows.push_back(reached_row(timing, body, operations, peaks));
    }
  }
  return rows;
}

}  // namespace heml
