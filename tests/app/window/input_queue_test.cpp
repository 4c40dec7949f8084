#include <doctest/doctest.h>

#include <app/window/input_queue.hpp>
#include <string>

namespace heml::input_queue_test {

using namespace heml::window;

namespace {

/// Writes down what is applied: "C" a key, "+" and "-" a button, "m" a motion, "w" the wheel.
struct Listener {
  InputQueue queue;
  std::string applied;
  int pictures = 0;  // that a button needs

  int operator()(const KeyInput& key) { return applied += static_cast<char>(key.key), 0; }
  int operator()(const ButtonInput& button) { return applied += button.down ? '+' : '-', pictures; }
  int operator()(const MotionInput&) { return applied += 'm', 0; }
  int operator()(const WheelInput&) { return applied += 'w', 0; }
  template <class Other>
  int operator()(const Other&) {
    return 0;
  }

  void apply() {
    queue.apply([this](const Input& input) {
      return std::visit([this](const auto& one) { return (*this)(one); }, input);
    });
  }
  void select_and_draw_a_stroke() {
    queue.add(KeyInput{'C', true});
    queue.add(ButtonInput{MouseButton::left, true});
    for (int k = 0; k < 2; ++k) queue.add(MotionInput{{10, 20}});
    queue.add(ButtonInput{MouseButton::left, false});
    queue.add(KeyInput{'G', true});
    queue.add(WheelInput{0, 1});
  }
};

}  // namespace

TEST_CASE("input is applied in the order in which it came, each once") {
  Listener listener;
  listener.select_and_draw_a_stroke();
  listener.apply();
  CHECK(listener.applied == "C+mm-Gw");
  CHECK(listener.queue.empty());
  listener.apply();
  CHECK(listener.applied == "C+mm-Gw");
  CHECK_FALSE(listener.queue.needs_picture());
}

TEST_CASE("input after a press that needs pictures waits for them") {
  Listener listener;
  listener.pictures = 2;
  listener.select_and_draw_a_stroke();
  listener.apply();
  CHECK(listener.applied == "C+");
  CHECK(listener.queue.needs_picture());
  listener.queue.drew();
  listener.apply();
  CHECK(listener.applied == "C+");
  listener.queue.drew();
  listener.apply();
  CHECK(listener.applied == "C+mm-");
  listener.queue.add(KeyInput{'X', true});
  for (int k = 0; k < 3; ++k) {
    listener.queue.drew();
    listener.apply();
  }
  CHECK(listener.applied == "C+mm-GwX");
}

}  // namespace heml::input_queue_test
