#pragma once
// Runs the benchmarks and makes the report.
#include <filesystem>
#include <map>
#include <studies/study_context.hpp>
#include <studies/table.hpp>
#include <studies/validation/benchmark.hpp>

namespace heml::validation {

/// What a benchmark has found.
struct Validated {
  const Benchmark* benchmark;
  Finding finding;
};

/// All benchmarks. Those that the context's results hold are not run again.
std::vector<Validated> run_study(bool quick, const StudyContext& context);

bool is_sound(const std::vector<Validated>& study);  ///< no row misses or fails
std::string answer(const std::vector<Validated>& study);
/// One line a row that misses or fails.
std::vector<std::string> shortfalls(const std::vector<Validated>& study);
/// All rows, numbers with 17 digits.
TextTable row_table(const std::vector<Validated>& study);
/// pictures: PNG file of the chart of each benchmark that has one.
std::string html_report(const std::vector<Validated>& study,
                        const std::map<std::string, std::filesystem::path>& pictures, bool quick);

}  // namespace heml::validation
