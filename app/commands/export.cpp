#include <fmt/format.h>

#include <app/commands/commands.hpp>
#include <app/commands/progress.hpp>
#include <app/render/palette.hpp>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/scenario/frame_series.hpp>
#include <heml/scenario/input_files.hpp>
#include <heml/scenario/replay.hpp>
#include <heml/scenario/write_glb.hpp>
#include <heml/scenario/write_usda.hpp>

namespace heml {
namespace {

/// Whether all frames go into one file, by its name and the format.
bool is_single_file(const ExportArguments& arguments) {
  const std::string ending = arguments.out.extension().string();
  const bool named = ending == ".glb" || ending == ".usda";
  const bool wanted = arguments.format == "glb" || arguments.format == "usda";
  if (wanted && ending != "." + arguments.format)
    throw UsageError(
        fmt::format("--out {}: end the name of the file in .{}", arguments.out.string(), arguments.format));
  if (named && !wanted && !arguments.format.empty())
    throw UsageError(
        fmt::format("--format {}: --out {} is a {} file", arguments.format, arguments.out.string(), ending));
  return named;
}

/// Plays the scene and calls `add` for the state at the beginning and the first one at or after each frame's time:
/// computed states with their own times, not interpolated. Returns an exit code. add: returns the frames so far.
template <class Add>
int play(const ExportArguments& arguments, const Scene& scene, World& world, Add add) {
  const double total = static_cast<double>(std::max(1l, ticks_to_play(scene)));
  ReplayResult result;
  int taken = 0;
  {
    Progress progress("exporting");
    taken = add(world);
    result = replay(scene, world, [&](World& w) {
      if (w.elapsed() * arguments.fps >= taken * (1 - 1e-12)) taken = add(w);
      progress.show(static_cast<double>(w.ticks()) / total);
    });
  }
  if (!result.halt) return exit_done;
  log_line("error", fmt::format("{}: {}; {} frames are in {}", arguments.scene, result.halt->message, taken,
                                arguments.out.string()));
  return exit_not_solved;
}

int export_file(const ExportArguments& arguments, const Scene& scene) {
  check_output_file(input_files(scene), arguments.out);
  const auto world = load_world(scene);
  const bool is_usda = arguments.out.extension() == ".usda";
  Animation animation(arguments.out.string(), is_usda ? Animation::Extent::body : Animation::Extent::surface);
  const int code = play(arguments, scene, *world, [&](World& w) {
    animation.add_frame(w);
    return animation.taken();
  });
  if (is_usda)
    write_usda(arguments.out, animation, arguments.fps, render::tissue_tint);
  else
    write_glb(arguments.out, animation, {render::tissue_tint, world->setup().mesh.region_names});
  if (code == exit_done) fmt::print("{} frames in {}\n", animation.taken(), arguments.out.string());
  return code;
}

int export_folder(const ExportArguments& arguments, const Scene& scene) {
  const std::string format = arguments.format.empty() ? "vtu" : arguments.format;
  std::vector<std::filesystem::path> outputs = frames_in(arguments.out, "." + format);
  if (format == "vtu") outputs.push_back(arguments.out / "frames.pvd");
  check_output_folder(input_files(scene), arguments.out, outputs);
  const auto world = load_world(scene);
  FrameSeries series(arguments.out, format);
  const int code = play(arguments, scene, *world, [&](World& w) {
    series.add_frame(w);
    return series.taken();
  });
  if (code == exit_done) fmt::print("{} frames in {}\n", series.taken(), arguments.out.string());
  return code;
}

}  // namespace

int export_frames(const ExportArguments& arguments) {
  const bool single = is_single_file(arguments);
  const Scene scene = read_scene(arguments.scene);
  return single ? export_file(arguments, scene) : export_folder(arguments, scene);
}

}  // namespace heml
