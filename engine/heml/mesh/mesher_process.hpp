#pragma once
// Runs assimp and TetGen in a helper process (heml-mesher), since they may crash or not terminate.
#include <heml/base/error.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace heml {

/// The helper cannot do what was asked, for a reason of the surface; limits are another matter.
struct MesherFailure : InputError {
  using InputError::InputError;
};

struct ProcessLimits {
  double cpu_seconds = 120;  ///< CPU time, rounded up to whole seconds
  double seconds = 120;      ///< wall time, for a helper that waits
  double bytes = 4e9;        ///< memory
};

/// One run of the helper, with the texts for error messages.
struct HelperTask {
  std::string subject;                 ///< file or surface
  std::string doing;                   ///< "filling it"
  std::vector<std::string> arguments;  ///< of heml-mesher
  ProcessLimits limits;
  std::string remedy;  ///< when a limit is exceeded
};

/// Runs `heml-mesher` with `input` on stdin until it ends, and returns its answer. Both are anonymous memory files, and
/// the kernel kills the helper when the calling thread ends, so nothing is left behind however this program ends.
/// Throws InputError about the subject if this build has no helper or the helper exceeds a limit, MesherFailure if it
/// fails or crashes.
/// One call at a time, since kill_helper() tracks only one helper.
std::string run_mesher(const HelperTask& task, std::string_view input = {});

/// Kills the running helper, if any, and reaps it. Async-signal-safe, for handlers of signals that end the program.
/// Without this call the helper ends too, but may stay as a zombie process.
void kill_helper();

}  // namespace heml
