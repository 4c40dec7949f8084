#pragma once
// A desktop window with an OpenGL 3.3 context, and its input events.
#include <app/render/camera.hpp>
#include <app/render/context.hpp>
#include <app/window/input_queue.hpp>
#include <array>
#include <stdexcept>
#include <string>

struct GLFWwindow;

namespace heml::window {

/// No window can be opened: no display, or none with OpenGL 3.3. what(): the reason in a few words.
class NoDisplay : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Called from within GlfwWindow::wait().
class WindowEvents {
 public:
  virtual ~WindowEvents() = default;
  virtual void came(Input input) = 0;
  virtual void changed() = 0;  ///< resized, focused or uncovered: draw again
};

/// At most one exists at a time, on the program's main thread.
class GlfwWindow final : public render::GraphicsContext {
 public:
  /// Opens the window and makes its context current. size: screen coordinates. within_screen: no larger than the
  /// screen. Throws NoDisplay.
  GlfwWindow(const std::string& title, render::Size size, bool within_screen);
  ~GlfwWindow() override;
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;

  void make_current() override;
  render::Size size() const override;
  render::Size window_size() const;  ///< screen coordinates
  void present() override;
  GLADloadfunc loader() const override;

  /// Sends events to `events` from now on; the current ImGui context must exist until the next call; nullptr: stops.
  void send_events_to(WindowEvents* events);
  /// Passes an input to ImGui, when it is applied.
  void pass_to_imgui(const Input& input);
  /// Passes the mouse to ImGui as the input applied so far has it. Call before each ImGui frame. more_waits: whether
  /// there is input that is not applied yet.
  void prepare_imgui(bool more_waits);

  void set_title(const std::string& title);
  bool closed() const;          ///< the user asked to close it
  void stay_open();             ///< takes that request back
  bool visible() const;         ///< false while minimised
  bool focused() const;         ///< it has the keys
  float content_scale() const;  ///< of the screen, 1 to 4
  float pixel_ratio() const;    ///< pixels per unit of mouse coordinates

  /// Waits for an event or wake(), `seconds` at most, and dispatches events; 0: only dispatches.
  static void wait(double seconds);
  /// Ends a wait(); from any thread while a window is open.
  static void wake();

 private:
  void install_callbacks();
  static WindowEvents* events_of(GLFWwindow* window);
  static GlfwWindow& self(GLFWwindow* window);

  GLFWwindow* window_ = nullptr;
  WindowEvents* events_ = nullptr;
  render::Vec2f mouse_ = render::Vec2f::Zero();  // of the input applied so far, pixels
  std::array<bool, 3> down_{};                   // buttons, likewise
};

}  // namespace heml::window
