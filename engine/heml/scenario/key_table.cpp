#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <heml/scenario/key_table.hpp>
#include <stdexcept>
#include <vector>

namespace heml {
namespace {

using Kind = ValueForm::Kind;

void expect_suits(bool suits, const JsonCursor& key) {
  if (!suits) throw std::logic_error(fmt::format("{} is read as what its table does not say", key.place()));
}

}  // namespace

std::string form_text(const ValueForm& form) {
  switch (form.kind) {
    case Kind::number:
      return "number";
    case Kind::positive:
      return "number > 0";
    case Kind::non_negative:
      return "number ≥ 0";
    case Kind::between:
      return fmt::format("number, {} to {}", form.low, form.high);
    case Kind::whole:
      if (form.high < std::numeric_limits<int>::max())
        return fmt::format("whole number, {} to {}", form.low, form.high);
      return form.low < 0 ? "whole number" : fmt::format("whole number ≥ {}", form.low);
    case Kind::flag:
      return "`true` or `false`";
    case Kind::text:
      return "text";
    case Kind::vector:
      return "`[x, y, z]`";
    case Kind::direction:
      return "`[x, y, z]`, of any length > 0";
    case Kind::name:
      return fmt::format("`\"{}\"`", fmt::join(form.names(), "\"`, `\""));
    case Kind::other:
      return std::string(form.words);
  }
  throw std::logic_error("a form of no kind");
}

double number_of(const JsonCursor& key, const ValueForm& form) {
  if (form.kind == Kind::number) return key.number();
  if (form.kind == Kind::positive) return key.positive();
  if (form.kind == Kind::non_negative) return key.non_negative();
  expect_suits(form.kind == Kind::between, key);
  return key.between(form.low, form.high);
}

long whole_of(const JsonCursor& key, const ValueForm& form) {
  expect_suits(form.kind == Kind::whole, key);
  return key.integer(static_cast<long>(form.low), static_cast<long>(form.high));
}

std::size_t name_of(const JsonCursor& key, const ValueForm& form) {
  expect_suits(form.kind == Kind::name, key);
  return key.one_of(form.names());
}

bool flag_of(const JsonCursor& key, const ValueForm& form) {
  expect_suits(form.kind == Kind::flag, key);
  return key.flag();
}

std::string text_of(const JsonCursor& key, const ValueForm& form) {
  expect_suits(form.kind == Kind::text, key);
  return key.text();
}

Vec3 vector_of(const JsonCursor& key, const ValueForm& form) {
  expect_suits(form.kind == Kind::vector || form.kind == Kind::direction, key);
  return form.kind == Kind::vector ? key.vector() : key.direction();
}

std::vector<std::string_view> names_of(std::span<const KeyInfo> keys) {
  std::vector<std::string_view> names;
  for (const KeyInfo& info : keys) names.push_back(info.name);
  return names;
}

ObjectReader::ObjectReader(const JsonCursor& key, std::span<const KeyInfo> keys)
    : ObjectReader(key, keys, names_of(keys)) {}

ObjectReader::ObjectReader(const JsonCursor& key, std::span<const KeyInfo> keys,
                           std::span<const std::string_view> allowed)
    : key_(key), keys_(keys) {
  key.allow(allowed);
}

const KeyInfo& ObjectReader::row(std::string_view name) const {
  const auto found = std::find_if(keys_.begin(), keys_.end(), [&](const KeyInfo& info) { return info.name == name; });
  if (found == keys_.end()) throw std::logic_error(fmt::format("'{}' is in no table of keys", name));
  return *found;
}

JsonCursor ObjectReader::operator[](std::string_view name) const { return key_[row(name).name]; }

std::optional<JsonCursor> ObjectReader::find(std::string_view name) const { return key_.find(row(name).name); }

std::optional<std::size_t> ObjectReader::choice(std::string_view name) const {
  const auto given = find(name);
  return given ? std::optional(name_of(*given, row(name).form)) : std::nullopt;
}

}  // namespace heml
