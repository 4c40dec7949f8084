#pragma once
// Decides whether a replay verifies a recording: every checkpoint and the end must have been reproduced, and the
// recording must be complete, without dropped or moved lines.
#include <heml/scenario/replay.hpp>
#include <heml/scenario/scene.hpp>
#include <string>

namespace heml {

struct Verification {
  bool passed = false;
  std::string reason;   ///< why it did not pass, one sentence; empty if it passed
  std::string warning;  ///< limits of a verification that passed; may be empty
};

/// played: replay(recording, …). partial: the recording was cut short by a crash and need not have its end.
Verification verify(const Scene& recording, const ReplayResult& played, bool partial = false);

/// How many checkpoints a recording tells of: by its end, or else those that it holds.
long told_checkpoints(const Scene& recording);

}  // namespace heml
