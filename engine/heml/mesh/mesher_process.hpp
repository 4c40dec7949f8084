#pragma once
// The helper process that runs assimp and TetGen, which may crash or never end.
#include <string>
#include <string_view>
#include <vector>

namespace heml {

struct ProcessLimits {
  double processor_seconds = 120;  ///< whole seconds are enforced
  double seconds = 120;            ///< of the clock: for a helper that waits
  double bytes = 4e9;              ///< of memory
};

/// One run of the helper, and the words for messages about it.
struct HelperTask {
  std::string subject;                 ///< the file or surface
  std::string doing;                   ///< "filling it"
  std::vector<std::string> arguments;  ///< of heml-mesher
  ProcessLimits limits;
  std::string remedy;  ///< against taking too long or too much memory
};

/// Runs `heml-mesher` with `input` to read, to its end, and returns its answer. Both pass through memory that has no
/// name, and the helper ends with the thread that called: nothing is left behind however this program ends. Throws
/// InputError about the subject when this build has no helper or the helper fails, crashes, or reaches a limit.
std::string run_mesher(const HelperTask& task, std::string_view input = {});

/// Ends the helper that runs, if one does, and waits for that. For handlers of signals that end the program: it calls
/// only what is safe there. Without it the helper ends too, but stays in the system's list until somebody asks for it.
void end_helper();

}  // namespace heml
