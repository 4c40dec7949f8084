#include "app/render/field_colours.hpp"

#include <algorithm>
#include <cmath>
#include <heml/world/field_list.hpp>
#include <limits>

namespace heml::render {
namespace {

/// The value in the middle of a diverging map; none: the map goes from 0 to the maximum.
std::optional<float> centre_of(Field field) {
  switch (info(field).scale) {
    case FieldScale::from_zero:
      return std::nullopt;
    case FieldScale::about_one:
      return 1.0f;
    case FieldScale::about_zero:
      return 0.0f;
  }
  return std::nullopt;
}

// Polynomial of degree 6 fitted to matplotlib's viridis by Matt Zucker (public domain); error below 0.01.
Vec3f viridis(float t) {
  const std::array<Vec3f, 7> c = {
      Vec3f(0.2777273f, 0.0054073f, 0.3340998f),   Vec3f(0.1050930f, 1.4046135f, 1.3845902f),
      Vec3f(-0.3308618f, 0.2148476f, 0.0950952f),  Vec3f(-4.6342305f, -5.7991010f, -19.3324410f),
      Vec3f(6.2282699f, 14.1799334f, 56.6905526f), Vec3f(4.7763850f, -13.7451454f, -65.3530326f),
      Vec3f(-5.4354559f, 4.6458526f, 26.3124352f)};
  Vec3f sum = c[6];
  for (int i = 5; i >= 0; --i) sum = c[i] + t * sum;
  return sum.cwiseMax(0.0f).cwiseMin(1.0f);
}

// Moreland, "Diverging color maps for scientific visualization", 2009: the cool-warm map at nine samples.
Vec3f cool_warm(float t) {
  const std::array<Vec3f, 9> c = {Vec3f(59, 76, 192),   Vec3f(98, 130, 234),  Vec3f(141, 176, 254),
                                  Vec3f(184, 208, 249), Vec3f(221, 221, 221), Vec3f(245, 196, 173),
                                  Vec3f(244, 154, 123), Vec3f(222, 96, 77),   Vec3f(180, 4, 38)};
  const float place = 8 * t;
  const int i = std::min(static_cast<int>(place), 7);
  return (c[i] + (place - static_cast<float>(i)) * (c[i + 1] - c[i])) / 255;
}

struct DisplayUnit {
  const char* name;
  float scale;  // from the field's unit
};

/// A unit that suits values up to `most`.
DisplayUnit display_unit(std::string_view unit, float most) {
  if (unit == "m") return {"mm", 1e3f};
  if (unit == "%") return {"%", 100};
  if (unit != "Pa") return {"", 1};
  if (most < 1e3f) return {"Pa", 1};
  return most < 1e6f ? DisplayUnit{"kPa", 1e-3f} : DisplayUnit{"MPa", 1e-6f};
}

}  // namespace

Vec3f map_colour(Field field, float place) {
  const float t = std::clamp(place, 0.0f, 1.0f);
  return centre_of(field) ? cool_warm(t) : viridis(t);
}

Range natural_range(Field field, std::span<const float> values) {
  const std::optional<float> middle = centre_of(field);
  const float centre = middle.value_or(0.0f);
  const float least = centre > 0 ? 1e-3f : 1e-9f;  // a minimum, for bodies at rest
  float reach = least;
  for (const float value : values)
    if (std::isfinite(value)) reach = std::max(reach, std::abs(value - centre));
  return middle ? Range{centre - reach, centre + reach} : Range{0, reach};
}

Range ColourRange::update(Field field, std::span<const float> values, float seconds) {
  if (fixed_) return *fixed_;
  const Range wanted = natural_range(field, values);
  if (field != field_) shown_ = wanted;
  field_ = field;
  const float settle = wanted.high > shown_.high ? 0.1f : 1.0f;  // s, time constant
  const float share = 1 - std::exp(-std::max(seconds, 0.0f) / settle);
  shown_.low += share * (wanted.low - shown_.low);
  shown_.high += share * (wanted.high - shown_.high);
  return shown_;
}

FieldLabel field_label(Field field, const Range& range) {
  if (field == Field::none) return {};
  const FieldInfo& row = info(field);
  const DisplayUnit unit = display_unit(row.unit, std::max(std::abs(range.low), std::abs(range.high)));
  return {std::string(row.label), unit.name, unit.scale};
}

std::vector<float> ticks(const Range& range) {
  const float span = range.high - range.low;
  if (!(span > 10 * std::numeric_limits<float>::min()) || !std::isfinite(span)) return {range.low};
  const float decade = std::pow(10.0f, std::floor(std::log10(span / 3)));
  float step = decade;
  for (const float factor : {2.0f, 5.0f, 10.0f})
    if (span / (factor * decade) >= 3) step = factor * decade;
  std::vector<float> result;
  const auto first = static_cast<int>(std::ceil(range.low / step - 1e-3f));
  const auto last = static_cast<int>(std::floor(range.high / step + 1e-3f));
  for (int i = first; i <= last; ++i) result.push_back(static_cast<float>(i) * step);
  return result;
}

}  // namespace heml::render
