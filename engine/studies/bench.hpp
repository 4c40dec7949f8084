#pragma once
// Speed, measured: what `heml bench` runs. Every suite gives rows (contract, "heml bench"); what they have in common
// are bodies (bench_bodies.hpp), the naive loop that ours is compared with (naive.hpp), and works timed in turn
// (interleaved_timing.hpp).
//
//   paper     the five bodies of the paper: time and counted operations, HEML and Mass-Tensor
//   kernel    one force evaluation: every law, precision, instruction set, 1 and all threads, 320 to 1M tetrahedra
//   step      whole steps, explicit and implicit
//   threads   whole steps with 1 to all threads, on an idle machine and with one core taken by another process
//   roofline  peak arithmetic and bandwidth of the machine, and what of them the kernels reach
#include <functional>
#include <heml/scenario/json_text.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace heml {

/// One figure. Empty texts and zeros: does not apply.
struct BenchRow {
  std::string suite, name, mesh;
  std::size_t nodes = 0, tets = 0;
  std::string law, precision, isa;
  int threads = 1;
  double median = 0, min = 0;
  std::string unit;                      ///< "ns/tet", "ms", "GB/s", "GFLOP/s", "operations"
  std::optional<double> ratio_to_naive;  ///< of minima: naive/ours
  Json more = Json::object();            ///< further fields
  std::string remark;                    ///< for the table alone: the most telling of them, in words
};

struct BenchOptions {
  bool quick = false;  ///< all suites within a minute: fewer and smaller bodies, fewer samples
  /// Called now and then: what is measured, and how much of the suite is done, 0 to 1.
  std::function<void(const std::string& what, double fraction)> progress = [](const std::string&, double) {};
};

/// "paper", "kernel", "step", "threads", "roofline".
std::span<const std::string_view> bench_suites();

/// suite: one of them. Reads the clock; takes all cores.
std::vector<BenchRow> run_bench(std::string_view suite, const BenchOptions& options);

/// The contract's list, each row with what it was measured on (`machine`).
Json to_json(const std::vector<BenchRow>& rows);

/// For people: Markdown, aligned, a heading a suite. Of the kernels a line a law and mesh, with the fastest instruction
/// set's figures.
std::string bench_table(const std::vector<BenchRow>& rows);

// One a suite; run_bench() calls them.
std::vector<BenchRow> paper_suite(const BenchOptions& options);
std::vector<BenchRow> kernel_suite(const BenchOptions& options);
std::vector<BenchRow> step_suite(const BenchOptions& options);
std::vector<BenchRow> threads_suite(const BenchOptions& options);
std::vector<BenchRow> roofline_suite(const BenchOptions& options);

}  // namespace heml
