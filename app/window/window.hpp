#pragma once
// The interactive window: a body in its engine thread, drawn when something changed, and a panel beside it.
#include <app/render/image.hpp>
#include <filesystem>
#include <heml/scenario/scene.hpp>
#include <optional>
#include <string>
#include <vector>

namespace heml {

struct WindowOptions {
  std::optional<std::filesystem::path> record;  ///< JSON Lines recording of what is done in the window
  std::vector<std::string> comparisons;         ///< other ways to compute the body (heml/session/variant.hpp)
  render::Size size{1280, 720};                 ///< pixels
  double exit_after = 0;                        ///< s of wall time until the window closes by itself; 0: never
  double draw_stall = 0;                        ///< ms every drawing is held up by; the engine must not notice
  bool log_pictures = false;                    ///< a line on stderr for each: Viewer::status()
};

/// Shows the scene until the window is closed, then prints one line of statistics on stdout. Returns nothing then, and
/// why there is no window when there can be none (no display, no OpenGL 3.3). The calling thread must be the program's
/// first. Throws InputError as Session does, and at the end where the recording could not be written to its own.
std::optional<std::string> run_window(const Scene& scene, const WindowOptions& options);

}  // namespace heml
