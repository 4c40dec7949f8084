#include <doctest/doctest.h>

#include <app/panel/tool_section.hpp>

namespace heml::tool_section_test {

using namespace heml::panel;
using Kept = std::map<std::string, double>;

TEST_CASE("kept settings of tools suit a body of another size") {
  const Vec3 gravity(0, -9.81, 0);
  ToolSection kidney(0.06, gravity);
  CHECK(kidney.kept() == Kept{});
  kidney.keep({{"jaw length", 0.5}, {"jaw direction", 45}});
  CHECK(kidney.tool().jaw_length == doctest::Approx(0.03));
  CHECK(kidney.tool().radius == doctest::Approx(0.12 * 0.06));
  ToolSection liver(0.15, gravity);
  liver.keep(kidney.kept());
  CHECK(liver.tool().jaw_length == doctest::Approx(0.075));
  CHECK(liver.tool().jaw_direction == 45);
  CHECK(liver.kept() == Kept{{"jaw length", 0.5}, {"jaw direction", 45}});
}

TEST_CASE("kept settings that no tool can have become the first ones") {
  ToolSection tools(0.06, Vec3::Zero());
  tools.keep({{"jaw length", -1}, {"depth", 1e300}, {"teeth", 3}});
  CHECK(tools.kept() == Kept{});
}

}  // namespace heml::tool_section_test
