#include <fmt/format.h>

#include <app/commands/commands.hpp>
#include <charconv>
#include <cmath>
#include <fstream>
#include <heml/base/byte_order_mark.hpp>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/base/write_file.hpp>
#include <heml/materials/point.hpp>
#include <heml/scenario/input_files.hpp>
#include <heml/scenario/scene.hpp>
#include <limits>
#include <sstream>

namespace heml {
namespace {

struct Row {
  Mat3 F, dF;
};
struct StateTable {
  std::vector<Row> rows;
  bool has_dF = false;
};

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    const auto first = cell.find_first_not_of(" \t\r"), last = cell.find_last_not_of(" \t\r");
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

std::string header(bool with_dF) {
  std::string text;
  for (const char* prefix : {"F", "dF"}) {
    if (prefix[0] == 'd' && !with_dF) break;
    for (int r = 1; r <= 3; ++r)
      for (int c = 1; c <= 3; ++c) text += fmt::format("{}{}{}{}", text.empty() ? "" : ",", prefix, r, c);
  }
  return text;
}

StateTable read_table(const std::filesystem::path& path) {
  std::ifstream in(path);  // of a pipe too
  if (std::error_code ignored; !in || std::filesystem::is_directory(path, ignored))
    throw InputError(path.string(), "", "cannot be read", "a CSV file with the header " + header(false));
  std::string line;
  std::getline(in, line);
  line.erase(0, byte_order_mark_size(line));
  std::string names;
  for (const std::string& cell : split(line)) names += (names.empty() ? "" : ",") + cell;
  StateTable table;
  table.has_dF = names == header(true);
  if (!table.has_dF && names != header(false))
    throw InputError(path.string(), "line 1", fmt::format("the header is '{}'", names.substr(0, 80)),
                     "it must be " + header(false) + ", optionally followed by dF11 to dF33");
  const std::size_t wanted = table.has_dF ? 18 : 9;
  for (int number = 2; std::getline(in, line); ++number) {
    const auto cells = split(line);
    if (cells.empty()) continue;
    const std::string place = fmt::format("line {}", number);
    if (cells.size() != wanted)
      throw InputError(path.string(), place, fmt::format("{} values", cells.size()),
                       fmt::format("{} are wanted", wanted));
    Row row;
    for (std::size_t i = 0; i < wanted; ++i) {
      double value = 0;
      const auto [end, error] = std::from_chars(cells[i].data(), cells[i].data() + cells[i].size(), value);
      if (error != std::errc() || end != cells[i].data() + cells[i].size() || !std::isfinite(value))
        throw InputError(path.string(), place, fmt::format("'{}' is not a finite number", cells[i].substr(0, 40)));
      (i < 9 ? row.F : row.dF)(static_cast<Eigen::Index>(i % 9 / 3), static_cast<Eigen::Index>(i % 3)) = value;
    }
    table.rows.push_back(row);
  }
  return table;
}

std::string cells_of(const Mat3& matrix) {
  std::string text;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) text += fmt::format(",{:.17g}", matrix(r, c));
  return text;
}

}  // namespace

int probe(const ProbeArguments& arguments) {
  const Material material = read_material(arguments.material);
  if (!find_law(material.law)->is_continuum)
    throw UsageError(fmt::format("{}: '{}' has no energy of the deformation gradient to probe: it has edge forces only",
                                 arguments.material.string(), material.law));
  if (material.active_stress > 0 || material.has_internal_state())
    warn("{}: the law alone is evaluated, without active stress, viscosity, relaxation and plasticity",
         arguments.material.string());
  check_output_file({arguments.material, arguments.gradients}, arguments.out);
  const StateTable table = read_table(arguments.gradients);
  std::string names = "W";
  for (const char* prefix : {"P", "dP"}) {
    if (prefix[0] == 'd' && !table.has_dF) break;
    for (int i = 0; i < 9; ++i) names += fmt::format(",{}{}{}", prefix, i / 3 + 1, i % 3 + 1);
  }
  std::string out = names + '\n';
  int outside = 0;
  const auto point = make_material_point(material, false);
  const Mat3 nan = Mat3::Constant(std::numeric_limits<double>::quiet_NaN());
  for (const Row& row : table.rows) {
    const bool valid = point->valid(row.F);
    outside += valid ? 0 : 1;
    out += fmt::format("{:.17g}", valid ? point->energy(row.F) : nan(0, 0)) +
           cells_of(valid ? point->first_piola(row.F) : nan);
    if (table.has_dF) out += cells_of(valid ? point->first_piola_differential(row.F, row.dF) : nan);
    out += '\n';
  }
  write_file(arguments.out, out);
  if (outside > 0)
    warn("{}: {} of {} states are outside the range of {}: nan in their rows", arguments.gradients.string(), outside,
         table.rows.size(), material.law);
  return exit_done;
}

}  // namespace heml
