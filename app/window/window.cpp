#include <fmt/format.h>

#include <algorithm>
#include <app/window/state_folder.hpp>
#include <app/window/viewer.hpp>
#include <app/window/window.hpp>
#include <chrono>
#include <heml/base/error.hpp>

namespace heml {
namespace {

using Clock = std::chrono::steady_clock;
double seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

/// When the next image may be drawn: at most 60 per second, and after a pause. Software rendering takes a core, which
/// the engine's threads get back in the pause; longer pauses gave the engine a few percent for half the images.
class DrawingPace {
 public:
  bool due(Clock::time_point now) const { return now >= next_; }
  double until_due(Clock::time_point now) const { return std::max(0.0, seconds(next_ - now)); }
  void drew(Clock::time_point began, Clock::time_point ended) {
    const double taken = (1 + rest) * seconds(ended - began);
    next_ =
        began + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(std::max(shortest, taken)));
  }

  static constexpr double shortest = 1.0 / 60;  ///< s

 private:
  static constexpr double rest = 1.0 / 16;  // of the drawing time
  Clock::time_point next_{};
};

void show(window::GlfwWindow& window, window::Viewer& viewer, const WindowOptions& options) {
  constexpr double max_sleep = 1;  // s
  const auto began = Clock::now();
  DrawingPace pace;
  while (!viewer.quits()) {
    if (window.closed()) {
      window.stay_open();
      viewer.ask_to_quit();
      continue;
    }
    const bool has_devices = viewer.read_devices();
    const auto now = Clock::now();
    const double left = options.exit_after > 0 ? options.exit_after - seconds(now - began) : max_sleep;
    if (left <= 0) return;
    if (!viewer.wants_drawing() || !pace.due(now)) {
      const double sleep = has_devices ? DrawingPace::shortest : max_sleep;
      window.wait(std::min({left, sleep, viewer.wants_drawing() ? pace.until_due(now) : max_sleep}));
      viewer.apply_input();
      continue;
    }
    window.wait(0);
    viewer.apply_input();
    viewer.draw();
    pace.drew(now, Clock::now());
    if (options.log_pictures) fmt::print(stderr, "{}\n", viewer.status());
  }
}

}  // namespace

std::optional<std::string> run_window(const Scene& scene, const WindowOptions& options) {
  try {
    // A size that was asked for is taken as it is; one that is remembered may be of a larger screen.
    window::GlfwWindow window("heml", options.size.value_or(window::read_preferences().window), !options.size);
    window::Viewer viewer(window, scene, options);
    show(window, viewer, options);
    const Frame& last = viewer.newest();
    fmt::print("{} frames drawn, {} ticks, {} missed deadlines, {:.3g} wall seconds per simulated second\n",
               viewer.drawn(), last.tick, last.pace.missed, last.pace.slowdown);
    if (const std::string problem = viewer.recording_problem(); !problem.empty())
      throw InputError("", "the recording ended early", problem);
    return std::nullopt;
  } catch (const window::NoDisplay& reason) {
    return reason.what();
  }
}

}  // namespace heml
