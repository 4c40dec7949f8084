#include <algorithm>
#include <app/commands/markdown.hpp>
#include <cctype>

namespace heml {
namespace {

template <class Cells>
std::string table_row(const Cells& cells) {
  std::string row = "|";
  for (const std::string_view cell : cells) {
    row += ' ';
    for (const char letter : cell) row += letter == '|' ? std::string("\\|") : std::string(1, letter);
    row += cell.empty() ? "|" : " |";
  }
  return row + "\n";
}

/// "positions_<k>.csv" in prose would lose its "<k>", which Markdown takes for a tag.
std::string without_tags(std::string_view prose) {
  std::string text;
  for (const char letter : prose) text += letter == '<' ? std::string("\\<") : std::string(1, letter);
  return text;
}

}  // namespace

MarkdownTable::MarkdownTable(std::initializer_list<std::string_view> head)
    : head_(table_row(head) + table_row(std::vector<std::string_view>(head.size(), "---"))) {}

void MarkdownTable::add(std::initializer_list<std::string> cells) { rows_ += table_row(cells); }

std::string MarkdownTable::text() const { return rows_.empty() ? "" : head_ + rows_ + "\n"; }

std::string markdown_of_help(std::string_view help) {
  std::string text;
  bool in_code = false;
  while (!help.empty()) {
    const std::string_view line = help.substr(0, help.find('\n'));
    help.remove_prefix(std::min(line.size() + 1, help.size()));
    const bool is_code = line.starts_with("  ");
    if (is_code && !in_code) text += text.empty() || text.ends_with("\n\n") ? "```\n" : "\n```\n";
    if (!is_code && in_code) text += "```\n\n";
    in_code = is_code;
    if (line != "Examples:") text += (is_code ? std::string(line.substr(2)) : without_tags(line)) + "\n";
  }
  if (in_code) text += "```\n";
  return text.empty() ? "" : text + "\n";
}

std::string anchor(std::string_view heading) {
  std::string text;
  for (const char letter : heading) {
    if (letter == ' ') text += '-';
    if (std::isalnum(static_cast<unsigned char>(letter)) || letter == '_' || letter == '-')
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return text;
}

}  // namespace heml
