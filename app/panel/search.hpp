#pragma once
// What a search field finds.
#include <string>

namespace heml::panel {

/// Whether a text has all words of another one, as parts, in any case (ASCII). True of no words.
bool has_words(const std::string& text, const std::string& words);

}  // namespace heml::panel
