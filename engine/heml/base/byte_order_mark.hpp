#pragma once
// The byte order mark of UTF-8, which spreadsheets and some editors write before a text.
#include <cstddef>
#include <string_view>

namespace heml {

/// Size in bytes of the mark that the text begins with; 0 where there is none.
inline std::size_t byte_order_mark_size(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? mark.size() : 0;
}

}  // namespace heml
