#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <heml/session/haptic_loop.hpp>
#include <thread>

namespace heml::haptic_loop_test {
namespace {

/// A device fixed at x = 1 cm that counts the forces it gets.
class StandingHand : public HapticDevice {
 public:
  Vec3 position() override { return {0.01, 0, 0}; }
  void apply_force(const Vec3& force) override {
    ++turns;
    last_x = force.x();
  }
  std::atomic<int> turns = 0;
  std::atomic<double> last_x = 0;
};

template <class StateCheck>
bool comes(const StateCheck& condition) {
  for (int k = 0; k < 5000; ++k) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace

TEST_CASE("a device is served by its own thread, learns of the tool, and is released at the end") {
  StandingHand device;
  {
    HapticLoop link(device);
    CHECK(comes([&] { return device.turns > 20; }));
    CHECK(device.last_x == 0);
    CHECK(comes([&] { return link.handle() == Vec3(0.01, 0, 0); }));
    link.show({0, Vec3::Zero(), Vec3(2, 0, 0)});
    CHECK(comes([&] { return device.last_x == -2; }));
    link.let_go();
    CHECK(comes([&] { return device.last_x == 0; }));
    link.show({0, Vec3::Zero(), Vec3(1, 0, 0)});
    CHECK(comes([&] { return device.last_x == -1; }));
  }
  CHECK(device.last_x == 0);
}

}  // namespace heml::haptic_loop_test
