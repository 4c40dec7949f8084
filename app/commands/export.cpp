#include <fmt/format.h>

#include <app/commands/commands.hpp>
#include <app/commands/progress.hpp>
#include <heml/base/log.hpp>
#include <heml/scenario/frame_series.hpp>
#include <heml/scenario/input_files.hpp>
#include <heml/scenario/replay.hpp>

namespace heml {

int export_frames(const ExportArguments& arguments) {
  const Scene scene = read_scene(arguments.scene);
  std::vector<std::filesystem::path> outputs = frames_in(arguments.out, "." + arguments.format);
  if (arguments.format == "vtu") outputs.push_back(arguments.out / "frames.pvd");
  check_output_folder(input_files(scene), arguments.out, outputs);
  const auto world = load_world(scene);
  FrameSeries series(arguments.out, arguments.format);
  const double total = static_cast<double>(std::max(1l, ticks_to_play(scene)));
  ReplayResult result;
  {
    Progress progress("exporting");
    series.add_frame(*world);
    result = replay(scene, *world, [&](World& w) {
      // The first tick at or after each frame's time: a computed state with its own time, not interpolated.
      if (w.elapsed() * arguments.fps >= series.taken() * (1 - 1e-12)) series.add_frame(w);
      progress.show(static_cast<double>(w.ticks()) / total);
    });
  }
  if (result.halt) {
    log_line("error", fmt::format("{}: {}; {} frames are in {}", arguments.scene, result.halt->message, series.taken(),
                                  arguments.out.string()));
    return exit_not_solved;
  }
  fmt::print("{} frames in {}\n", series.taken(), arguments.out.string());
  return exit_done;
}

}  // namespace heml
