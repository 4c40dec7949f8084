#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <heml/session/shadow_keeper.hpp>

namespace heml {
namespace {

/// The calling thread takes what others leave.
void give_way() { setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 15); }

template <class Value>
bool is_ready(const std::future<Value>& future) {
  return future.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

void ShadowKeeper::carried_out(const Command& command) {
  if (const auto* move = std::get_if<MoveTool>(&command)) {
    if (doing_ == Doing::following) shadow_->move(*move);
    return;
  }
  if (doing_ == Doing::following) doing_ = Doing::nothing;
  const bool is_of_the_hand = std::holds_alternative<Grasp>(command) || std::holds_alternative<Release>(command);
  outdated_ |= !is_of_the_hand && !std::holds_alternative<Reset>(command);
}

void ShadowKeeper::ticked(const World& world) {
  if (doing_ == Doing::nothing) {
    if (std::abs(world.time() - rested_at_) >= pause) begin(world);
  } else if (doing_ == Doing::making && is_ready(making_)) {
    shadow_ = making_.get();
    doing_ = Doing::nothing;
  } else if (doing_ == Doing::following) {
    shadow_->ticked(world);
    if (shadow_->gone() < stretch) return;
    rested_at_ = world.time();
    doing_ = Doing::computing;
    computing_ = std::async(std::launch::async, [shadow = shadow_.get(), reached = world.positions()] {
      give_way();
      return shadow->error(reached);
    });
  } else if (doing_ == Doing::computing && is_ready(computing_)) {
    latest_ = computing_.get();
    doing_ = Doing::nothing;
  }
}

void ShadowKeeper::begin(const World& world) {
  if (!shadow_ || outdated_) {
    outdated_ = false;
    doing_ = Doing::making;
    making_ = std::async(std::launch::async, [setup = world.setup()] {
      give_way();
      return std::make_unique<Shadow>(setup);
    });
  } else if (shadow_->begin(world)) {
    doing_ = Doing::following;
  } else {
    latest_.reset();
    rested_at_ = world.time();
  }
}

}  // namespace heml
