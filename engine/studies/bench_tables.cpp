#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <studies/bench_tables.hpp>
#include <studies/table.hpp>

namespace heml {
namespace {

/// The notes of the rows, each once.
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

/// Time and ratio of the fastest of the rows that `wanted` accepts.
template <class Wanted>
std::string fastest(std::span<const BenchRow> rows, const Wanted& wanted) {
  const BenchRow* best = nullptr;
  for (const BenchRow& row : rows)
    if (row.ratio_to_naive && wanted(row) && (!best || row.min < best->min)) best = &row;
  return best ? fmt::format("{} ({:.1f}×)", short_number(best->min), *best->ratio_to_naive) : "";
}

}  // namespace

std::string kernel_tables(std::span<const BenchRow> rows) {
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

std::string plain_table(std::span<const BenchRow> rows) {
  TextTable table;
  table.head = {"what",    "mesh",   "law", "precision", "isa",        "tets",
                "threads", "median", "min", "unit",      "naive/ours", "beside"};
  table.first_number = 5;
  table.end_numbers = 11;
  for (const BenchRow& row : rows)
    table.rows.push_back({row.name, row.mesh, row.law, row.precision, row.isa, row.tets ? std::to_string(row.tets) : "",
                          std::to_string(row.threads), short_number(row.median), short_number(row.min), row.unit,
                          row.ratio_to_naive ? fmt::format("{:.2f}", *row.ratio_to_naive) : "", row.remark});
  return markdown_text(table);
}

std::string suite_tables(std::span<const BenchRow> rows) {
  const std::string& suite = rows.front().suite;
  if (suite == "kernel") return kernel_tables(rows);
  const std::string tables = suite == "paper"      ? paper_tables(rows)
                             : suite == "roofline" ? roofline_tables(rows)
                                                   : plain_table(rows);
  return tables + notes_of(rows);
}

}  // namespace heml
