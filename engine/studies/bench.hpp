#pragma once
// The speed measurements of `heml bench` (app/docs/commands.md). Every suite returns rows. The suites share the bodies
// (bench_bodies.hpp), the naive loop as baseline (naive.hpp) and interleaved timing (interleaved_timing.hpp).
//
//   paper     the five bodies of the paper: time and counted operations, HEML and Mass-Tensor
//   kernel    one force evaluation: every law, precision, instruction set, 1 and all threads, 320 to 1M tetrahedra
//   step      whole steps, explicit and implicit
//   terms     whole steps with viscosity, relaxation and the like, beside steps of the law alone
//   threads   whole steps with 1 to all threads, on an idle machine and with one core taken by another process
//   roofline  peak arithmetic and bandwidth of the machine, and the fraction of them that the kernels reach
#include <functional>
#include <heml/scenario/json_text.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace heml {

/// One measured value. Empty strings and zeros: not applicable.
struct BenchRow {
  std::string suite, name, mesh;
  std::size_t nodes = 0, tets = 0;
  std::string law, precision, isa;
  int threads = 1;
  double median = 0, min = 0;
  std::string unit;                      ///< "ns/tet", "ms", "GB/s", "GFLOP/s", "operations"
  std::optional<double> ratio_to_naive;  ///< minimum of the naive loop over that of this row
  Json more = Json::object();            ///< further fields
  std::string remark;                    ///< for the text table: the main further field, in words
};

struct BenchOptions {
  bool quick = false;  ///< all suites within a minute: fewer and smaller bodies, fewer samples
  /// Called repeatedly with what is being measured and the fraction of the suite that is done, 0 to 1.
  std::function<void(const std::string& what, double fraction)> progress = [](const std::string&, double) {};
};

/// "paper", "kernel", "step", "terms", "threads", "roofline".
std::span<const std::string_view> bench_suites();

/// suite: one of bench_suites(). Reads the wall clock; uses all cores.
std::vector<BenchRow> run_bench(std::string_view suite, const BenchOptions& options);

/// The list of `heml bench --json`; each row carries the `machine` it was measured on.
Json to_json(const std::vector<BenchRow>& rows);

/// Aligned Markdown with a heading per suite. Kernels: one line per law and mesh, with the times of the fastest
/// instruction set.
std::string bench_table(const std::vector<BenchRow>& rows);

// One function per suite, called by run_bench().
std::vector<BenchRow> paper_suite(const BenchOptions& options);
std::vector<BenchRow> kernel_suite(const BenchOptions& options);
std::vector<BenchRow> step_suite(const BenchOptions& options);
std::vector<BenchRow> terms_suite(const BenchOptions& options);
std::vector<BenchRow> threads_suite(const BenchOptions& options);
std::vector<BenchRow> roofline_suite(const BenchOptions& options);

}  // namespace heml
