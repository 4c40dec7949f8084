#pragma once
// A window of the desktop with OpenGL in it, and what people do to it.
#include <app/render/camera.hpp>
#include <app/render/context.hpp>
#include <app/window/mouse_tool.hpp>
#include <filesystem>
#include <stdexcept>
#include <string>

struct GLFWwindow;

namespace heml::window {

/// There can be no window: no display, or none with OpenGL 3.3. what(): why, in a few words.
class NoDisplay : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Called from within GlfwWindow::wait(). Places in pixels of the picture.
class WindowEvents {
 public:
  virtual ~WindowEvents() = default;
  virtual void key(int key, bool control, bool repeated) = 0;  ///< numbers of panel/keys.hpp
  virtual void button(MouseButton button, bool down, bool shift) = 0;
  virtual void mouse(const render::Vec2f& at) = 0;
  virtual void wheel(float notches) = 0;
  virtual void dropped(const std::filesystem::path& path) = 0;
  virtual void changed() = 0;  ///< size, focus, uncovered: draw again
};

/// One at a time, on the program's first thread.
class GlfwWindow final : public render::GraphicsContext {
 public:
  /// Opens the window, its context current. Throws NoDisplay.
  GlfwWindow(const std::string& title, render::Size size);
  ~GlfwWindow() override;
  GlfwWindow(const GlfwWindow&) = delete;
  GlfwWindow& operator=(const GlfwWindow&) = delete;

  void make_current() override;
  render::Size size() const override;
  void present() override;
  GLADloadfunc loader() const override;

  /// From now on events go there and to the ImGui context of the moment, which must outlive that; nullptr: nowhere.
  void send_events_to(WindowEvents* events);
  /// Hands the mouse to ImGui; before a frame of it begins.
  void prepare_imgui();

  void set_title(const std::string& title);
  bool closed() const;          ///< the user wants it closed
  bool visible() const;         ///< false while minimised
  float content_scale() const;  ///< of the screen: 1 on ordinary ones
  float pixel_ratio() const;    ///< pixels a unit of mouse coordinates

  /// Sleeps until something happens, `seconds` at most.
  static void wait(double seconds);
  /// Ends a wait(); from any thread while a window is open.
  static void wake();

 private:
  void install_callbacks();
  static WindowEvents* events_of(GLFWwindow* window);
  static GlfwWindow& self(GLFWwindow* window);

  GLFWwindow* window_ = nullptr;
  WindowEvents* events_ = nullptr;
};

}  // namespace heml::window
