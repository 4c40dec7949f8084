#include <app/panel/search.hpp>
#include <cctype>
#include <sstream>

namespace heml::panel {
namespace {

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

bool has_words(const std::string& text, const std::string& words) {
  const std::string lower = lower_case(text);
  std::istringstream each(lower_case(words));
  for (std::string word; each >> word;)
    if (lower.find(word) == std::string::npos) return false;
  return true;
}

}  // namespace heml::panel
