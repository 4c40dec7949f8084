#include <fmt/format.h>

#include <cmath>
#include <heml/base/error.hpp>
#include <heml/scenario/csv_text.hpp>
#include <heml/scenario/curve_csv.hpp>
#include <heml/scenario/json_text.hpp>
#include <heml/scenario/text_file.hpp>

namespace heml {
namespace {
constexpr std::size_t max_points = 5000;  // a fit evaluates each of them thousands of times
}  // namespace

std::string_view amount_name(const MeasuredTest& test) {
  if (std::holds_alternative<Relaxation>(test)) return "time";
  return std::get<BenchTest>(test) == BenchTest::shear ? "gamma" : "stretch";
}

MeasuredCurve read_curve_csv(const std::filesystem::path& path, const MeasuredTest& test) {
  const std::string content = read_text_file(path);
  std::string_view text = content;
  const std::string_view name = amount_name(test);
  const auto fail = [&](long line, const std::string& problem, const std::string& remedy) {
    throw InputError(path.string(), fmt::format("line {}", line), problem, remedy);
  };
  MeasuredCurve data;
  bool has_header = false;
  for (long line = 1; !text.empty(); ++line) {
    const std::string_view entry = consume_line(text);
    if (is_blank(entry) || entry.starts_with('#')) continue;
    std::string_view rest = entry;
    if (!has_header) {
      const std::string_view first = consume_cell(rest), second = consume_cell(rest);
      if (first != name || second != "stress" || !rest.empty())
        fail(line, fmt::format("is '{}'", shown(entry)),
             fmt::format("must be the header {},stress (stress in Pa)", name));
      has_header = true;
      continue;
    }
    double amount = 0, stress = 0;
    if (!consume_number(rest, amount) || !consume_number(rest, stress) || !rest.empty() || !std::isfinite(amount) ||
        !std::isfinite(stress))
      fail(line, fmt::format("is '{}'", shown(entry)), fmt::format("must be {},stress: two numbers", name));
    if (name == "stretch" && !(amount > 0))
      fail(line, fmt::format("the stretch is {}", amount), "must be greater than 0");
    if (name == "time" && !(amount >= 0)) fail(line, fmt::format("the time is {} s", amount), "must be 0 or more");
    if (data.amount.size() == max_points)
      fail(line, fmt::format("is past the {}th point", max_points), "thin the curve out");
    data.amount.push_back(amount);
    data.stress.push_back(stress);
  }
  if (data.amount.empty())
    throw InputError(path.string(), "", "holds no measured point",
                     fmt::format("give the header {},stress and one point a line", name));
  return data;
}

}  // namespace heml
