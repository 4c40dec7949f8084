#pragma once
// Colour maps of scalar fields: map, range and label.
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

/// sRGB, 0..1, at position 0..1 of a field's map: viridis, or for fields about 0 or 1 a diverging map that
/// is neutral at 0.5.
Vec3f map_colour(Field field, float place);

/// The range of a field's values: from 0 to the maximum, or symmetric about 0 or 1 (FieldScale). Never empty. Ignores
/// values that are not finite.
Range natural_range(Field field, std::span<const float> values);

/// The displayed range: fixed, or natural_range() smoothed over time against flicker.
class ColourRange {
 public:
  void fix(Range range) { fixed_ = range; }  ///< update() returns this range
  void follow() { fixed_.reset(); }          ///< update() follows natural_range()

  /// The range for a frame's values; seconds: since the last call. A new field sets the range at once; later it widens
  /// with a time constant of 0.1 s and narrows with one of 1 s.
  Range update(Field field, std::span<const float> values, float seconds);

 private:
  std::optional<Range> fixed_;
  Range shown_;
  Field field_ = Field::none;
};

/// The label of a field: title, a unit that suits the range, and the factor from the field's unit to that unit.
struct FieldLabel {
  std::string title, unit;
  float scale = 1;
};
FieldLabel field_label(Field field, const Range& range);

/// Tick marks: 3 to 7 ascending multiples of 1, 2 or 5 times a power of ten within a range.
std::vector<float> ticks(const Range& range);

}  // namespace heml::render
