#include <algorithm>
#include <chrono>
#include <heml/session/haptic_loop.hpp>
#include <heml/session/mailbox.hpp>
#include <optional>
#include <thread>

namespace heml {

class HapticLoop::Impl {
 public:
  Impl(HapticDevice& device, const HapticLimits& limits) : device_(device), servo_(limits) {
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
  }

  void show(const std::optional<ToolContact>& state) {
    states_.back() = state;
    states_.publish();
  }
  Vec3 handle() { return handle_positions_.front(); }

 private:
  void serve(const std::stop_token& stop) {
    using Clock = std::chrono::steady_clock;
    auto due = Clock::now(), before = due;
    while (!stop.stop_requested()) {
      if (states_.waiting()) {
        const std::optional<ToolContact>& state = states_.front();
        state ? servo_.update(*state) : servo_.release();
      }
      const auto now = Clock::now();
      const double seconds = now > before ? std::chrono::duration<double>(now - before).count() : turn;
      before = now;
      const Vec3 handle = device_.position();
      device_.apply_force(servo_.serve(handle, seconds));
      handle_positions_.back() = handle;
      handle_positions_.publish();
      due = std::max(due + std::chrono::microseconds(1000), now);  // no burst after a delay
      std::this_thread::sleep_until(due);
    }
    device_.apply_force(Vec3::Zero());
  }

  HapticDevice& device_;
  HapticServo servo_;
  Mailbox<std::optional<ToolContact>> states_;
  Mailbox<Vec3> handle_positions_;
  std::jthread thread_;  // declared last: joined before the members it uses are destroyed
};

HapticLoop::HapticLoop(HapticDevice& device, const HapticLimits& limits)
    : impl_(std::make_unique<Impl>(device, limits)) {}
HapticLoop::~HapticLoop() = default;
void HapticLoop::show(const ToolContact& state) { impl_->show(state); }
void HapticLoop::let_go() { impl_->show(std::nullopt); }
Vec3 HapticLoop::handle() { return impl_->handle(); }

}  // namespace heml
