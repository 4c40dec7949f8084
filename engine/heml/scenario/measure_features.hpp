#pragma once
// Measures the cost and effect of each feature of a scene: runs a short part of the scene unchanged and with one
// feature changed at a time, in turns, and takes the shortest times.
#include <functional>
#include <heml/scenario/scene.hpp>
#include <string>
#include <vector>

namespace heml {

/// Result of a run with one feature changed.
struct MeasuredChange {
  std::string feature;      ///< "as it is" first, then continuation, element, precision, ...
  std::string from, to;     ///< scene keywords: "double", "float"
  double milliseconds = 0;  ///< per tick (static scene: in all), minimum over the turns
  double steps = 0;         ///< per tick
  double error = 0;         ///< m, rms distance of the nodes from those of the unchanged scene, at the end
  std::string halted = {};  ///< why it ended early; empty: it did not
};

struct Measurement {
  double stretch = 0;     ///< s of simulated time; of a static scene, the fraction of the load
  double max_motion = 0;  ///< m, largest displacement of a node in the unchanged scene: the scale of errors
  int turns = 0;
  std::vector<MeasuredChange> changes;
};

/// Takes some seconds. setup: load_setup(scene). progress: called with the fraction done, 0 to 1. Throws InputError
/// when a world refuses an event.
Measurement measure_features(const Scene& scene, WorldSetup setup, const std::function<void(double)>& progress = {});

}  // namespace heml
