#pragma once
// Comparable times: works run in turn, round after round, so that load by other programs affects all of them. A sample
// is as many runs as last min_sample; its value is the time of one run.
//
//   round 1: A A A A | B | C C      (runs of one sample: 1 ms or more together)
//   round 2: A A A A | B | C C  …   until the time is up
#include <functional>
#include <vector>

namespace heml {

struct Timing {
  double median = 0, min = 0, max = 0;  ///< s of one run
  double spread = 0;                    ///< (upper − lower quartile) / median
  int samples = 0;
};

struct TimingLimits {
  double seconds = 1;                    ///< of all works together, without warm-up
  int min_rounds = 5, max_rounds = 200;  ///< min_rounds are made even past `seconds`
  double min_sample = 1e-3;              ///< s
};

/// Statistics of given samples (s, at least one).
Timing summary(std::vector<double> samples);

/// Times of each work. Reads the wall clock: for measurements only.
std::vector<Timing> time_interleaved(const std::vector<std::function<void()>>& works, const TimingLimits& limits);

}  // namespace heml
