#pragma once
// A table of text, and the ways it is written.
#include <cstddef>
#include <string>
#include <vector>

namespace heml {

using Cells = std::vector<std::string>;

struct TextTable {
  Cells head;
  std::vector<Cells> rows;                        ///< each as long as the head
  std::size_t first_number = 0, end_numbers = 0;  ///< columns that are set to the right
};

std::string markdown_text(const TextTable& table);  ///< columns aligned, a line end behind every row
std::string csv_text(const TextTable& table);       ///< RFC 4180; the head first
std::string html_text(const TextTable& table);      ///< a <table>; cells are escaped

/// A figure as a table shows it: three or four digits, "1.2e-07" where it is small.
std::string short_number(double value);

/// &, <, > and " as HTML wants them.
std::string html_escaped(const std::string& text);

}  // namespace heml
