#pragma once
// Checked access to a value in a JSON document, with errors that name file and key path.
//
//   JsonCursor scene(document, "soft.json");
//   scene.allow({"mesh", "solver"});                             // else: 'solvr': did you mean 'solver'?
//   scene["solver"]["step"].positive();                          // else: soft.json: solver.step: is -1 (must be ...)
#include <cstdint>
#include <heml/math/types.hpp>
#include <heml/scenario/json_text.hpp>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace heml {

/// Number of letters to insert, remove or replace between two names (Levenshtein 1966).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The entry of `names` with the least edit distance to a misspelt one; the first of equals. `names` must not be empty.
std::string_view nearest_name(std::string_view wrong, std::span<const std::string_view> names);

/// Refers to the document, which must outlive it. Every accessor throws InputError with file, key path and the value
/// found where that is missing, of another type or out of range.
class JsonCursor {
 public:
  /// Points to the whole document. where: prefix of key paths in messages ("line 12"), or empty.
  JsonCursor(const Json& document, std::string file, std::string where = "");

  /// Throws unless the value is an object with no other keys than these.
  void allow(std::span<const std::string_view> names) const;
  void allow(std::initializer_list<std::string_view> names) const { allow(std::span(names.begin(), names.size())); }

  bool has(std::string_view name) const;
  JsonCursor operator[](std::string_view name) const;           ///< throws if missing
  std::optional<JsonCursor> find(std::string_view name) const;  ///< empty if missing
  std::size_t size() const;                                     ///< of an array; throws for another type
  JsonCursor operator[](std::size_t index) const;               ///< entry of an array, index < size()
  /// The key of `names` that the object has; throws unless it is exactly one.
  std::string only_one_of(std::span<const std::string_view> names) const;
  std::string only_one_of(std::initializer_list<std::string_view> names) const {
    return only_one_of(std::span(names.begin(), names.size()));
  }

  /// Calls visit(JsonCursor) for every entry of an array.
  template <class Visit>
  void each(const Visit& visit) const {
    for (std::size_t i = 0; i < size(); ++i) visit((*this)[i]);
  }

  double number() const;
  double positive() const;
  double non_negative() const;
  double between(double low, double high) const;  ///< in [low, high]
  long integer(long low, long high) const;        ///< in [low, high]
  bool flag() const;
  std::string text() const;
  Vec3 vector() const;                                                ///< [x, y, z]
  Vec3 direction() const;                                             ///< [x, y, z], normalised; throws if zero
  std::uint64_t hash() const;                                         ///< 16 hexadecimal digits
  std::size_t one_of(std::span<const std::string_view> names) const;  ///< index of the value in `names`

  const Json& json() const { return *value_; }
  const std::string& file() const { return file_; }
  std::string place() const;  ///< "line 12: solver.step"

  /// Throws InputError. problem: with the value found. remedy: what would be accepted.
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;
  /// fail() with "is VALUE" as the problem.
  [[noreturn]] void refuse(const std::string& remedy) const;

 private:
  JsonCursor child(const Json& value, std::string path) const;
  std::string member_path(std::string_view name) const;
  void expect(bool right_type, const char* type) const;

  const Json* value_;
  std::string file_, where_, path_;
};

}  // namespace heml
