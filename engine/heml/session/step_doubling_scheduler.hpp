#pragma once
// Estimates the time error of a session's world now and then by step doubling (world/step_doubling.hpp), on a thread of
// low priority. The estimate is for display only and does not affect the world.
//
//    world       ──────┬─────────┬────────────────┬─────────┬───────
//                      │ stretch │                │ stretch │
//    estimator         copy      └─ repeats it ─► copy      └─ …
#include <future>
#include <heml/world/step_doubling.hpp>

namespace heml {

class StepDoublingScheduler {
 public:
  static constexpr double stretch = 0.1;  ///< s of simulated time, interval that is repeated
  static constexpr double pause = 0.4;    ///< s of simulated time, between two stretches

  /// Call after a command was carried out. Every command but MoveTool aborts the current stretch; one that changes the
  /// body's setup makes a new estimator necessary.
  void carried_out(const Command& command);
  /// Call after each tick.
  void ticked(const World& world);

  const std::optional<TimeError>& latest() const { return latest_; }

 private:
  enum class Doing { nothing, making, following, computing };
  void begin(const World& world);

  Doing doing_ = Doing::nothing;
  std::unique_ptr<StepDoublingEstimator> estimator_;  ///< null until the first is made
  bool outdated_ = false;                             ///< the body's setup has changed since estimator_ was made
  std::vector<Burn> burns_;                           ///< of the body that estimator_ was made of
  double rested_at_ = -pause;                         ///< s of simulated time, end of the last stretch
  std::optional<TimeError> latest_;
  std::future<std::unique_ptr<StepDoublingEstimator>> making_;
  std::future<std::optional<TimeError>> computing_;  ///< futures last: their tasks end before estimator_ is destroyed
};

}  // namespace heml
