#pragma once
// The interactive window: a session on the engine thread, drawn when something changed, with the panel.
#include <app/render/image.hpp>
#include <filesystem>
#include <heml/scenario/scene.hpp>
#include <optional>
#include <string>
#include <vector>

namespace heml {

struct WindowOptions {
  std::optional<std::filesystem::path> record;  ///< file for a recording of the session
  std::vector<std::string> comparisons;         ///< variants to run in lockstep (heml/session/variant.hpp)
  std::vector<std::string> warnings;            ///< of reading the scene, for people
  std::optional<render::Size> size;             ///< pixels; none: as the window was left, at first 1280×720
  double exit_after = 0;                        ///< s of wall time until the window closes by itself; 0: never
  double draw_stall = 0;                        ///< ms added to every drawing, to test that the engine is not delayed
  bool log_pictures = false;                    ///< prints Viewer::status() on stderr after each drawing
};

/// Shows the scene until the window is closed, then prints one line of statistics on stdout. Returns nothing, or the
/// reason if no window can be opened (no display, no OpenGL 3.3). Call on the program's main thread. Throws InputError
/// as Session does, and at the end if the recording could not be completed.
std::optional<std::string> run_window(const Scene& scene, const WindowOptions& options);

}  // namespace heml
