#include <fmt/format.h>

#include <algorithm>
#include <studies/bench_tables.hpp>
#include <studies/table.hpp>

namespace heml {

std::string roofline_tables(std::span<const BenchRow> rows) {
  TextTable peaks, reached;
  peaks.head = {"what", "precision", "isa", "threads", "median", "best", "unit"};
  peaks.first_number = 3, peaks.end_numbers = 6;
  std::string best_isa;
  for (const BenchRow& row : rows) {
    if (row.name == "force") continue;
    if (!row.isa.empty()) best_isa = row.isa;  // rows are in ascending order of instruction sets
    peaks.rows.push_back({row.name, row.precision, row.isa, std::to_string(row.threads), short_number(row.median),
                          short_number(row.more["best"]), row.unit});
  }
  reached.head = {"mesh",      "law",   "precision", "threads",       "ns/tet",       "operations",
                  "slow ones", "bytes", "GFLOP/s",   "of arithmetic", "of bandwidth", "limit"};
  reached.first_number = 3, reached.end_numbers = reached.head.size() - 1;
  for (const BenchRow& row : rows) {
    if (row.name != "force" || row.isa != best_isa) continue;
    const auto percent = [&](const char* key) { return fmt::format("{:.0f} %", 100 * row.more[key].get<double>()); };
    reached.rows.push_back(
        {row.mesh, row.law, row.precision, std::to_string(row.threads), short_number(row.more["ns_per_tet"]),
         fmt::format("{:.0f}", row.more["operations_per_tet"].get<double>()),
         fmt::format("{:.0f}", row.more["slow_operations_per_tet"].get<double>()),
         fmt::format("{:.0f}", row.more["bytes_per_tet"].get<double>()), short_number(row.median),
         percent("fraction_of_arithmetic"),
         percent("fraction_of_bandwidth") + " " + row.more["memory_level"].get<std::string>(), row.more["limit"]});
  }
  return fmt::format("{}\n{}, the fastest instruction set; --json has the others\n\n{}", markdown_text(peaks), best_isa,
                     markdown_text(reached));
}

}  // namespace heml
