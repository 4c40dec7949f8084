#pragma once
// Has a shadow (world/step_doubling.hpp) follow a session's world now and then, in a thread of its own that gives way
// to all others: what steps err by, for people to read. Nothing it finds comes back to the world.
//
//    world   ──────┬─────────┬──────────────────────┬─────────┬───────
//                  │ stretch │                      │ stretch │
//    shadow        copy      └─ goes through it ─►  copy      └─ …
#include <future>
#include <heml/world/step_doubling.hpp>

namespace heml {

class StepDoublingScheduler {
 public:
  static constexpr double stretch = 0.1;  ///< s of simulated time
  static constexpr double pause = 0.4;    ///< s, between two

  /// After a command was carried out: a stretch with another body in it tells nothing.
  void carried_out(const Command& command);
  /// After each tick.
  void ticked(const World& world);

  const std::optional<TimeError>& latest() const { return latest_; }

 private:
  enum class Doing { nothing, making, following, computing };
  void begin(const World& world);

  Doing doing_ = Doing::nothing;
  std::unique_ptr<StepDoublingEstimator> estimator_;  ///< none until the first is made
  bool outdated_ = false;                             ///< the body's setup has changed since it was
  double rested_at_ = -pause;                         ///< s of simulated time, end of the last stretch
  std::optional<TimeError> latest_;
  std::future<std::unique_ptr<StepDoublingEstimator>> making_;
  std::future<std::optional<TimeError>> computing_;  ///< last: they end before what they use
};

}  // namespace heml
