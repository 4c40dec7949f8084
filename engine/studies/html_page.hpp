#pragma once
// A report as one self-contained HTML file: text, tables and embedded images.
#include <filesystem>
#include <string>
#include <string_view>
#include <studies/table.hpp>

namespace heml {

class HtmlPage {
 public:
  explicit HtmlPage(const std::string& title);

  void heading(const std::string& text);
  /// All text arguments are escaped; `code` in backquotes becomes <code>, except in command().
  void paragraph(const std::string& text);
  void answer(const std::string& text);   ///< a highlighted paragraph
  void command(const std::string& text);  ///< a command line, preformatted
  void table(const TextTable& table);
  void details(const std::string& summary, const TextTable& table);  ///< a collapsed table
  void png(const std::filesystem::path& file, const std::string& caption);
  void svg(const std::string& picture, const std::string& caption);

  std::string text() const;  ///< the whole file

 private:
  std::string title_, body_;
};

std::string base64(std::string_view bytes);

}  // namespace heml
