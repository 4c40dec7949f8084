// Processor time of a picture by Mesa's software renderer, 1280×720, of a body that holds still: as it is, with old
// shadows as the window draws, while the camera turns, and without ground. Milliseconds, median and minimum of 12
// interleaved samples of 12 pictures.
//
//   ninja -C build/release bench_drawing && LP_NUM_THREADS=1 build/release/tests/bench_drawing assets/scenes/uterus.json
#include <fmt/format.h>

#include <algorithm>
#include <app/panel/camera_controller.hpp>
#include <app/render/osmesa_context.hpp>
#include <app/render/renderer.hpp>
#include <array>
#include <ctime>
#include <heml/scenario/scene.hpp>
#include <heml/session/surface_mesh.hpp>
#include <heml/world/world.hpp>

using namespace heml;

namespace {

constexpr render::Size size{1280, 720};
constexpr int samples = 12, pictures = 12;

double processor_milliseconds() {
  timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return fmt::print(stderr, "usage: bench_drawing SCENE\n"), 2;
  const Scene scene = read_scene(words[1]);
  const auto world = make_world(load_setup(scene));
  for (int k = 0; k < 50; ++k) world->tick();
  const render::OsMesaContext context(size);
  render::Renderer renderer;
  const auto surface_mesh = make_surface_mesh(*world, nullptr, {});
  Frame frame;
  fill_frame(*world, surface_mesh, Field::none, 0, frame, false);
  panel::CameraController controller;
  controller.fit(scene.view, uncut_surface(*surface_mesh), size, {}, 1);

  enum Kind { all, every_other, turning, no_ground, kinds };
  constexpr std::array<const char*, kinds> titles{"as it is", "old shadows in every other picture", "the camera turns",
                                                  "without ground"};
  std::array<std::vector<double>, kinds> times;
  for (int sample = 0; sample <= samples; ++sample)
    for (int kind = 0; kind < kinds; ++kind) {
      render::Camera camera = controller.camera();
      render::DrawOptions options;
      options.ground = kind != no_ground;
      const double began = processor_milliseconds();
      for (int k = 0; k < pictures; ++k) {
        options.old_shadows = kind == every_other && k % 2 == 1;
        if (kind == turning) camera.orbit(0.01f, 0);
        renderer.draw(frame, camera, options, size);
        glFinish();
      }
      if (sample == 0) continue;  // compiles shaders
      times[kind].push_back((processor_milliseconds() - began) / pictures);
    }
  for (int kind = 0; kind < kinds; ++kind) {
    std::sort(times[kind].begin(), times[kind].end());
    fmt::print("{:36} {:6.1f} {:6.1f}\n", titles[kind], times[kind][samples / 2], times[kind].front());
  }
}
