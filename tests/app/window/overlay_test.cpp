#include <app/panel/theme.hpp>
#include <app/window/overlay.hpp>

#include "app/panel/driver.hpp"
#include "sheet.hpp"

namespace heml::overlay_test {

using namespace heml::test;
using render::SectionPlane;

namespace {

/// Vertices that something adds to the marks over the image.
template <class Draw>
int vertices(const Draw& draw) {
  ImGui::NewFrame();
  const int before = ImGui::GetBackgroundDrawList()->VtxBuffer.Size;
  draw();
  const int added = ImGui::GetBackgroundDrawList()->VtxBuffer.Size - before;
  ImGui::Render();
  return added;
}

}  // namespace

TEST_CASE("marks on the half that a section plane takes away are left out") {
  const ImguiContext context(640, 360, 1);
  const Sheet sheet;
  const window::Section half = SectionPlane{Vec3f::UnitX(), 0}, all = SectionPlane{Vec3f::UnitX(), -1};
  const auto nodes = [&](const window::Section& section) {
    return vertices([&] {
      window::draw_nodes(sheet.surface_mesh.nodes, sheet.frame, sheet.surface_mesh, section, sheet.controller);
    });
  };
  CHECK(nodes(std::nullopt) > 0);
  CHECK(2 * nodes(half) == nodes(std::nullopt));
  CHECK(nodes(all) == 0);

  panel::Measured measured;
  measured.places = {{-0.05f, 0, 0}, {0.05f, 0, 0}};
  measured.distance = 0.1;
  const auto points = [&](const window::Section& section) {
    return vertices([&] { window::draw_measured(measured, section, sheet.controller); });
  };
  CHECK(points(half) < points(std::nullopt));
  CHECK(points(half) > 0);
  CHECK(points(all) == 0);

  const auto suture = [&](int node, const window::Section& section) {
    return vertices([&] { window::draw_suture_end(node, sheet.frame, sheet.surface_mesh, section, sheet.controller); });
  };
  CHECK(suture(20, half) > 0);
  CHECK(suture(21, half) == 0);
}

}  // namespace heml::overlay_test
