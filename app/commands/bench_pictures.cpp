#include <fmt/format.h>

#include <algorithm>
#include <app/commands/bench_pictures.hpp>
#include <app/commands/chart_picture.hpp>
#include <app/panel/bar_chart.hpp>
#include <app/panel/theme.hpp>
#include <heml/base/error.hpp>
#include <optional>

namespace heml {
namespace {

using panel::colours::rgba;
constexpr ImU32 double_colour = rgba(0x2a8578), float_colour = rgba(0xc2552d);
constexpr ImU32 pale_double = rgba(0x9ecac3), pale_float = rgba(0xe6b7a3);

/// One bar per law and precision: of the best instruction set, on the largest body of the kernel suite, one thread.
std::optional<panel::BarChart> ratios_chart(const std::vector<BenchRow>& rows) {
  const auto counts = [](const BenchRow& row) {
    return row.suite == "kernel" && row.ratio_to_naive && row.threads == 1;
  };
  const BenchRow* largest = nullptr;
  for (const BenchRow& row : rows)
    if (counts(row) && (!largest || row.tets >= largest->tets)) largest = &row;
  if (!largest) return std::nullopt;
  panel::BarChart chart;
  chart.title = "Forces, against a naive loop in double";
  chart.subtitle =
      fmt::format("{}, {} tetrahedra, one thread; speedup over the naive loop", largest->mesh, largest->tets);
  chart.names = {"double", "float"};
  chart.colours = {double_colour, float_colour};
  chart.mark = 1;
  for (const BenchRow& row : rows) {
    if (!counts(row) || row.mesh != largest->mesh) continue;
    if (chart.groups.empty() || chart.groups.back().label != row.law) chart.groups.push_back({row.law, {0, 0}});
    double& bar = chart.groups.back().values[row.precision == "double" ? 0 : 1];
    bar = std::max(bar, *row.ratio_to_naive);
  }
  return chart;
}

/// Error of the forces against distance from the origin, for the largest body of the paper suite.
std::optional<panel::Chart> translated_precision_chart(const std::vector<BenchRow>& rows) {
  std::string mesh;
  for (const BenchRow& row : rows)
    if (row.more.contains("error_when_carried")) mesh = row.mesh;
  if (mesh.empty()) return std::nullopt;
  panel::Chart chart;
  chart.title = "Loss of precision far from the origin";
  chart.subtitle = mesh + ", Saint Venant-Kirchhoff";
  chart.x_label = "Distance, body sizes";
  chart.y_quantity = "Relative error of the forces";
  chart.logarithmic = true;
  for (const BenchRow& row : rows) {
    if (row.mesh != mesh || !row.more.contains("error_when_carried")) continue;
    const std::string name = row.name + ", " + row.precision;
    if (!chart.series.empty() && chart.series.back().name == name) continue;  // with another instruction set
    const bool is_double = row.precision == "double", is_heml = row.name == "HEML";
    panel::ChartSeries& series = chart.series.emplace_back();
    series.name = name;
    series.colour = is_heml ? (is_double ? double_colour : float_colour) : (is_double ? pale_double : pale_float);
    series.thickness = is_heml ? 1.6f : 1.2f;
    for (const Json& point : row.more["error_when_carried"]) series.points.push_back({point[0], point[1]});
  }
  return chart;
}

}  // namespace

std::vector<std::filesystem::path> write_bench_pictures(const std::filesystem::path& folder,
                                                        const std::vector<BenchRow>& rows) {
  std::vector<std::filesystem::path> files;
  if (const auto chart = ratios_chart(rows)) {
    files.push_back(folder / "ratios.png");
    write_chart(files.back(), *chart);
  }
  if (const auto chart = translated_precision_chart(rows)) {
    files.push_back(folder / "carried.png");
    write_chart(files.back(), *chart);
  }
  return files;
}

}  // namespace heml
