#pragma once
// Values in the text of XML elements: words and numbers between commas and blanks.
#include <heml/mesh/xml.hpp>
#include <string_view>
#include <vector>

namespace heml {

/// The parts between commas (then blanks within them count) or, where there is none, between blanks.
std::vector<std::string_view> words_in(std::string_view text);

/// A whole number of 32 bits. Throws InputError at the element; what: for messages.
int integer_in(const XmlElement& element, std::string_view word, std::string_view what);

/// A finite number.
double number_in(const XmlElement& element, std::string_view word, std::string_view what);

/// All numbers of an element's text; count: how many there have to be, 0: any.
std::vector<double> numbers_in(const XmlElement& element, std::string_view what, std::size_t count = 0);
std::vector<int> integers_in(const XmlElement& element, std::string_view what, std::size_t count = 0);

}  // namespace heml
