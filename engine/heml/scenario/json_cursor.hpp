#pragma once
// A place in a JSON document, with what a reader of documents needs: checked access, and errors that name the place.
//
//   Key scene(document, "soft.json");
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

/// The name closest to a misspelt one (edit distance; the first of equals). `names` must not be empty.
std::string_view nearest_name(std::string_view wrong, std::span<const std::string_view> names);

/// Refers to the document and does not own it. Everything throws InputError with file, key path and the value seen.
class JsonCursor {
 public:
  /// The whole document. where: what stands before every key path ("line 12"), or nothing.
  JsonCursor(const Json& document, std::string file, std::string where = "");

  /// Says that the value is an object and holds no other key than these.
  void allow(std::span<const std::string_view> names) const;
  void allow(std::initializer_list<std::string_view> names) const { allow(std::span(names.begin(), names.size())); }

  bool has(std::string_view name) const;
  JsonCursor operator[](std::string_view name) const;           ///< missing: error
  std::optional<JsonCursor> find(std::string_view name) const;  ///< missing: empty
  std::size_t size() const;                                     ///< of an array; anything else: error
  JsonCursor operator[](std::size_t index) const;               ///< entry of an array, below size()
  /// The one key of these that is there.
  std::string only_one_of(std::initializer_list<std::string_view> names) const;

  /// Calls visit(Key) for every entry of an array.
  template <class Visit>
  void each(const Visit& visit) const {
    for (std::size_t i = 0; i < size(); ++i) visit((*this)[i]);
  }

  double number() const;
  double positive() const;
  double non_negative() const;
  double between(double low, double high) const;  ///< closed
  long integer(long low, long high) const;        ///< closed
  bool flag() const;
  std::string text() const;
  Vec3 vector() const;                                                ///< [x, y, z]
  Vec3 direction() const;                                             ///< [x, y, z], normalised; zero: error
  std::uint64_t hash() const;                                         ///< 16 hexadecimal digits
  std::size_t one_of(std::span<const std::string_view> names) const;  ///< index of the name the value is

  const Json& json() const { return *value_; }
  const std::string& file() const { return file_; }
  std::string place() const;  ///< "line 12: solver.step"

  /// problem: with the value seen. remedy: what would be right.
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const;
  /// fail() with the value seen as the problem.
  [[noreturn]] void refuse(const std::string& remedy) const;

 private:
  JsonCursor child(const Json& value, std::string path) const;
  std::string member_path(std::string_view name) const;
  void expect(bool right_type, const char* type) const;

  const Json* value_;
  std::string file_, where_, path_;
};

}  // namespace heml
