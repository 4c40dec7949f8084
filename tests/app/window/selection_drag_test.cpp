#include <doctest/doctest.h>

#include <app/window/selection_drag.hpp>

namespace heml::selection_drag_test {

using namespace heml::window;
using Drag = SelectionDrag::Drag;

namespace {

const render::Size size{640, 360};

/// Two sheets that face the camera at +z, as grids of 5 by 5 nodes, 100 to 124 and 125 to 149; the second is smaller,
/// and 0.1 m behind the other.
struct Sheets {
  SurfaceMesh surface_mesh;
  Frame frame;
  panel::CameraController controller;
  std::optional<render::SectionPlane> section;
  SelectionDrag drag;
  std::vector<int> inside;  // of the last drag

  Sheets() {
    for (int sheet = 0; sheet < 2; ++sheet) {
      const int first = 25 * sheet;
      for (int k = 0; k < 25; ++k) {
        surface_mesh.nodes.push_back(100 + first + k);
        const float side = sheet == 0 ? 0.05f : 0.045f;
        surface_mesh.rest.push_back({side * static_cast<float>(k % 5 - 2), side * static_cast<float>(k / 5 - 2),
                                     -0.1f * static_cast<float>(sheet)});
      }
      for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) {
          const int a = first + 5 * y + x;
          surface_mesh.triangles.push_back({a, a + 1, a + 6});
          surface_mesh.triangles.push_back({a, a + 6, a + 5});
        }
    }
    frame.positions = surface_mesh.rest;
    View view;
    view.azimuth = view.elevation = 0;
    view.orthographic = true;
    controller.fit(view, surface_mesh, size, {});
  }
  SelectionDrag::View view() const { return {frame, surface_mesh, controller, section}; }
  render::Vec2f pixel(float x, float y) const { return controller.pixel({x, y, 0}); }
  std::vector<int> along(const std::vector<render::Vec2f>& path, const SelectionDrag::Settings& settings) {
    drag.press(path.front(), settings, view());
    for (const render::Vec2f& at : path) drag.move(at, view());
    const SelectionDrag::Nodes nodes = drag.release(view());
    inside = nodes.inside;
    return nodes.surface;
  }
};

}  // namespace

TEST_CASE("a click selects the node under it, beside the body none") {
  Sheets sheets;
  CHECK(sheets.along({sheets.pixel(0.04f, 0.06f)}, {}) == std::vector{100 + 5 * 3 + 3});
  CHECK(sheets.along({{3, 3}}, {}).empty());
  CHECK_FALSE(sheets.drag.is_on());
}

TEST_CASE("a rectangle selects the nodes within it that are seen, or all") {
  Sheets sheets;
  const std::vector path{sheets.pixel(-0.02f, -0.02f), sheets.pixel(0.3f, 0.3f), sheets.pixel(0.12f, 0.07f)};
  const std::vector seen{112, 113, 114, 117, 118, 119};
  CHECK(sheets.along(path, {}) == seen);
  SelectionDrag::Settings through;
  through.through = true;
  std::vector<int> both = seen;
  for (const int node : seen) both.push_back(node + 25);
  CHECK(sheets.along(path, through) == both);
}

TEST_CASE("a lasso selects the nodes within the line drawn") {
  Sheets sheets;
  SelectionDrag::Settings lasso;
  lasso.drag = Drag::lasso;
  const std::vector path{sheets.pixel(-0.12f, -0.12f), sheets.pixel(0.06f, -0.12f), sheets.pixel(-0.12f, 0.06f)};
  CHECK(sheets.along(path, lasso) == std::vector{100, 101, 102, 105, 106, 110});
}

TEST_CASE("paint selects the nodes within the radius of where the mouse passes") {
  Sheets sheets;
  SelectionDrag::Settings paint;
  paint.drag = Drag::paint;
  paint.radius = 0.051;
  CHECK(sheets.along({sheets.pixel(-0.09f, -0.09f), sheets.pixel(0, -0.09f)}, paint) ==
        std::vector{100, 101, 102, 103, 105, 107});
  CHECK(sheets.drag.outline().empty());
}

TEST_CASE("nodes inside go with a drag through the body and with paint, not with what is seen") {
  Sheets sheets;
  Solid solid;  // nodes 0 to 99 lie nowhere, 100 to 149 on the sheets, 150 and 151 between them
  solid.rest.assign(100, Vec3f(0, 0, 0));
  solid.rest.insert(solid.rest.end(), sheets.surface_mesh.rest.begin(), sheets.surface_mesh.rest.end());
  solid.rest.insert(solid.rest.end(), {{0.05f, 0.05f, -0.03f}, {-0.05f, 0, -0.05f}});
  solid.tets = {{118, 101, 105, 150}, {100, 118, 105, 151}};
  sheets.frame.solid_positions = solid.rest;
  sheets.frame.solid_positions[151].x() = 0.03f;  // where it has moved to
  sheets.frame.solid = std::make_shared<const Solid>(std::move(solid));
  const std::vector path{sheets.pixel(0.02f, -0.02f), sheets.pixel(0.3f, 0.3f), sheets.pixel(0.07f, 0.07f)};
  CHECK_FALSE(sheets.along(path, {}).empty());
  CHECK(sheets.inside.empty());
  SelectionDrag::Settings settings;
  settings.through = true;
  sheets.along(path, settings);
  CHECK(sheets.inside == std::vector{150, 151});
  settings = {};
  settings.drag = Drag::paint;
  settings.radius = 0.04;
  sheets.along({sheets.pixel(0.05f, 0.05f)}, settings);
  CHECK(sheets.inside == std::vector{150});
}

TEST_CASE("a cancelled drag selects nothing and has no outline") {
  Sheets sheets;
  sheets.drag.press(sheets.pixel(0, 0), {}, sheets.view());
  sheets.drag.move(sheets.pixel(0.1f, 0.1f), sheets.view());
  CHECK(sheets.drag.outline().size() == 4);
  sheets.drag.cancel();
  CHECK_FALSE(sheets.drag.is_on());
  CHECK(sheets.drag.outline().empty());
}

}  // namespace heml::selection_drag_test
