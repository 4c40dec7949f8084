#pragma once
// Times that can be compared: works are run in turn, round after round, so that whatever else the machine does meets
// all of them; a sample is as many runs as a clock can tell, its figure the time of one.
//
//   round 1: A A A A | B | C C      (runs of one sample: 1 ms or more together)
//   round 2: A A A A | B | C C  …   until the time is over
#include <functional>
#include <vector>

namespace heml {

struct Timing {
  double median = 0, min = 0, max = 0;  ///< s of one run
  double spread = 0;                    ///< (upper − lower quartile) / median
  int samples = 0;
};

struct TimingLimits {
  double seconds = 1;                    ///< of all works together, warm-up apart
  int min_rounds = 5, max_rounds = 200;  ///< rounds, whatever the time
  double min_sample = 1e-3;              ///< s
};

/// Of samples (s, one at least) that were taken otherwise.
Timing summary(std::vector<double> samples);

/// What each of the works takes. Reads the clock: for measurements only.
std::vector<Timing> time_interleaved(const std::vector<std::function<void()>>& works, const TimingLimits& limits);

}  // namespace heml
