#include <fmt/format.h>

#include <app/commands/commands.hpp>
#include <app/commands/frame_capture.hpp>
#include <app/commands/progress.hpp>
#include <charconv>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/scenario/input_files.hpp>
#include <heml/scenario/schedule.hpp>
#include <heml/scenario/standard_view.hpp>
#include <heml/session/comparison_runs.hpp>

namespace heml {

ImageSize parse_size(const std::string& text) {
  ImageSize size{0, 0};
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  const bool cross = width.ec == std::errc() && width.ptr < end && *width.ptr == 'x';
  const auto height = cross ? std::from_chars(width.ptr + 1, end, size.height) : width;
  if (!cross || height.ec != std::errc() || height.ptr != end || size.width < 16 || size.height < 16 ||
      size.width > 8192 || size.height > 8192)
    throw UsageError(fmt::format("--size {}: write WIDTHxHEIGHT in pixels, 16 to 8192 each, e.g. 1280x720", text));
  return size;
}

namespace {

void set_view(View& view, const CaptureArguments& arguments) {
  for (std::size_t k = 0; k < standard_view_names.size(); ++k)
    if (standard_view_names[k] == arguments.side) {
      const ViewAngles angles = angles_of(static_cast<StandardView>(k));
      view.azimuth = angles.azimuth;
      view.elevation = angles.elevation;
    }
  view.orthographic = view.orthographic || arguments.orthographic;
}

}  // namespace

int capture(const CaptureArguments& arguments) {
  Scene scene = arguments.scene.empty() ? default_scene() : read_scene(arguments.scene);
  set_view(scene.view, arguments);
  check_output_folder(input_files(scene), arguments.out, frames_in(arguments.out, ".png"));
  const auto world = load_world(scene);
  Schedule schedule(scene, world->setup().mesh);
  std::optional<ComparisonRuns> comparison_runs;
  if (!arguments.comparisons.empty()) comparison_runs.emplace(world->setup(), arguments.comparisons);
  FrameCapture frame_capture(scene, *world, arguments.size, arguments.panel, comparison_runs.has_value(),
                             arguments.out);
  Progress progress("capturing frames");
  for (int k = 0; k < arguments.frames && !world->halt(); ++k) {
    // Whole ticks up to the frame's time, so that a capture has the states of a replay. The rest, less than a tick, is
    // extrapolated for the image alone.
    const double time = k / arguments.fps;
    const auto is_due = [&] { return world->elapsed() + world->setup().solver.tick() <= time * (1 + 1e-12); };
    while (!world->halt() && is_due()) {
      schedule.apply(*world, [&](const Command& command) {
        if (comparison_runs) comparison_runs->apply(command);
      });
      if (comparison_runs)
        comparison_runs->tick(*world);
      else
        world->tick();
    }
    frame_capture.capture(*world, world->halt() ? 0.0 : time - world->elapsed(),
                          1 / arguments.fps, comparison_runs ? &*comparison_runs : nullptr);
    progress.show((k + 1.0) / arguments.frames);
  }
  if (world->halt()) {
    log_line("error", fmt::format("{}: {}; {} of {} frames are in {}", scene.file, world->halt()->message,
                                  frame_capture.taken(), arguments.frames, arguments.out.string()));
    return exit_not_solved;
  }
  fmt::print("{} frames in {}\n", arguments.frames, arguments.out.string());
  return exit_done;
}

}  // namespace heml
