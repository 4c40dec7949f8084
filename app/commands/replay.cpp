#include <fmt/format.h>

#include <app/commands/commands.hpp>
#include <app/commands/photographer.hpp>
#include <app/commands/progress.hpp>
#include <heml/base/log.hpp>
#include <heml/scenario/replay.hpp>

namespace heml {
namespace {
constexpr long ticks_between_checkpoints = 100;  // of what is recorded
}

int replay_recording(const ReplayArguments& arguments) {
  Scene scene = read_scene(arguments.recording);
  if (arguments.threads > 0) scene.solver.threads = arguments.threads;
  const auto world = load_world(scene);
  std::optional<Photographer> photographer;
  if (arguments.frames) photographer.emplace(scene, *world, arguments.size, false, false, *arguments.frames);

  std::optional<Recorder> recorder;
  if (arguments.record) recorder.emplace(*arguments.record, scene, *world, ticks_between_checkpoints);

  const double total = static_cast<double>(std::max(1l, ticks_to_play(scene)));
  const double tick = world->setup().solver.tick();
  ReplayResult result;
  {
    Progress progress("replaying");
    if (photographer) photographer->take(*world, 0, 1 / arguments.fps);
    result = replay(
        scene, *world,
        [&](World& w) {
          const double time = static_cast<double>(w.ticks()) * tick;
          if (photographer && time * arguments.fps >= photographer->taken())
            photographer->take(w, 0, 1 / arguments.fps);
          progress.show(static_cast<double>(w.ticks()) / total);
        },
        recorder ? &*recorder : nullptr);
  }
  const std::string name = arguments.recording.string();
  if (result.halt) {
    log_line("error", fmt::format("{}: {}", name, result.halt->message));
    return exit_not_solved;
  }
  fmt::print("{} ticks replayed, {} checkpoints compared, final state {:016x}\n", result.ticks, result.checkpoints,
             world->state_hash());
  if (result.difference && scene.recorded_instructions && !plays_as_recorded(scene)) {
    log_line(
        arguments.verify ? "error" : "warning",
        fmt::format("{}: its states were recorded with {} kernels, which this processor does not have; others differ "
                    "by round-off, so they cannot be compared",
                    name, name_of(*scene.recorded_instructions)));
    if (arguments.verify) return exit_check_failed;
  } else if (result.difference) {
    log_line(arguments.verify ? "error" : "warning", fmt::format("{}: {}", name, to_text(*result.difference)));
    if (arguments.verify) return exit_check_failed;
  } else if (arguments.verify && result.checkpoints == 0) {
    log_line("error", fmt::format("{}: it holds no checkpoint, so nothing could be verified", name));
    return exit_check_failed;
  }
  return exit_done;
}

}  // namespace heml
