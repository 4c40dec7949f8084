#pragma once
// Scalars as colours: which map, over which range, under which name.
#include <array>
#include <heml/session/frame.hpp>
#include <span>
#include <string>

namespace heml::render {

/// Values shown by the two ends of a colour map, in the field's unit.
struct Range {
  float low = 0, high = 1;
  bool operator==(const Range&) const = default;
};

/// sRGB, 0..1, at a place 0..1 of a field's map: viridis, or for stretch and J a diverging one that is neutral at 0.5.
Vec3f map_colour(Field field, float place);

/// The range a field asks for: from 0 to the greatest value; for stretch and J symmetric about 1. Never empty; values
/// that are not finite are left out.
Range natural_range(Field field, std::span<const float> values);

/// The range that is shown: fixed, or following natural_range() without flicker.
class ColourRange {
 public:
  void fix(Range range) { fixed_ = range; }  ///< from now on this one
  void follow() { fixed_.reset(); }          ///< from now on what the values ask for

  /// Takes a frame's values; seconds: since the last call. The first values of a field are followed at once; later a
  /// wider range within about 0.1 s and a narrower one within about 1 s.
  Range update(Field field, std::span<const float> values, float seconds);

 private:
  std::optional<Range> fixed_;
  Range shown_;
  Field field_ = Field::none;
};

/// How a field is written: title, the unit for a range, and what to multiply values with to have them in that unit.
struct FieldLabel {
  std::string title, unit;
  float scale = 1;
};
FieldLabel field_label(Field field, const Range& range);

/// Round numbers within a range, ascending, 3 to 7 of them, as multiples of 1, 2 or 5 times a power of ten.
std::vector<float> ticks(const Range& range);

}  // namespace heml::render
