#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/scenario/json_text.hpp>

namespace heml {
namespace {

constexpr std::size_t max_text = 64'000'000;
constexpr std::size_t deepest = 32;     // no scene nests deeper than 5
constexpr std::size_t max_keys = 1000;  // looking up a key is linear in their number
constexpr std::size_t max_shown = 80;   // characters of a value quoted in a message

/// nlohmann's message without exception name, line and column, which our message has already.
std::string syntax_problem(std::string text) {
  if (const auto end = text.find("] "); end != std::string::npos) text.erase(0, end + 2);
  if (text.starts_with("parse error at")) text.erase(0, text.find(": ") + 2);
  return shown(std::string_view(text).substr(0, 2 * max_shown));
}

/// Receives the parser's events and builds the value.
class Builder {
 public:
  Builder(std::string_view text, const std::string& file, long first_line)
      : text_(text), file_(file), first_line_(first_line) {}

  bool null() { return add(nullptr); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(std::int64_t value) { return add(value); }
  bool number_unsigned(std::uint64_t value) { return add(value); }
  bool number_float(double value, const std::string&) { return add(value); }
  bool string(std::string& value) { return add(std::move(value)); }
  bool binary(Json::binary_t&) { return false; }  // not in text
  bool start_object(std::size_t) { return open(Json::object()); }
  bool start_array(std::size_t) { return open(Json::array()); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool key(std::string& name) {
    Frame& frame = stack_.back();
    frame.key = std::move(name);
    if (frame.value.contains(frame.key)) fail("stands twice in one object", "keep one of them");
    if (frame.value.size() >= max_keys) fail("too many keys in one object", fmt::format("at most {}", max_keys));
    return true;
  }

  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& error) {
    const std::string_view before = text_.substr(0, position > 0 ? position - 1 : 0);
    const long line = first_line_ + std::count(before.begin(), before.end(), '\n');
    const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 == 0
    throw InputError(file_, fmt::format("line {}, column {}", line, before.size() - line_start + 1),
                     "not valid JSON: " + syntax_problem(error.what()));
  }

  Json take() { return std::move(result_); }

 private:
  struct Frame {
    Json value;
    std::string key;  ///< of objects: the one being read
  };

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    std::string place;
    for (const Frame& frame : stack_) {
      if (frame.value.is_array())
        place += fmt::format("[{}]", frame.value.size());
      else
        place += fmt::format("{}{}", place.empty() ? "" : ".", shown(std::string_view(frame.key)));
    }
    if (first_line_ > 1) place = fmt::format("line {}: {}", first_line_, place);
    throw InputError(file_, place, problem, remedy);
  }

  bool open(Json container) {
    if (stack_.size() >= deepest) fail("nested too deeply", fmt::format("at most {} levels", deepest));
    stack_.push_back({std::move(container), {}});
    return true;
  }

  bool close() {
    Json value = std::move(stack_.back().value);
    stack_.pop_back();
    return add(std::move(value));
  }

  bool add(Json value) {
    if (stack_.empty())
      result_ = std::move(value);
    else if (Frame& frame = stack_.back(); frame.value.is_array())
      frame.value.push_back(std::move(value));
    else
      frame.value.emplace(frame.key, std::move(value));
    return true;
  }

  std::string_view text_;
  const std::string& file_;
  long first_line_;
  std::vector<Frame> stack_;
  Json result_;
};

std::string number_text(double value) {
  if (!std::isfinite(value)) return "null";
  std::string text = fmt::format("{:.17g}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";  // an integer -0 would lose its sign
  return text;
}

bool is_container(const Json& value) { return value.is_structured(); }

void write(const Json& value, int indent, std::string& out) {
  const auto new_line = [&](int depth) {
    if (depth >= 0) out += '\n' + std::string(2 * static_cast<std::size_t>(depth), ' ');
  };
  const bool flat = indent < 0 || !value.is_structured() || value.empty() ||
                    (value.is_array() && std::none_of(value.begin(), value.end(), is_container));
  const int inner = flat ? -1 : indent + 1;
  if (value.is_number_float()) {
    out += number_text(value.get<double>());
  } else if (value.is_structured()) {
    out += value.is_object() ? '{' : '[';
    bool first = true;
    for (const auto& item : value.items()) {
      if (!first) out += flat ? ", " : ",";
      first = false;
      if (!flat) new_line(inner);
      if (value.is_object()) out += Json(item.key()).dump() + ": ";
      write(item.value(), inner, out);
    }
    if (!flat) new_line(indent);
    out += value.is_object() ? '}' : ']';
  } else {
    out += value.dump();
  }
}

}  // namespace

Json parse_json(std::string_view text, const std::string& file, long first_line) {
  if (text.size() > max_text)
    throw InputError(file, fmt::format("line {}", first_line), fmt::format("is {} bytes of JSON", text.size()),
                     fmt::format("at most {} bytes", max_text));
  Builder builder(text, file, first_line);
  Json::sax_parse(text, &builder);
  return builder.take();
}

std::string json_text(const Json& value, const std::string& file, bool indented) {
  std::string text;
  try {
    write(value, indented ? 0 : -1, text);
  } catch (const Json::type_error&) {
    throw InputError(file, "", "a name or path in it is not UTF-8 and cannot be written as JSON",
                     "rename the file or folder");
  }
  return text;
}

std::string shown(std::string_view text) {
  std::string result(text.substr(0, 2 * max_shown));
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return text.size() > result.size() ? result + "..." : result;
}

std::string shown(const Json& value) {
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() <= max_shown) return text;
  return text.substr(0, max_shown) + "...";
}

}  // namespace heml
