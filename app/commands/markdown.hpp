#pragma once
// Markdown of the reference pages.
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace heml {

/// A table grown row by row. Bars within cells are escaped.
class MarkdownTable {
 public:
  explicit MarkdownTable(std::initializer_list<std::string_view> head);
  void add(std::initializer_list<std::string> cells);  ///< as many as the head has
  std::string text() const;                            ///< with an empty line after it; nothing where there is no row

 private:
  std::string head_, rows_;
};

/// Prose and examples of a command's help: lines of prose as they are, lines that are indented as a block of code, a
/// line "Examples:" left out.
std::string markdown_of_help(std::string_view help);

/// The anchor of a heading, as pages link to it.
std::string anchor(std::string_view heading);

}  // namespace heml
