#pragma once
// The keys of an object in a scene file as a table: what may stand there, in which unit, and what it means. Readers
// check keys and values by the table, and the reference page (`heml reference`) is printed from it: a key that is not
// described cannot be read, and a range on the page is the range that is checked.
//
//   constexpr KeyInfo budget_keys[] = {{"iterations", form::whole(1, 1000), "", "", "of a stage"}, ...};
//   const ObjectReader budget(key, budget_keys);       // refuses other keys
//   budget.read("iterations", result.iterations);      // refuses other values; leaves what is not given
#include <heml/scenario/json_cursor.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace heml {

/// What values a key takes.
struct ValueForm {
  enum class Kind { number, positive, non_negative, between, whole, flag, text, vector, direction, name, other };
  Kind kind = Kind::other;
  double low = 0, high = 0;                           ///< of between and whole, closed
  std::span<const std::string_view> (*names)() = {};  ///< of name
  std::string_view words = {};                        ///< of other: the form, for people
};

namespace form {
inline constexpr ValueForm number{ValueForm::Kind::number}, positive{ValueForm::Kind::positive},
    non_negative{ValueForm::Kind::non_negative}, flag{ValueForm::Kind::flag}, text{ValueForm::Kind::text},
    vector{ValueForm::Kind::vector}, direction{ValueForm::Kind::direction};
constexpr ValueForm between(double low, double high) { return {ValueForm::Kind::between, low, high}; }
constexpr ValueForm whole(double low, double high = std::numeric_limits<int>::max()) {
  return {ValueForm::Kind::whole, low, high};
}
/// names: the list of them, which outlives the program's readers.
constexpr ValueForm one_of(std::span<const std::string_view> (*names)()) {
  return {ValueForm::Kind::name, 0, 0, names};
}
template <const auto& names>
constexpr ValueForm one_of() {
  return one_of([] { return std::span<const std::string_view>(names); });
}
/// What the reader checks by itself.
constexpr ValueForm other(std::string_view words) { return {ValueForm::Kind::other, 0, 0, nullptr, words}; }
}  // namespace form

/// The form in words: "number > 0", "whole number, 1 to 1000".
std::string form_text(const ValueForm& form);

/// The value at a place, if it has the form. Throw InputError naming the key if it has not, and std::logic_error where
/// the form is of another type.
double number_of(const JsonCursor& key, const ValueForm& form);
long whole_of(const JsonCursor& key, const ValueForm& form);
std::size_t name_of(const JsonCursor& key, const ValueForm& form);  ///< its index
bool flag_of(const JsonCursor& key, const ValueForm& form);
std::string text_of(const JsonCursor& key, const ValueForm& form);
Vec3 vector_of(const JsonCursor& key, const ValueForm& form);

template <class Value>
Value value_of(const JsonCursor& key, const ValueForm& form) {
  if constexpr (std::is_same_v<Value, double>)
    return number_of(key, form);
  else if constexpr (std::is_same_v<Value, bool>)
    return flag_of(key, form);
  else if constexpr (std::is_same_v<Value, std::string>)
    return text_of(key, form);
  else if constexpr (std::is_same_v<Value, Vec3>)
    return vector_of(key, form);
  else if constexpr (std::is_enum_v<Value>)
    return static_cast<Value>(name_of(key, form));
  else
    return static_cast<Value>(whole_of(key, form));
}

/// One key of an object.
struct KeyInfo {
  std::string_view name;
  ValueForm form;
  std::string_view unit;     ///< SI; empty: none
  std::string_view usual;    ///< `required`, or what holds where it is not given; empty: what a written scene shows
  std::string_view meaning;  ///< one line, for people
};
inline constexpr std::string_view required = "required";

/// Whether every key of a table says what it means, and none is there twice.
constexpr bool is_complete(std::span<const KeyInfo> keys) {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i].name.empty() || keys[i].meaning.empty()) return false;
    if (keys[i].form.kind == ValueForm::Kind::other && keys[i].form.words.empty()) return false;
    for (std::size_t j = 0; j < i; ++j)
      if (keys[j].name == keys[i].name) return false;
  }
  return true;
}

std::vector<std::string_view> names_of(std::span<const KeyInfo> keys);

/// An object whose keys are those of a table. Its functions throw InputError naming the key, and std::logic_error where
/// the program asks for what the table does not have.
class ObjectReader {
 public:
  /// Refuses a value that is no object, and keys that are not in the table. The table outlives the reader.
  ObjectReader(const JsonCursor& key, std::span<const KeyInfo> keys);
  /// Of an object that takes some of them, and keys from elsewhere: refuses those that are not in `allowed`.
  ObjectReader(const JsonCursor& key, std::span<const KeyInfo> keys, std::span<const std::string_view> allowed);

  const JsonCursor& key() const { return key_; }
  JsonCursor operator[](std::string_view name) const;           ///< missing: error
  std::optional<JsonCursor> find(std::string_view name) const;  ///< missing: empty

  /// Reads a value of the key's form where it is given.
  template <class Value>
  void read(std::string_view name, Value& value) const {
    if (const auto given = find(name)) value = value_of<Value>(*given, row(name).form);
  }
  template <class Value>
  void read(std::string_view name, std::optional<Value>& value) const {
    if (const auto given = find(name)) value = value_of<Value>(*given, row(name).form);
  }
  /// The same of a key that must be given.
  template <class Value>
  Value get(std::string_view name) const {
    return value_of<Value>((*this)[name], row(name).form);
  }
  /// Index of the name that is given.
  std::optional<std::size_t> choice(std::string_view name) const;

 private:
  const KeyInfo& row(std::string_view name) const;

  JsonCursor key_;
  std::span<const KeyInfo> keys_;
};

}  // namespace heml
