#include <doctest/doctest.h>

#include <app/panel/theme.hpp>
#include <cmath>

#include "driver.hpp"

namespace heml::theme_test {

using namespace heml::panel;

namespace {

/// Relative luminance of an opaque colour (WCAG 2.2).
double luminance(ImU32 colour) {
  const auto part = [&](int shift) {
    const double c = static_cast<double>(colour >> shift & 0xff) / 255;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * part(0) + 0.7152 * part(8) + 0.0722 * part(16);
}

/// Of WCAG 2.2: 4.5 for texts, 3 for large ones and for signs.
double contrast(ImU32 a, ImU32 b) {
  const double brighter = std::max(luminance(a), luminance(b)), darker = std::min(luminance(a), luminance(b));
  return (brighter + 0.05) / (darker + 0.05);
}

}  // namespace

TEST_CASE("texts and signs can be read in both themes") {
  const test::ImguiContext context(640, 360, 1);
  for (const Theme theme : {Theme::dark, Theme::light}) {
    CAPTURE(static_cast<int>(theme));
    apply_theme(1, theme);
    for (const ImU32 ground : {colours::background, colours::popup, colours::track, colours::track_hovered,
                               colours::control_hovered, colours::row_hovered, colours::chart})
      CHECK(contrast(colours::text, ground) > 7);
    CHECK(contrast(colours::text, colours::fill) > 4.5);
    CHECK(contrast(colours::muted, colours::background) > 4.5);
    for (const ImU32 sign : {colours::accent, colours::warning, colours::danger, colours::kinetic, colours::potential})
      for (const ImU32 ground : {colours::background, colours::chart}) CHECK(contrast(sign, ground) > 4.5);
    for (const ImU32 handle : {colours::handle, colours::handle_pressed}) CHECK(contrast(handle, colours::track) > 2.5);
  }
  apply_theme(1);
}

}  // namespace heml::theme_test
