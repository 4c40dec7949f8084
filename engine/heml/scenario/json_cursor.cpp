#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <heml/base/error.hpp>
#include <heml/scenario/json_cursor.hpp>
#include <limits>
#include <numeric>
#include <vector>

namespace heml {
namespace {

std::string seen(const Json& value) { return "is " + shown(value); }

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

std::string_view nearest_name(std::string_view wrong, std::span<const std::string_view> names) {
  wrong = wrong.substr(0, 100);
  return *std::min_element(names.begin(), names.end(), [&](std::string_view a, std::string_view b) {
    return edit_distance(wrong, a) < edit_distance(wrong, b);
  });
}

JsonCursor::JsonCursor(const Json& document, std::string file, std::string where)
    : value_(&document), file_(std::move(file)), where_(std::move(where)) {}

JsonCursor JsonCursor::child(const Json& value, std::string path) const {
  JsonCursor key(value, file_, where_);
  key.path_ = std::move(path);
  return key;
}

std::string JsonCursor::member_path(std::string_view name) const {
  return fmt::format("{}{}{}", path_, path_.empty() ? "" : ".", name);
}

std::string JsonCursor::place() const {
  return where_.empty() || path_.empty() ? where_ + path_ : where_ + ": " + path_;
}

void JsonCursor::fail(const std::string& problem, const std::string& remedy) const {
  throw InputError(file_, place(), problem, remedy);
}

void JsonCursor::refuse(const std::string& remedy) const { fail(seen(*value_), remedy); }

void JsonCursor::expect(bool right_type, const char* type) const {
  if (!right_type) refuse(fmt::format("must be {}", type));
}

void JsonCursor::allow(std::span<const std::string_view> names) const {
  expect(value_->is_object(), "an object { ... }");
  for (const auto& [name, value] : value_->items()) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    const std::string remedy =
        fmt::format("did you mean '{}'? Keys here: {}", nearest_name(name, names), fmt::join(names, ", "));
    child(value, member_path(shown(std::string_view(name)))).fail("unknown key", remedy);
  }
}

bool JsonCursor::has(std::string_view name) const { return value_->is_object() && value_->contains(name); }

std::optional<JsonCursor> JsonCursor::find(std::string_view name) const {
  if (!has(name)) return std::nullopt;
  return child((*value_)[std::string(name)], member_path(name));
}

JsonCursor JsonCursor::operator[](std::string_view name) const {
  expect(value_->is_object(), "an object { ... }");
  if (const auto key = find(name)) return *key;
  fail(fmt::format("'{}' is missing", name), fmt::format("add \"{}\": ...", name));
}

std::size_t JsonCursor::size() const {
  expect(value_->is_array(), "a list [ ... ]");
  return value_->size();
}

JsonCursor JsonCursor::operator[](std::size_t index) const {
  return child(value_->at(index), fmt::format("{}[{}]", path_, index));
}

std::string JsonCursor::only_one_of(std::span<const std::string_view> names) const {
  std::vector<std::string_view> present;
  std::copy_if(names.begin(), names.end(), std::back_inserter(present), [&](auto name) { return has(name); });
  if (present.size() == 1) return std::string(present.front());
  const std::string problem = present.empty() ? "holds none" : fmt::format("holds {}", fmt::join(present, " and "));
  fail(problem, fmt::format("give exactly one of {}", fmt::join(names, ", ")));
}

double JsonCursor::number() const {
  expect(value_->is_number(), "a number");
  return value_->get<double>();
}

double JsonCursor::positive() const {
  const double value = number();
  if (!(value > 0)) refuse("must be greater than 0");
  return value;
}

double JsonCursor::non_negative() const {
  const double value = number();
  if (!(value >= 0)) refuse("must be 0 or greater");
  return value;
}

double JsonCursor::between(double low, double high) const {
  const double value = number();
  if (!(value >= low && value <= high)) refuse(fmt::format("must be from {} to {}", low, high));
  return value;
}

long JsonCursor::integer(long low, long high) const {
  constexpr long most = std::numeric_limits<long>::max();
  const bool above_long = value_->is_number_unsigned() && value_->get<std::uint64_t>() > most;
  if (!value_->is_number_integer() || above_long || value_->get<long>() < low || value_->get<long>() > high)
    refuse(fmt::format("must be a whole number from {} to {}", low, high));
  return value_->get<long>();
}

bool JsonCursor::flag() const {
  expect(value_->is_boolean(), "true or false");
  return value_->get<bool>();
}

std::string JsonCursor::text() const {
  expect(value_->is_string(), "a text in quotes");
  return value_->get<std::string>();
}

Vec3 JsonCursor::vector() const {
  expect(value_->is_array() && value_->size() == 3, "three numbers [x, y, z]");
  const JsonCursor& keys = *this;
  return Vec3(keys[0].number(), keys[1].number(), keys[2].number());
}

Vec3 JsonCursor::direction() const {
  const Vec3 value = vector();
  const double length = value.stableNorm();
  if (!(length > 0) || !std::isfinite(length)) refuse("must be a direction: not all of its numbers 0, none enormous");
  // A unit vector is not normalised again, so that a written direction reads back bit for bit.
  const bool unit = std::abs(value.squaredNorm() - 1) < 8 * std::numeric_limits<double>::epsilon();
  return unit ? value : Vec3(value / length);
}

std::uint64_t JsonCursor::hash() const {
  const std::string digits = text();
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (digits.size() != 16 || error != std::errc() || end != digits.data() + digits.size())
    refuse("must be 16 hexadecimal digits");
  return value;
}

std::size_t JsonCursor::one_of(std::span<const std::string_view> names) const {
  const std::string value = text();
  const auto found = std::find(names.begin(), names.end(), value);
  if (found == names.end())
    refuse(fmt::format("did you mean '{}'? Must be one of {}", nearest_name(value, names), fmt::join(names, ", ")));
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace heml
