#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <heml/base/byte_order_mark.hpp>
#include <heml/base/error.hpp>
#include <heml/mesh/scanner.hpp>

namespace heml {
namespace {

bool is_blank(char c) { return c == ' ' || ('\t' <= c && c <= '\r'); }

// std::from_chars() accepts no leading plus.
std::string_view without_plus(std::string_view word) {
  return word.starts_with('+') && !word.starts_with("+-") ? word.substr(1) : word;
}

// Whether a decimal number out of the range of double is an underflow.
bool is_tiny(std::string_view word) {
  const std::size_t e = word.find_first_of("eE");
  return e != std::string_view::npos && e + 1 < word.size() && word[e + 1] == '-';
}

}  // namespace

std::string in_quotes(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text(word.substr(0, longest));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return "'" + text + (word.size() > longest ? "...'" : "'");
}

Scanner::Scanner(std::string file, std::string_view text, char comment, bool by_line)
    : file_(std::move(file)), text_(text), comment_(comment), by_line_(by_line) {
  position_ = byte_order_mark_size(text_);
}

std::size_t Scanner::line() const { return 1 + std::count(text_.begin(), text_.begin() + last_, '\n'); }

void Scanner::fail(const std::string& problem, const std::string& remedy) const {
  throw InputError(file_, by_byte_ ? fmt::format("byte {}", last_) : fmt::format("line {}", line()), problem, remedy);
}

void Scanner::fail_missing(std::string_view what) {
  last_ = position_;
  fail(fmt::format("the {} ends where {} should be", position_ < text_.size() ? "line" : "file", what));
}

void Scanner::skip_blanks() {
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (c == comment_ && comment_) {
      position_ = std::min(text_.find('\n', position_), text_.size());
    } else if (is_blank(c) && !(by_line_ && c == '\n')) {
      ++position_;
    } else {
      return;
    }
  }
}

bool Scanner::has_word() {
  skip_blanks();
  return position_ < text_.size() && text_[position_] != '\n';
}

bool Scanner::next_line() {
  if (started_) rest_of_line();
  started_ = true;
  while (!has_word() && position_ < text_.size()) rest_of_line();
  last_ = position_;
  return position_ < text_.size();
}

void Scanner::expect_line(std::string_view what) {
  if (!next_line()) fail_missing(what);
}

void Scanner::expect_word(std::string_view what) {
  if (!has_word()) expect_line(what);
}

std::string_view Scanner::peek() {
  if (!has_word()) return {};
  std::size_t end = position_;
  while (end < text_.size() && !is_blank(text_[end])) ++end;
  return text_.substr(position_, end - position_);
}

std::string_view Scanner::word(std::string_view what) {
  const std::string_view found = peek();
  if (found.empty()) fail_missing(what);
  last_ = position_;
  position_ += found.size();
  return found;
}

double Scanner::any_number(std::string_view what) {
  const std::string_view found = word(what);
  const std::string_view digits = without_plus(found);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::invalid_argument || end != digits.data() + digits.size())
    fail(fmt::format("{} should be a number, is {}", what, in_quotes(found)));
  if (error != std::errc::result_out_of_range) return value;
  if (is_tiny(digits)) return 0;
  return digits.starts_with('-') ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
}

double Scanner::number(std::string_view what) {
  const double value = any_number(what);
  if (!std::isfinite(value))
    fail(fmt::format("{} is not finite: {}", what, in_quotes(text_.substr(last_, position_ - last_))));
  return value;
}

Vec3 Scanner::point(std::string_view what) {
  const double x = number(what), y = number(what), z = number(what);
  return {x, y, z};
}

long long Scanner::integer(std::string_view what, long long low, long long high) {
  const std::string_view found = word(what);
  const std::string_view digits = without_plus(found);
  long long value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::invalid_argument || end != digits.data() + digits.size())
    fail(fmt::format("{} should be an integer, is {}", what, in_quotes(found)));
  if (error != std::errc() || value < low || value > high)
    fail(fmt::format("{} is {}", what, in_quotes(found)), fmt::format("{} to {}", low, high));
  return value;
}

long long Scanner::wide_integer(std::string_view what) {
  return integer(what, std::numeric_limits<long long>::min(), std::numeric_limits<long long>::max());
}

std::size_t Scanner::count(std::string_view what, std::size_t values) {
  const auto value = static_cast<std::size_t>(integer(what, 0));
  // A value takes at least a digit and a blank; the last one may end the file.
  if (value > (left() + 1) / (2 * values))
    fail(fmt::format("{} is {}, more than the {} bytes left in the file can hold", what, value, left()));
  return value;
}

void Scanner::end_line(std::string_view of) {
  if (has_word()) fail(fmt::format("the line goes on after {} with {}", of, in_quotes(word(of))));
}

std::string_view Scanner::rest_of_line() {
  last_ = position_;
  const std::size_t end = std::min(text_.find('\n', position_), text_.size());
  const std::string_view line = text_.substr(position_, end - position_);
  position_ = std::min(end + 1, text_.size());
  return line;
}

std::string_view Scanner::bytes(std::size_t n) {
  if (n > left()) fail(fmt::format("{} bytes of data should follow, the file holds {} more", n, left()));
  last_ = position_;
  position_ += n;
  return text_.substr(last_, n);
}

Scanner Scanner::until(char stop) {
  Scanner part = *this;
  position_ = last_ = std::min(text_.find(stop, position_), text_.size());
  part.text_ = text_.substr(0, position_);
  return part;
}

bool Scanner::skip_past(std::string_view mark) {
  const std::size_t at = text_.find(mark, position_);
  if (at == std::string_view::npos) return false;
  position_ = last_ = at + mark.size();
  return true;
}

}  // namespace heml
