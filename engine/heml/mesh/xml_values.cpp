#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <heml/mesh/scanner.hpp>
#include <heml/mesh/xml_values.hpp>

namespace heml {
namespace {

constexpr std::string_view word_blanks = " \t\r\n";

std::string_view trimmed_word(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(word_blanks), text.size());
  return text.substr(begin, text.find_last_not_of(word_blanks) + 1 - begin);
}

template <class Value, class Read>
std::vector<Value> values_in(const XmlElement& element, std::string_view what, std::size_t count, Read read) {
  std::vector<Value> values;
  for (const std::string_view word : words_in(element.text())) values.push_back(read(element, word, what));
  if (count > 0 && values.size() != count)
    element.fail(fmt::format("{} should be {} numbers, {} are there", what, count, values.size()));
  return values;
}

}  // namespace

std::vector<std::string_view> words_in(std::string_view text) {
  std::vector<std::string_view> words;
  const std::string_view ends = text.find(',') == text.npos ? word_blanks : std::string_view(",");
  for (text = trimmed_word(text); !text.empty(); text = trimmed_word(text)) {
    const std::size_t end = std::min(text.find_first_of(ends), text.size());
    words.push_back(trimmed_word(text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

int integer_in(const XmlElement& element, std::string_view word, std::string_view what) {
  int value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || error != std::errc() || end != word.data() + word.size())
    element.fail(fmt::format("{} should be a whole number, is {}", what, in_quotes(word)));
  return value;
}

double number_in(const XmlElement& element, std::string_view word, std::string_view what) {
  const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
    element.fail(fmt::format("{} should be a number, is {}", what, in_quotes(word)));
  return value;
}

std::vector<double> numbers_in(const XmlElement& element, std::string_view what, std::size_t count) {
  return values_in<double>(element, what, count, number_in);
}

std::vector<int> integers_in(const XmlElement& element, std::string_view what, std::size_t count) {
  return values_in<int>(element, what, count, integer_in);
}

}  // namespace heml
