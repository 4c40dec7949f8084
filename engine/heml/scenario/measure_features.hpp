#pragma once
// What each feature of a scene costs and brings, measured: the scene runs for a short stretch as it is and with one
// thing changed at a time, in turns, and the shortest times count.
#include <functional>
#include <heml/scenario/scene.hpp>
#include <string>
#include <vector>

namespace heml {

/// A scene with one thing changed, beside the scene as it is.
struct MeasuredChange {
  std::string feature;      ///< "as it is" first, then continuation, element, precision, ...
  std::string from, to;     ///< scene words: "double", "float"
  double milliseconds = 0;  ///< a tick (of a static scene: of the whole stretch), the least of all turns
  double steps = 0;         ///< a tick
  double error = 0;         ///< m, rms distance of the nodes from where they are in the scene as it is, at the end
  std::string halted = {};  ///< why it ended early; empty: it did not
};

struct Measurement {
  double stretch = 0;     ///< s of simulated time; of a static scene, the fraction of the load
  double max_motion = 0;  ///< m, of a node of the scene as it is: what errors are to be held against
  int turns = 0;
  std::vector<MeasuredChange> changes;
};

/// Takes some seconds. setup: load_setup(scene). progress: called with the fraction done. Throws InputError when a
/// world refuses an event.
Measurement measure_features(const Scene& scene, WorldSetup setup, const std::function<void(double)>& progress = {});

}  // namespace heml
