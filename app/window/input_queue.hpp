#pragma once
// Mouse and keyboard input in the order in which it came. It is applied in that order, each once, however long a
// picture takes: a key that selects a tool comes before the press after it. What the panel takes needs a picture
// before the next input, since Dear ImGui looks at mouse and keys once a picture:
//
//    C, press, move, let go            on the body: all between two pictures
//    press, let go │ press │ let go    on the panel: a picture at each bar
#include <app/render/camera.hpp>
#include <deque>
#include <filesystem>
#include <utility>
#include <variant>

namespace heml::window {

enum class MouseButton { left, right, middle };  // as GLFW numbers them

struct KeyInput {
  int key = 0;  ///< as in panel/keys.hpp
  bool down = false, repeated = false, control = false, shift = false;
  int code = 0, scancode = 0, action = 0, modifiers = 0;  ///< as GLFW has them
};
struct CharacterInput {
  unsigned character = 0;  ///< Unicode
};
struct ButtonInput {
  MouseButton button = MouseButton::left;
  bool down = false, control = false, shift = false;
};
struct MotionInput {
  render::Vec2f at = render::Vec2f::Zero();  ///< pixels of the framebuffer
};
struct WheelInput {
  float across = 0, notches = 0;
};
struct DropInput {
  std::filesystem::path path;
};
using Input = std::variant<KeyInput, CharacterInput, ButtonInput, MotionInput, WheelInput, DropInput>;

class InputQueue {
 public:
  void add(Input input) { inputs_.push_back(std::move(input)); }
  bool empty() const { return inputs_.empty(); }
  bool needs_picture() const { return pictures_ > 0; }  ///< before it goes on

  /// Hands on what came, until a picture is needed. hand(input) returns how many pictures are needed before the next.
  template <class Hand>
  void apply(const Hand& hand) {
    while (pictures_ == 0 && !inputs_.empty()) {
      const Input next = std::move(inputs_.front());
      inputs_.pop_front();
      pictures_ = hand(next);
    }
  }
  /// A picture was drawn.
  void drew() {
    if (pictures_ > 0) --pictures_;
  }

 private:
  std::deque<Input> inputs_;
  int pictures_ = 0;
};

}  // namespace heml::window
