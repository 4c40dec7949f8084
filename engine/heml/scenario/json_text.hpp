#pragma once
// Parses and writes JSON text: a duplicate key is an error, errors name their place, and numbers have 17 significant
// digits, so that doubles survive bit for bit.
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace heml {

/// Keeps the order of keys, for readability.
using Json = nlohmann::ordered_json;

/// Throws InputError naming file, line and column (syntax) or key path (duplicate key, nesting too deep).
/// first_line: number of the text's first line in its file, for JSON Lines.
Json parse_json(std::string_view text, const std::string& file, long first_line = 1);

/// One line, or indented by two spaces. Numbers that are not finite become null. Throws InputError naming `file` when a
/// string is not UTF-8.
std::string json_text(const Json& value, const std::string& file, bool indented = false);

/// A value or a name as error messages show it: one line, shortened.
std::string shown(const Json& value);
std::string shown(std::string_view text);

}  // namespace heml
