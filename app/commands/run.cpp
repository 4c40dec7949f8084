#include <fmt/format.h>

#include <app/commands/commands.hpp>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/base/warning_collector.hpp>
#if HEML_WINDOW
#include <app/window/window.hpp>
#endif

namespace heml {

int run(const RunArguments& arguments) {
  std::string reason = "this build has no window";
#if HEML_WINDOW
  const WarningCollector warnings;
  const Scene scene = arguments.scene.empty() ? default_scene() : read_scene(arguments.scene);
  WindowOptions options;
  options.record = arguments.record;
  options.warnings = warnings.texts();
  options.comparisons = arguments.comparisons;
  if (arguments.size) options.size = {arguments.size->width, arguments.size->height};
  options.exit_after = arguments.exit_after;
  options.draw_stall = arguments.draw_stall;
  options.log_pictures = arguments.log_pictures;
  const auto outcome = run_window(scene, options);
  if (!outcome) return exit_done;
  reason = *outcome;
#endif
  if (arguments.record)
    throw UsageError(
        fmt::format("--record records what is done in a window, and there is none ({}); 'heml replay SCENE "
                    "--record FILE' records a scene as its events play it",
                    reason));
  CaptureArguments instead;
  instead.scene = arguments.scene;
  instead.comparisons = arguments.comparisons;
  if (arguments.size) instead.size = *arguments.size;
  log_info("no window ({}): capturing {} frames into ./{} instead", reason, instead.frames, instead.out.string());
  return capture(instead);
}

}  // namespace heml
