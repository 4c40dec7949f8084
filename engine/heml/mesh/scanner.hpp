#pragma once
// Words and numbers of a text file in memory, with the line for messages. Every failure is an InputError that names
// both.
#include <cstdint>
#include <heml/mesh/tet_mesh.hpp>
#include <limits>
#include <string>
#include <string_view>

namespace heml {

/// A word as a message may show it: short, printable, in quotes.
std::string in_quotes(std::string_view word);

class Scanner {
 public:
  /// comment: starts a comment that runs to the end of its line (0: none). by_line: words are sought on the current
  /// line only, next_line() moves on; else anywhere ahead. The text must outlive the scanner.
  Scanner(std::string file, std::string_view text, char comment = 0, bool by_line = false);

  bool next_line();                              ///< to the next line that holds a word; false: there is none
  void need_line(std::string_view what);         ///< likewise; throws when there is none
  void need_word(std::string_view what);         ///< moves to a later line where this one has no word left; throws
  bool has_word();                               ///< whether another word is in reach
  std::string_view peek();                       ///< the next word, not consumed; empty: none
  std::string_view word(std::string_view what);  ///< `what` it should be: for messages
  double number(std::string_view what);          ///< finite
  double any_number(std::string_view what);      ///< nan and inf too
  Vec3 point(std::string_view what);             ///< three numbers
  long long integer(std::string_view what, long long low = std::numeric_limits<int>::min(),
                    long long high = std::numeric_limits<int>::max());
  long long wide_integer(std::string_view what);  ///< of 64 bits
  /// How many of something are to follow, each of at least `values` numbers: refused when the rest of the file cannot
  /// hold them, so that it may be allocated for.
  std::size_t count(std::string_view what, std::size_t values);
  void end_line(std::string_view of);     ///< throws when the current line goes on
  std::string_view rest_of_line();        ///< and moves behind it
  std::string_view bytes(std::size_t n);  ///< raw; throws when fewer are left
  std::size_t left() const { return text_.size() - position_; }
  std::size_t size() const { return text_.size(); }

  std::string_view rest() const { return text_.substr(position_); }

  /// The text up to the next such character (or the end) as a scanner of its own; this one moves there.
  Scanner until(char stop);
  /// Moves behind the next occurrence; false: there is none, and nothing moved.
  bool skip_past(std::string_view mark);

  std::size_t line() const;  ///< of the last word read, from 1
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy = "") const;

 private:
  void skip_blanks();
  [[noreturn]] void fail_missing(std::string_view what);

  std::string file_;
  std::string_view text_;
  char comment_;
  bool by_line_;
  bool started_ = false;  ///< whether there is a current line
  std::size_t position_ = 0;
  std::size_t last_ = 0;  ///< where the last word began
};

}  // namespace heml
