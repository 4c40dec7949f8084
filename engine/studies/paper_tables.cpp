#include <fmt/format.h>

#include <algorithm>
#include <studies/bench_tables.hpp>
#include <studies/table.hpp>

namespace heml {
namespace {

using Rows = std::span<const BenchRow>;

/// The fastest of the rows that `wanted` accepts.
template <class Wanted>
const BenchRow* least(Rows rows, const Wanted& wanted) {
  const BenchRow* best = nullptr;
  for (const BenchRow& row : rows)
    if (wanted(row) && (!best || row.min < best->min)) best = &row;
  return best;
}

std::vector<std::string> bodies_of(Rows rows) {
  std::vector<std::string> names;
  for (const BenchRow& row : rows)
    if (std::find(names.begin(), names.end(), row.mesh) == names.end()) names.push_back(row.mesh);
  return names;
}

const BenchRow* count_of(Rows rows, const std::string& mesh, std::string_view method) {
  return least(rows, [&](const BenchRow& row) {
    return row.unit == "operations" && row.mesh == mesh && row.name == method && row.law == "stvk";
  });
}

std::string thousands(const BenchRow* row) { return row ? fmt::format("{:.0f}", row->min / 1000) : ""; }
std::string printed_thousands(const BenchRow* row) {
  return row && row->more.contains("printed") ? fmt::format("{:.0f}", row->more["printed"].get<double>() / 1000) : "";
}

/// One line per body: operations printed in the paper and counted here.
std::string table_3(Rows rows) {
  TextTable table;
  table.head = {"body",          "tets",          "Mass-Tensor, printed", "Mass-Tensor, counted",
                "without zeros", "HEML, printed", "HEML, counted",        "HEML/Mass-Tensor, printed",
                "counted"};
  table.first_number = 1, table.end_numbers = table.head.size();
  for (const std::string& mesh : bodies_of(rows)) {
    const BenchRow *heml = count_of(rows, mesh, "HEML"), *tensor = count_of(rows, mesh, "Mass-Tensor");
    if (!heml || !tensor) continue;
    const double printed = heml->more["printed"].get<double>() / tensor->more["printed"].get<double>();
    table.rows.push_back({mesh, std::to_string(heml->tets), printed_thousands(tensor), thousands(tensor),
                          thousands(count_of(rows, mesh, "Mass-Tensor, no zeros")), printed_thousands(heml),
                          thousands(heml), fmt::format("{:.1f} %", 100 * printed),
                          fmt::format("{:.1f} %", 100 * heml->min / tensor->min)});
  }
  return "Table 3 of the paper, beside ours: multiplications and additions of one force field, thousands\n\n" +
         markdown_text(table);
}

std::string table_2(Rows rows) {
  TextTable table;
  table.head = {"body",          "tets",  "HEML, printed, 2006", "double", "float", "Mass-Tensor, double",
                "without zeros", "naive", "naive/HEML, float"};
  table.first_number = 1, table.end_numbers = table.head.size();
  for (const std::string& mesh : bodies_of(rows)) {
    const auto time = [&](std::string_view name, std::string_view precision) {
      return least(rows, [&](const BenchRow& row) {
        return row.unit == "ms" && row.mesh == mesh && row.name == name && row.precision == precision &&
               row.threads == 1;
      });
    };
    const auto text = [&](std::string_view name, std::string_view precision) {
      const BenchRow* row = time(name, precision);
      return row ? short_number(row->min) : "";
    };
    const BenchRow* fastest = time("HEML", "float");
    if (!fastest) continue;
    table.rows.push_back({mesh, std::to_string(fastest->tets),
                          fmt::format("{}", fastest->more["printed"].get<double>()), text("HEML", "double"),
                          text("HEML", "float"), text("Mass-Tensor", "double"), text("Mass-Tensor, no zeros", "double"),
                          text("naive", "double"), fmt::format("{:.1f}", *fastest->ratio_to_naive)});
  }
  return "Table 2 of the paper, beside ours: one force field, one thread, ms, least of all samples\n\n" +
         markdown_text(table);
}

/// Operations of the other laws, which the paper says are of the same order.
std::string other_laws(Rows rows) {
  TextTable table;
  table.head = {"law", "multiplications", "additions", "divisions, roots, ...", "times Saint Venant-Kirchhoff"};
  table.first_number = 1, table.end_numbers = table.head.size();
  double stvk = 0, most = 0;
  for (const BenchRow& row : rows) {
    if (!row.more.contains("a_tetrahedron")) continue;
    const Json& count = row.more["a_tetrahedron"];
    const double both = count[0].get<double>() + count[1].get<double>();
    if (row.law == "stvk") stvk = both;
    most = std::max(most, both / stvk);
    table.rows.push_back({row.law, fmt::format("{:.0f}", count[0].get<double>()),
                          fmt::format("{:.0f}", count[1].get<double>()), fmt::format("{:.0f}", count[2].get<double>()),
                          fmt::format("{:.2f}", both / stvk)});
  }
  if (table.rows.empty()) return "";
  return fmt::format(
      "\nOperations of a tetrahedron, every law. The paper says that its laws are of the same order: they are; the "
      "most "
      "is {:.1f} times Saint Venant-Kirchhoff, of the law by principal stretches, which the paper leaves out\n\n{}",
      most, markdown_text(table));
}

/// Force errors of the largest body after translation.
std::string carried(Rows rows) {
  const BenchRow* at = nullptr;
  for (const BenchRow& row : rows)
    if (row.more.contains("error_when_carried") && (!at || row.tets >= at->tets)) at = &row;
  if (!at) return "";
  const auto errors = [&](std::string_view name, std::string_view precision) -> Json {
    for (const BenchRow& row : rows)
      if (row.mesh == at->mesh && row.name == name && row.precision == precision &&
          row.more.contains("error_when_carried"))
        return row.more["error_when_carried"];
    return Json::array();
  };
  TextTable table;
  table.head = {"sizes of the body", "HEML, double", "HEML, float", "Mass-Tensor, double", "Mass-Tensor, float"};
  table.end_numbers = table.head.size();
  const Json lists[] = {errors("HEML", "double"), errors("HEML", "float"), errors("Mass-Tensor", "double"),
                        errors("Mass-Tensor", "float")};
  bool heml_is_better = true;
  for (std::size_t k = 0; k < lists[0].size(); ++k) {
    Cells& line = table.rows.emplace_back(Cells{fmt::format("{:g}", lists[0][k][0].get<double>())});
    for (const Json& list : lists) line.push_back(fmt::format("{:.1e}", list[k][1].get<double>()));
    for (const std::size_t i : {0u, 1u})
      heml_is_better = heml_is_better && (lists[0][k][0] == 0 || lists[i][k][1] < lists[i + 2][k][1]);
  }
  return fmt::format(
      "\nWhat the forces of a body lose that is carried away ({}), relative to those where it was. The paper says that "
      "HEML loses less than Mass-Tensor: it {}\n\n{}",
      at->mesh,
      heml_is_better ? "does at every distance; its error grows as the distance, as that of any difference of places, "
                       "that of Mass-Tensor as its cube"
                     : "does not everywhere here",
      markdown_text(table));
}

}  // namespace

std::string paper_tables(std::span<const BenchRow> rows) {
  return table_3(rows) + "\n" + table_2(rows) + other_laws(rows) + carried(rows);
}

}  // namespace heml
