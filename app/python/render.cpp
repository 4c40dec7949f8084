// heml.render()
#include <fmt/format.h>

#include <algorithm>
#include <app/panel/frame_drawing.hpp>
#include <app/python/arrays.hpp>
#include <app/python/bindings.hpp>
#include <app/python/json_objects.hpp>
#include <heml/base/error.hpp>
#include <heml/scenario/view_json.hpp>
#include <mutex>

namespace heml::python {

namespace nb = nanobind;
using namespace nb::literals;

namespace {

constexpr int min_size = 16, max_size = 8192;  // pixels, as of `heml capture`

std::mutex drawing_mutex;  // one drawing exists at a time

render::Image draw(LiveWorld& live, const Scene& scene, render::Size size) {
  const std::scoped_lock lock(drawing_mutex);
  panel::FrameDrawing drawing(scene, live.world(), size, false, false);
  return drawing.draw(live.world(), 0, 0);
}

render::Size size_from(nb::handle given) {
  const Json json = json_from(given, "", "size");
  const JsonCursor size(json, "size");
  if (size.size() != 2) size.refuse("must be (width, height)");
  return {static_cast<int>(size[0].integer(min_size, max_size)), static_cast<int>(size[1].integer(min_size, max_size))};
}

nb::object render_world(LiveWorld& live, nb::object given_size, const nb::kwargs& view) {
  const LiveWorld::Use use(live);
  const render::Size size = size_from(given_size);
  Scene scene = live.scene();
  Json keys = view_json(scene.view);
  const Json asked = json_from(view, "view");
  if (asked.contains("side"))  // stands for both
    for (const char* angle : {"azimuth", "elevation"}) keys.erase(angle);
  keys.update(asked);
  scene.view = view_from(JsonCursor(keys, "view"));
  render::Image image;
  {
    const nb::gil_scoped_release others_run;
    image = draw(live, scene, size);
  }
  const Shape shape{size.height, size.width, 3};
  nb::object array = make_array(shape, ElementType::uint8);
  const ArrayMemory memory(array, "", shape, ArrayMemory::Access::write, ElementType::uint8);
  std::copy(image.pixels.begin(), image.pixels.end(), memory.data<std::uint8_t>());
  return array;
}

}  // namespace

void bind_render(nb::module_& module) {
  module.def("render", &render_world, "world"_a, "size"_a = nb::make_tuple(1280, 720), "view"_a,
             "A picture of a world as `heml capture` draws it, without a display: (height, width, 3) uint8, sRGB, rows "
             "from the top. view: keys of a scene's `view` (azimuth and elevation in degrees, or side: 'front', "
             "'back', 'left', 'right', 'top' or 'bottom'; zoom, orthographic, field, wireframe), in place of the scene's "
             "own. Needs libOSMesa.");
}

}  // namespace heml::python
