#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <studies/table.hpp>

namespace heml {
namespace {

/// In characters, not bytes: names have Greek letters in them.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

bool is_number(const TextTable& table, std::size_t column) {
  return column >= table.first_number && column < table.end_numbers;
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? "\"\"" : std::string(1, c);
  return cell + "\"";
}

std::string csv_line(const Cells& cells) {
  std::string line;
  for (const std::string& cell : cells) line += (line.empty() && &cell == &cells.front() ? "" : ",") + csv_cell(cell);
  return line + "\n";
}

std::string html_line(const TextTable& table, const Cells& cells, const char* tag) {
  std::string line = "<tr>";
  for (std::size_t c = 0; c < cells.size(); ++c)
    line += fmt::format("<{}{}>{}</{}>", tag, is_number(table, c) ? " class=number" : "", html_escaped(cells[c]), tag);
  return line + "</tr>\n";
}

}  // namespace

std::string markdown_text(const TextTable& table) {
  std::vector<std::size_t> width(table.head.size(), 3);
  const auto widen = [&](const Cells& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c) width[c] = std::max(width[c], width_of(cells[c]));
  };
  widen(table.head);
  for (const Cells& row : table.rows) widen(row);
  std::string text;
  const auto add = [&](const Cells& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const std::string space(width[c] - width_of(cells[c]), ' ');
      text += is_number(table, c) ? fmt::format("| {}{} ", space, cells[c]) : fmt::format("| {}{} ", cells[c], space);
    }
    text += "|\n";
  };
  add(table.head);
  for (std::size_t c = 0; c < width.size(); ++c)
    text += fmt::format("|{:-<{}}{}", "", width[c] + 1, is_number(table, c) ? ':' : '-');
  text += "|\n";
  for (const Cells& row : table.rows) add(row);
  return text;
}

std::string csv_text(const TextTable& table) {
  std::string text = csv_line(table.head);
  for (const Cells& row : table.rows) text += csv_line(row);
  return text;
}

std::string html_text(const TextTable& table) {
  std::string text = "<table>\n<thead>" + html_line(table, table.head, "th") + "</thead>\n<tbody>\n";
  for (const Cells& row : table.rows) text += html_line(table, row, "td");
  return text + "</tbody>\n</table>\n";
}

std::string short_number(double value) {
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (!std::isfinite(value)) return std::isnan(value) ? "not a number" : "infinite";
  if (size >= 1e5) return fmt::format("{:.3g}", value);
  return size >= 1000  ? fmt::format("{:.0f}", value)
         : size >= 100 ? fmt::format("{:.1f}", value)
         : size >= 10  ? fmt::format("{:.2f}", value)
         : size >= 0.1 ? fmt::format("{:.3f}", value)
                       : fmt::format("{:.3g}", value);
}

std::string html_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

}  // namespace heml
