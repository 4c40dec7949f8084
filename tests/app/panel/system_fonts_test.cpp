#include <app/panel/system_fonts.hpp>

#include "driver.hpp"

namespace heml::system_fonts_test {

using namespace heml::test;

TEST_CASE("no letters need no fonts") { CHECK(panel::fonts_with({}).empty()); }

TEST_CASE("letters of other scripts are drawn where the system has a font for them") {
  const unsigned letter = 0x05d0;   // Hebrew alef
  const ImWchar cyrillic = 0x0416;  // the panel's own typeface has it
  panel::need_letters("Ж.obj א");
  CHECK(panel::has_new_letters());
  ImguiContext context(640, 360, 1);
  CHECK_FALSE(panel::has_new_letters());
  const ImFont& text = *panel::font(panel::Font::text);
  CHECK(text.FindGlyphNoFallback(cyrillic));
  CHECK(text.FindGlyphNoFallback('A'));
  if (!panel::fonts_with({letter}).empty()) CHECK(text.FindGlyphNoFallback(static_cast<ImWchar>(letter)));
  panel::need_letters("Ж again");
  CHECK_FALSE(panel::has_new_letters());
}

}  // namespace heml::system_fonts_test
