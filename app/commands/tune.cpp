// `heml tune`: finds the best method for a scene by measuring it.
#include <fmt/format.h>

#include <app/commands/commands.hpp>
#include <app/commands/progress.hpp>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/base/write_file.hpp>
#include <heml/scenario/input_files.hpp>
#include <studies/quantity_text.hpp>
#include <studies/tune.hpp>

namespace heml {
namespace {

TuneGoal goal_of(const TuneArguments& arguments) {
  if (arguments.within.empty() == arguments.error.empty())
    throw UsageError("tune: give one of --within TIME (16ms) and --error LENGTH (1mm)");
  if (!arguments.within.empty()) return {seconds_from(arguments.within, "--within"), std::nullopt};
  return {std::nullopt, metres_from(arguments.error, "--error")};
}

std::filesystem::path out_of(const TuneArguments& arguments, const Scene& scene) {
  if (!arguments.out.empty()) return arguments.out;
  const auto stem = std::filesystem::path(scene.file).stem().string();
  return (stem.empty() ? std::string("scene") : stem) + "_tuned.json";
}

Tuning measure(const Scene& scene, bool quick) {
  Progress progress("tuning");
  return measure_for_tuning(scene, quick,
                            [&](double fraction, const std::string& doing) { progress.show(fraction, doing); });
}

}  // namespace

int tune_scene(const TuneArguments& arguments) {
  const TuneGoal goal = goal_of(arguments);
  const Scene scene = read_scene(arguments.scene);
  const auto out = out_of(arguments, scene);
  check_output_file(input_files(scene), out);
  const Tuning tuning = measure(scene, arguments.quick);
  const auto best = best_for(goal, tuning);
  if (!best) {
    log_line("error", fmt::format("{}: {}", scene.file, nothing_reaches(goal, tuning)));
    return exit_check_failed;
  }
  write_file(out, scene_text(tuned_scene(tuning, *best), std::filesystem::absolute(out).parent_path()));
  for (const std::string& sentence : tuning_text(goal, tuning, *best)) fmt::print("{}\n", sentence);
  fmt::print("tuned scene: {}\n", out.string());
  return exit_done;
}

}  // namespace heml
