#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <studies/bench.hpp>
#include <studies/bench_tables.hpp>
#include <studies/machine.hpp>

namespace heml {
namespace {

struct Suite {
  std::string_view name;
  std::vector<BenchRow> (*run)(const BenchOptions&);
  std::string_view title;
};
constexpr Suite suites[] = {{"paper", paper_suite, "The bodies of Goulette & Chendeb 2006"},
                            {"kernel", kernel_suite, "One force evaluation"},
                            {"step", step_suite, "Whole steps"},
                            {"terms", terms_suite, "Steps with one term added to a law"},
                            {"threads", threads_suite, "Steps on several threads, with and without another program"},
                            {"roofline", roofline_suite, "What the machine has, and what of it is used"}};

const Suite& suite_named(std::string_view name) {
  const auto found = std::find_if(std::begin(suites), std::end(suites), [&](const Suite& s) { return s.name == name; });
  assert(found != std::end(suites));
  return *found;
}

}  // namespace

std::span<const std::string_view> bench_suites() {
  static const auto names = [] {
    std::array<std::string_view, std::size(suites)> result;
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = suites[i].name;
    return result;
  }();
  return names;
}

std::vector<BenchRow> run_bench(std::string_view suite, const BenchOptions& options) {
  auto rows = suite_named(suite).run(options);
  for (BenchRow& row : rows) row.suite = suite;
  return rows;
}

Json to_json(const std::vector<BenchRow>& rows) {
  const Json machine = to_json(this_machine());
  Json list = Json::array();
  for (const BenchRow& row : rows) {
    Json json = {{"suite", row.suite},         {"name", row.name}, {"mesh", row.mesh},
                 {"nodes", row.nodes},         {"tets", row.tets}, {"law", row.law},
                 {"precision", row.precision}, {"isa", row.isa},   {"threads", row.threads},
                 {"median", row.median},       {"min", row.min},   {"unit", row.unit}};
    if (row.ratio_to_naive) json["ratio_to_naive"] = *row.ratio_to_naive;
    json.update(row.more);
    json["machine"] = machine;
    list.push_back(std::move(json));
  }
  return list;
}

std::string bench_table(const std::vector<BenchRow>& rows) {
  const Machine machine = this_machine();
  std::string text = fmt::format("heml {}, {}, {} cores, {}, {}; naive loops with {}\n", machine.version, machine.cpu,
                                 machine.cores, machine.compiler, machine.flags, machine.naive_flags);
  for (auto first = rows.begin(); first != rows.end();) {
    const auto last = std::find_if(first, rows.end(), [&](const BenchRow& row) { return row.suite != first->suite; });
    text += fmt::format("\n## {}: {}\n\n", first->suite, suite_named(first->suite).title);
    text += suite_tables({first, last});
    first = last;
  }
  return text;
}

}  // namespace heml
