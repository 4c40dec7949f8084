#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <heml/studies/bench.hpp>
#include <heml/studies/machine.hpp>
#include <heml/studies/table.hpp>
#include <set>

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
                            {"roofline", roofline_suite, "What the machine has, and what of it is used"}};

const Suite& suite_named(std::string_view name) {
  const auto found = std::find_if(std::begin(suites), std::end(suites), [&](const Suite& s) { return s.name == name; });
  assert(found != std::end(suites));
  return *found;
}

/// Notes a row carries, said once each.
std::string notes_of(std::span<const BenchRow> rows) {
  std::vector<std::string> said;
  std::string text;
  for (const BenchRow& row : rows) {
    if (!row.more.contains("note")) continue;
    const std::string note = row.more["note"];
    if (std::find(said.begin(), said.end(), note) != said.end()) continue;
    said.push_back(note);
    text += fmt::format("- {}: {}\n", row.name, note);
  }
  return text.empty() ? text : fmt::format("\n{}", text);
}

/// Least time and ratio of the fastest of the rows that `wanted` takes.
template <class Wanted>
std::string fastest(std::span<const BenchRow> rows, const Wanted& wanted) {
  const BenchRow* best = nullptr;
  for (const BenchRow& row : rows)
    if (row.ratio_to_naive && wanted(row) && (!best || row.min < best->min)) best = &row;
  return best ? fmt::format("{} ({:.1f}×)", short_number(best->min), *best->ratio_to_naive) : "";
}

/// A line a mesh and law, of neighbouring rows: what a naive loop takes, then precisions and numbers of threads.
std::string kernel_table(std::span<const BenchRow> rows) {
  std::set<int> threads;
  for (const BenchRow& row : rows) threads.insert(row.threads);
  TextTable table;
  table.head = {"mesh", "law", "tets", "naive"};
  for (const char* precision : {"double", "float"})
    for (const int count : threads)
      table.head.push_back(fmt::format("{}, {} thread{}", precision, count, count == 1 ? "" : "s"));
  for (auto first = rows.begin(); first != rows.end();) {
    const auto last = std::find_if(
        first, rows.end(), [&](const BenchRow& row) { return row.mesh != first->mesh || row.law != first->law; });
    Cells& line = table.rows.emplace_back(Cells{first->mesh, first->law, std::to_string(first->tets), ""});
    for (auto row = first; row != last; ++row)
      if (!row->ratio_to_naive) line[3] = short_number(row->min);
    for (const char* precision : {"double", "float"})
      for (const int count : threads)
        line.push_back(fastest(
            {first, last}, [&](const BenchRow& row) { return row.precision == precision && row.threads == count; }));
    first = last;
  }
  table.first_number = 2;
  table.end_numbers = table.head.size();
  return fmt::format(
      "ns/tet, least of all samples, and times faster than the naive loop; --json has every instruction set\n\n{}",
      markdown_text(table));
}

std::string table_of(std::span<const BenchRow> rows) {
  if (rows.front().suite == "kernel") return kernel_table(rows);
  TextTable table;
  table.head = {"what",    "mesh",   "law", "precision", "isa",        "tets",
                "threads", "median", "min", "unit",      "naive/ours", "beside"};
  table.first_number = 5;
  table.end_numbers = 11;
  for (const BenchRow& row : rows)
    table.rows.push_back({row.name, row.mesh, row.law, row.precision, row.isa, row.tets ? std::to_string(row.tets) : "",
                          std::to_string(row.threads), short_number(row.median), short_number(row.min), row.unit,
                          row.ratio_to_naive ? fmt::format("{:.2f}", *row.ratio_to_naive) : "", row.beside});
  return markdown_text(table) + notes_of(rows);
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
    text += table_of({first, last});
    first = last;
  }
  return text;
}

}  // namespace heml
