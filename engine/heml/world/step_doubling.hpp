#pragma once
// What steps err by: now and then a stretch of a motion is gone through once more, from a copy of the state it began
// in, with two steps for each one. Where both end is apart by what the longer steps did wrong (Richardson).
//
//    leader   x₀ ──h───► ──h───► ──h───►  x_h      goes on, and never waits
//    shadow   x₀ ─h/2►─h/2► …           x_h/2      later, in another thread
//
//    error of x_h ≈ |x_h − x_h/2| 2^p / (2^p − 1),  p: the method's order
#include <heml/world/world.hpp>
#include <memory>
#include <optional>
#include <vector>

namespace heml {

/// Of the positions at the end of a stretch that began at the same state.
struct TimeError {
  double rms = 0, max = 0;  ///< m, over all nodes
  double interval = 0;      ///< s, the stretch
};

/// One thread at a time.
class StepDoublingEstimator {
 public:
  /// setup: the leader's, as it is now.
  explicit StepDoublingEstimator(WorldSetup setup);

  /// A stretch begins. Returns false where the leader cannot be followed (World::follow(), statics).
  bool begin(const World& leader);
  /// In it, before a tick: a tool is moved.
  void move(const MoveTool& command) { moves_.push_back(command); }
  /// After a tick of the leader.
  void ticked(const World& leader);
  /// s, since begin().
  double elapsed() const { return ticks_.empty() ? 0 : ticks_.back().end - begin_; }

  /// Goes through it again. reached: #V×3, m, where the leader is at its end. Nothing where the leader went another
  /// way: was brought back, or chose another method.
  std::optional<TimeError> error(const std::vector<Vec3>& reached);

 private:
  struct Tick {
    double end;  ///< s
    int steps;
    std::vector<MoveTool> moves;
  };

  std::unique_ptr<World> world_;
  Integrator integrator_ = Integrator::verlet;
  double begin_ = 0;  ///< s
  long recoveries_ = 0;
  bool lost_ = false;
  std::vector<Tick> ticks_;
  std::vector<MoveTool> moves_;  ///< of the coming tick
};

}  // namespace heml
