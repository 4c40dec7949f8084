#pragma once
// How loads and prescribed motions grow in time.

namespace heml {

/// Grows linearly from 0 at `start` to 1 in `duration`, s; 1 at all times if duration is 0.
struct Ramp {
  double start = 0, duration = 0;

  bool is_growing(double time) const { return duration > 0 && time - start < duration; }
  double operator()(double time) const {
    if (!is_growing(time)) return 1;
    return time > start ? (time - start) / duration : 0;
  }
};

}  // namespace heml
