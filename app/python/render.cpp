// heml.render()
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <app/panel/frame_drawing.hpp>
#include <app/python/arrays.hpp>
#include <app/python/bindings.hpp>
#include <app/python/json_objects.hpp>
#include <atomic>
#include <heml/base/error.hpp>
#include <heml/scenario/view_json.hpp>
#include <mutex>
#include <utility>

namespace heml::python {

namespace nb = nanobind;
using namespace nb::literals;

namespace {

constexpr int min_size = 16, max_size = 8192;  // pixels, as of `heml capture`

// The drawing of the last picture, for the next one of its size: a new context compiles its shaders again, which takes
// longer than many pictures. Never freed: Mesa may be gone before the module is.
struct Easel {
  panel::FrameDrawing drawing;
  render::Size size;
  std::uint64_t world;
};
struct LayDown {  // so that any thread can draw the next one
  explicit LayDown(panel::FrameDrawing& laid_down) : drawing(laid_down) {}
  ~LayDown() { drawing.lay_down(); }
  LayDown(const LayDown&) = delete;
  LayDown& operator=(const LayDown&) = delete;

  panel::FrameDrawing& drawing;
};
std::mutex easel_mutex;  // one drawing exists at a time
Easel* easel = nullptr;
std::atomic<pid_t> draws_here{0};  // the process that has drawn

render::Image draw(LiveWorld& live, const Scene& scene, render::Size size) {
  pid_t none = 0;
  if (!draws_here.compare_exchange_strong(none, getpid()) && none != getpid())
    throw std::runtime_error(
        "this process was forked from one that has drawn, whose drawing threads it lacks: draw in a process that is "
        "spawned (multiprocessing.get_context('spawn')), or fork before the first picture");
  const std::scoped_lock lock(easel_mutex);
  if (easel && easel->size == size) {
    easel->drawing.take_up();
    easel->drawing.show(scene, live.world(), false, false, easel->world == live.number());
  } else {
    if (easel) easel->drawing.take_up();
    delete std::exchange(easel, nullptr);
    easel = new Easel{{scene, live.world(), size, false, false}, size, 0};
  }
  easel->world = live.number();
  const LayDown at_the_end(easel->drawing);
  return easel->drawing.draw(live.world(), 0, 0);
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
