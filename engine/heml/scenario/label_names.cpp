#include <fmt/format.h>

#include <charconv>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/mesh/labels/label_map.hpp>
#include <heml/scenario/json_text.hpp>
#include <heml/scenario/label_names.hpp>
#include <heml/scenario/text_file.hpp>
#include <optional>

namespace heml {
namespace {

namespace fs = std::filesystem;

std::optional<int> label_in(std::string_view text) {
  int label = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), label);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return label;
}

void add_names_of_json(const fs::path& path, std::map<int, std::string>& names) {
  const Json document = parse_json(read_text_file(path), path.string());
  if (!document.is_object()) return;
  const Json& list = document.contains("labels") ? document["labels"] : document;
  if (!list.is_object()) return;
  for (const auto& [key, value] : list.items()) {
    const std::optional<int> label = label_in(key);
    if (label && value.is_string())
      names[*label] = value.get<std::string>();
    else if (value.is_number_integer())
      names[value.get<int>()] = key;
  }
}

/// Lines of a label, its colour and visibility, and its name in quotes; # begins a comment.
void add_names_of_itksnap(const fs::path& path, std::map<int, std::string>& names) {
  const std::string text = read_text_file(path);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = std::string_view(text).substr(at, end - at);
    at = end + 1;
    const std::size_t first = line.find_first_not_of(" \t"), open = line.find('"'), close = line.rfind('"');
    if (first == std::string_view::npos || open == std::string_view::npos || close <= open) continue;
    const std::size_t digits = line.find_first_of(" \t", first);
    if (const std::optional<int> label = label_in(line.substr(first, digits - first)))
      names[*label] = std::string(line.substr(open + 1, close - open - 1));
  }
}

}  // namespace

std::map<int, std::string> label_names(const fs::path& label_map) {
  std::map<int, std::string> names = label_names_in_header(label_map);
  fs::path stem = label_map;
  if (lower_case(stem.extension().string()) == ".gz") stem.replace_extension();
  for (const char* ending : {".json", ".txt", ".label"}) {
    const fs::path beside = fs::path(stem).replace_extension(ending);
    std::error_code error;
    if (!fs::is_regular_file(beside, error)) continue;
    try {
      if (std::string_view(ending) == ".json")
        add_names_of_json(beside, names);
      else
        add_names_of_itksnap(beside, names);
    } catch (const InputError& problem) {
      warn("{}: names of labels were not read: {}", label_map.string(), problem.what());
    }
    break;
  }
  return names;
}

}  // namespace heml
