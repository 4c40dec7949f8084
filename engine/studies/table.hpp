#pragma once
// A table of text, written as Markdown, CSV or HTML.
#include <cstddef>
#include <string>
#include <vector>

namespace heml {

using Cells = std::vector<std::string>;

struct TextTable {
  Cells head;
  std::vector<Cells> rows;                        ///< each as long as the head
  std::size_t first_number = 0, end_numbers = 0;  ///< right-aligned columns [first, end)
};

std::string markdown_text(const TextTable& table);  ///< aligned columns; every row ends in a newline
std::string csv_text(const TextTable& table);       ///< RFC 4180; the head first
std::string html_text(const TextTable& table);      ///< a <table>; cells are escaped

/// A number for a table: three or four digits, "1.2e-07" if small.
std::string short_number(double value);

/// Escapes &, <, > and ".
std::string html_escaped(const std::string& text);

}  // namespace heml
