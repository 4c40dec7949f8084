#include <algorithm>
#include <chrono>
#include <heml/session/haptic_link.hpp>
#include <heml/session/mailbox.hpp>
#include <optional>
#include <thread>

namespace heml {

class HapticLink::Impl {
 public:
  Impl(HapticDevice& device, const HapticLimits& limits) : device_(device), servo_(limits) {
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
  }

  void show(const std::optional<TouchState>& state) {
    states_.back() = state;
    states_.publish();
  }
  Vec3 hand() { return hands_.front(); }

 private:
  void serve(const std::stop_token& stop) {
    using Clock = std::chrono::steady_clock;
    auto due = Clock::now(), before = due;
    while (!stop.stop_requested()) {
      if (states_.waiting()) {
        const std::optional<TouchState>& state = states_.front();
        state ? servo_.take(*state) : servo_.let_go();
      }
      const auto now = Clock::now();
      const double seconds = now > before ? std::chrono::duration<double>(now - before).count() : turn;
      before = now;
      const Vec3 hand = device_.place();
      device_.push(servo_.serve(hand, seconds));
      hands_.back() = hand;
      hands_.publish();
      due = std::max(due + std::chrono::microseconds(1000), now);  // late once is not late ever after
      std::this_thread::sleep_until(due);
    }
    device_.push(Vec3::Zero());
  }

  HapticDevice& device_;
  HapticServo servo_;
  Mailbox<std::optional<TouchState>> states_;
  Mailbox<Vec3> hands_;
  std::jthread thread_;  // last: ends before what it uses
};

HapticLink::HapticLink(HapticDevice& device, const HapticLimits& limits)
    : impl_(std::make_unique<Impl>(device, limits)) {}
HapticLink::~HapticLink() = default;
void HapticLink::show(const TouchState& state) { impl_->show(state); }
void HapticLink::let_go() { impl_->show(std::nullopt); }
Vec3 HapticLink::hand() { return impl_->hand(); }

}  // namespace heml
