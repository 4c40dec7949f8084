// `heml bench`: speed, measured on this machine.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <app/commands/bench_pictures.hpp>
#include <app/commands/commands.hpp>
#include <app/commands/progress.hpp>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/base/write_file.hpp>
#include <studies/bench.hpp>

namespace heml {
namespace {

std::vector<std::string_view> chosen_suites(const std::string& suite) {
  const auto all = bench_suites();
  if (suite.empty()) return {all.begin(), all.end()};
  if (std::find(all.begin(), all.end(), suite) == all.end())
    throw UsageError(fmt::format("bench {}: the suites are {}", suite, fmt::join(all, ", ")));
  return {suite};
}

void write_json(const std::filesystem::path& path, const std::vector<BenchRow>& rows) {
  write_file(path, json_text(to_json(rows), path.string(), true) + "\n");
}

}  // namespace

int bench(const BenchArguments& arguments) {
  const auto suites = chosen_suites(arguments.suite);
  if (arguments.json) expect_writable_file(*arguments.json, "--json");  // fails before the measurement
  if (arguments.out) make_folder(*arguments.out);
  std::vector<BenchRow> rows;
  {
    Progress progress("measuring");
    BenchOptions options;
    options.quick = arguments.quick;
    double done = 0;
    options.progress = [&](const std::string& what, double fraction) {
      progress.show((done + fraction) / static_cast<double>(suites.size()), what);
    };
    for (const std::string_view suite : suites) {
      for (BenchRow& row : run_bench(suite, options)) rows.push_back(std::move(row));
      if (arguments.json) write_json(*arguments.json, rows);
      ++done;
    }
  }
  fmt::print("{}", bench_table(rows));
  if (arguments.out)
    for (const auto& picture : write_bench_pictures(*arguments.out, rows)) log_info("wrote {}", picture.string());
  return exit_done;
}

}  // namespace heml
