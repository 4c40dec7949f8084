#pragma once
// Whether a replay proves that a recording plays as it was recorded. It has to have reached every checkpoint and the
// end, and the recording has to be whole: what somebody dropped or moved is noticed too.
#include <heml/scenario/replay.hpp>
#include <heml/scenario/scene.hpp>
#include <string>

namespace heml {

struct Verification {
  bool passed = false;
  std::string reason;   ///< why it did not pass, one sentence; else empty
  std::string warning;  ///< what it rests on though it passed; may be empty
};

/// played: replay(recording, ...). partial: the recording was cut short by a crash and need not have its end.
Verification verify(const Scene& recording, const ReplayResult& played, bool partial = false);

}  // namespace heml
