#include <fmt/format.h>
#include <fmt/ranges.h>

#include <app/commands/commands.hpp>
#include <app/commands/frame_capture.hpp>
#include <app/commands/progress.hpp>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/scenario/input_files.hpp>
#include <heml/scenario/verify.hpp>

namespace heml {
namespace {
constexpr long ticks_between_checkpoints = 100;  // of the recording written

void check_outputs(const ReplayArguments& arguments, const Scene& scene) {
  const std::vector<std::filesystem::path> inputs = input_files(scene);
  if (arguments.record) check_output_file(inputs, *arguments.record, "--record");
  if (arguments.frames)
    check_output_folder(inputs, *arguments.frames, frames_in(*arguments.frames, ".png"), "--frames");
}

/// Throws UsageError for instructions that this processor does not have.
InstructionSet instructions_named(const std::string& name) {
  std::vector<std::string_view> names;
  for (const InstructionSet isa : instruction_sets()) {
    names.push_back(name_of(isa));
    if (name == names.back()) return isa;
  }
  throw UsageError(fmt::format("--instructions: {}: this processor has {}", name, fmt::join(names, ", ")));
}

int exit_code_of(const Verification& verification, const ReplayResult& result, const Scene& scene) {
  if (!verification.passed) {
    log_line("error", fmt::format("{}: {}", scene.file, verification.reason));
    return exit_check_failed;
  }
  if (!verification.warning.empty()) warn("{}: {}", scene.file, verification.warning);
  if (result.halt) fmt::print("stopped at step {}, as recorded: {}\n", result.ticks, result.halt->message);
  return exit_done;
}

/// Without --verify: a difference is only warned of.
int exit_code_of(const ReplayResult& result, const Scene& scene) {
  if (result.difference) warn("{}: {}", scene.file, to_text(*result.difference));
  if (!result.halt) return exit_done;
  log_line("error", fmt::format("{}: {}", scene.file, result.halt->message));
  return exit_not_solved;
}
}  // namespace

int replay_recording(const ReplayArguments& arguments) {
  Scene scene = read_scene(arguments.recording);
  if (arguments.threads > 0) scene.solver.threads = arguments.threads;
  if (!arguments.instructions.empty()) scene.recorded_instructions = instructions_named(arguments.instructions);
  check_outputs(arguments, scene);
  const auto world = load_world(scene);
  std::optional<FrameCapture> frame_capture;
  if (arguments.frames) frame_capture.emplace(scene, *world, arguments.size, false, false, *arguments.frames);

  std::optional<Recorder> recorder;
  if (arguments.record) recorder.emplace(*arguments.record, scene, *world, ticks_between_checkpoints);

  const double total = static_cast<double>(std::max(1l, ticks_to_play(scene)));
  ReplayResult result;
  {
    Progress progress("replaying");
    if (frame_capture) frame_capture->capture(*world, 0, 1 / arguments.fps);
    result = replay(
        scene, *world,
        [&](World& w) {
          if (frame_capture && w.elapsed() * arguments.fps >= frame_capture->taken())
            frame_capture->capture(w, 0, 1 / arguments.fps);
          progress.show(static_cast<double>(w.ticks()) / total);
        },
        recorder ? &*recorder : nullptr);
  }
  fmt::print("{} ticks replayed, {} of {} checkpoints compared, final state {:016x}\n", result.ticks,
             result.checkpoints, told_checkpoints(scene), world->state_hash());
  return arguments.verify ? exit_code_of(verify(scene, result, arguments.partial), result, scene)
                          : exit_code_of(result, scene);
}

}  // namespace heml
