#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <heml/session/step_doubling_scheduler.hpp>

namespace heml {
namespace {

/// Lowers the scheduling priority of the calling thread (nice 15).
void lower_priority() { setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 15); }

template <class Value>
bool is_ready(const std::future<Value>& future) {
  return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

void StepDoublingScheduler::carried_out(const Command& command) {
  if (const auto* move = std::get_if<MoveTool>(&command)) {
    if (doing_ == Doing::following) estimator_->move(*move);
    return;
  }
  if (doing_ == Doing::following) doing_ = Doing::nothing;
  const bool is_of_the_hand = std::holds_alternative<Grasp>(command) || std::holds_alternative<Release>(command);
  outdated_ |= !is_of_the_hand && !std::holds_alternative<Reset>(command);
}

void StepDoublingScheduler::ticked(const World& world) {
  if (doing_ == Doing::nothing) {
    if (std::abs(world.time() - rested_at_) >= pause) begin(world);
  } else if (doing_ == Doing::making && is_ready(making_)) {
    estimator_ = making_.get();
    doing_ = Doing::nothing;
  } else if (doing_ == Doing::following) {
    estimator_->ticked(world);
    if (estimator_->elapsed() < stretch) return;
    rested_at_ = world.time();
    if (burns_ != world.setup().mesh.burns) {  // rest shapes have gone on to shrink, those of the estimator not
      doing_ = Doing::nothing;
      return;
    }
    doing_ = Doing::computing;
    computing_ = std::async(std::launch::async, [shadow = estimator_.get(), reached = world.positions()] {
      lower_priority();
      return shadow->error(reached);
    });
  } else if (doing_ == Doing::computing && is_ready(computing_)) {
    latest_ = computing_.get();
    doing_ = Doing::nothing;
  }
}

void StepDoublingScheduler::begin(const World& world) {
  // Elements that edits have removed are in the setup's mesh too: no other world can be made of it.
  if (world.topology()->elements.size() != world.setup().mesh.tets.size()) {
    latest_.reset();
    rested_at_ = world.time();
  } else if (!estimator_ || outdated_ || burns_ != world.setup().mesh.burns) {
    outdated_ = false;
    burns_ = world.setup().mesh.burns;
    doing_ = Doing::making;
    making_ = std::async(std::launch::async, [setup = world.setup()] {
      lower_priority();
      return std::make_unique<StepDoublingEstimator>(setup);
    });
  } else if (estimator_->begin(world)) {
    doing_ = Doing::following;
  } else {
    latest_.reset();
    rested_at_ = world.time();
  }
}

}  // namespace heml
