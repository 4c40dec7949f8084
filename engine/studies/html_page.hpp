#pragma once
// A report as one HTML file that needs no other: text, tables, and pictures inside it.
#include <filesystem>
#include <string>
#include <string_view>
#include <studies/table.hpp>

namespace heml {

class HtmlPage {
 public:
  explicit HtmlPage(const std::string& title);

  void heading(const std::string& text);
  /// In all of these text is plain and escaped; `code` in backquotes is set as such.
  void paragraph(const std::string& text);
  void answer(const std::string& text);   ///< a paragraph that stands out: what a reader came for
  void command(const std::string& text);  ///< a line for a terminal
  void table(const TextTable& table);
  void details(const std::string& summary, const TextTable& table);  ///< a table that opens when asked for
  void png(const std::filesystem::path& file, const std::string& caption);
  void svg(const std::string& picture, const std::string& caption);

  std::string text() const;  ///< the whole file

 private:
  std::string title_, body_;
};

std::string base64(std::string_view bytes);

}  // namespace heml
