#pragma once
// Reads words and numbers of a text file in memory. Every failure throws an InputError that names file and line.
#include <cstdint>
#include <heml/mesh/tet_mesh.hpp>
#include <limits>
#include <string>
#include <string_view>

namespace heml {

/// A word for messages: in quotes, shortened, unprintable characters replaced.
std::string in_quotes(std::string_view word);

class Scanner {
 public:
  /// comment: character that starts a comment up to the line end (0: none). by_line: words are read from the current
  /// line only, and next_line() moves to the next; otherwise line ends are blanks. The text must outlive the scanner.
  Scanner(std::string file, std::string_view text, char comment = 0, bool by_line = false);

  // `what` names the expected item in error messages.
  bool next_line();                              ///< moves to the next line with a word; false if there is none
  void expect_line(std::string_view what);       ///< likewise; throws if there is none
  void expect_word(std::string_view what);       ///< moves to a later line if this one has no word left; throws if none
  bool has_word();                               ///< whether word() can read another word
  std::string_view peek();                       ///< the next word without consuming it; empty if none
  std::string_view word(std::string_view what);  ///< the next word
  double number(std::string_view what);          ///< finite
  double any_number(std::string_view what);      ///< may be NaN or infinite
  Vec3 point(std::string_view what);             ///< three finite numbers
  long long integer(std::string_view what, long long low = std::numeric_limits<int>::min(),
                    long long high = std::numeric_limits<int>::max());
  long long wide_integer(std::string_view what);  ///< 64 bits
  /// Number of items that follow, each of at least `values` numbers. Throws if the rest of the file cannot hold them,
  /// so that memory can be allocated safely.
  std::size_t count(std::string_view what, std::size_t values);
  void end_line(std::string_view of);     ///< throws if the current line has another word
  std::string_view rest_of_line();        ///< consumes the line end too
  std::string_view bytes(std::size_t n);  ///< raw bytes; throws if fewer are left
  std::size_t left() const { return text_.size() - position_; }
  std::size_t size() const { return text_.size(); }

  std::string_view rest() const { return text_.substr(position_); }

  /// A scanner for the text up to the next `stop` (or the end); this scanner moves there.
  Scanner until(char stop);
  /// Moves after the next occurrence of `mark`; false, without moving, if there is none.
  bool skip_past(std::string_view mark);

  std::size_t line() const;               ///< line number of the last word read, from 1
  void tell_bytes() { by_byte_ = true; }  ///< errors name the byte, not the line: for binary files
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy = "") const;

 private:
  void skip_blanks();
  [[noreturn]] void fail_missing(std::string_view what);

  std::string file_;
  std::string_view text_;
  char comment_;
  bool by_line_, by_byte_ = false;
  bool started_ = false;  ///< whether there is a current line
  std::size_t position_ = 0;
  std::size_t last_ = 0;  ///< start of the last word
};

}  // namespace heml
