#pragma once
// Lines and cells of comma-separated text.
#include <algorithm>
#include <charconv>
#include <string_view>

namespace heml {

/// Takes the next line off a text, without its end.
inline std::string_view consume_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == text.npos ? text.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

/// Takes the next cell off a line, with the comma behind it and without spaces round it.
inline std::string_view consume_cell(std::string_view& line) {
  const std::size_t comma = line.find(',');
  std::string_view cell = line.substr(0, comma);
  line.remove_prefix(comma == line.npos ? line.size() : comma + 1);
  cell.remove_prefix(std::min(cell.find_first_not_of(" \t"), cell.size()));
  return cell.substr(0, cell.find_last_not_of(" \t") + 1);
}

/// Takes the next cell off a line as a number; returns false when it is none.
template <class Number>
bool consume_number(std::string_view& line, Number& number) {
  const std::string_view cell = consume_cell(line);
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  return error == std::errc() && end == cell.data() + cell.size();
}

}  // namespace heml
