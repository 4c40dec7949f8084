#define GLFW_INCLUDE_NONE  // glad has the OpenGL functions
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>
#include <app/panel/keys.hpp>
#include <app/window/glfw_window.hpp>
#include <cctype>
#include <cstdlib>

namespace heml::window {
namespace {

std::string last_error(const char* otherwise) {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : otherwise;
}

/// Of the first screen, without bars; 0×0: none.
render::Size work_area() {
  render::Size area{0, 0};
  if (GLFWmonitor* first = glfwGetPrimaryMonitor())
    glfwGetMonitorWorkarea(first, nullptr, nullptr, &area.width, &area.height);
  return area;
}

render::Size within(render::Size area, render::Size size) {
  if (area.width <= 0 || area.height <= 0) return size;
  return {std::min(size.width, area.width), std::min(size.height, area.height)};
}

/// The number of a key in panel/keys.hpp: by the character printed on it, not by its position.
int panel_key(int key, int scancode) {
  switch (key) {
    case GLFW_KEY_ESCAPE:
      return panel::key_escape;
    case GLFW_KEY_TAB:
      return panel::key_tab;
    case GLFW_KEY_F1:
      return panel::key_f1;
    case GLFW_KEY_F5:
    case GLFW_KEY_F6:
    case GLFW_KEY_F7:
    case GLFW_KEY_F8:
      return panel::key_f5 + (key - GLFW_KEY_F5);
    case GLFW_KEY_F12:
      return panel::key_f12;
    case GLFW_KEY_DELETE:
      return panel::key_delete;
    case GLFW_KEY_LEFT:
      return panel::key_left;
    case GLFW_KEY_RIGHT:
      return panel::key_right;
    case GLFW_KEY_HOME:
      return panel::key_home;
    case GLFW_KEY_END:
      return panel::key_end;
    case GLFW_KEY_UP:
      return panel::key_up;
    case GLFW_KEY_DOWN:
      return panel::key_down;
    case GLFW_KEY_ENTER:
    case GLFW_KEY_KP_ENTER:
      return panel::key_enter;
    case GLFW_KEY_KP_1:
      return panel::key_pad_1;
    case GLFW_KEY_KP_3:
      return panel::key_pad_3;
    case GLFW_KEY_KP_5:
      return panel::key_pad_5;
    case GLFW_KEY_KP_7:
      return panel::key_pad_7;
    case GLFW_KEY_KP_DECIMAL:
      return '.';
    default:
      break;
  }
  const char* name = glfwGetKeyName(key, scancode);
  const int printed = name && name[0] && !name[1] ? std::toupper(static_cast<unsigned char>(name[0])) : key;
  return panel::action_of(printed, false) || panel::action_of(printed, true) ? printed : key;
}

}  // namespace

GlfwWindow& GlfwWindow::self(GLFWwindow* window) { return *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window)); }
WindowEvents* GlfwWindow::events_of(GLFWwindow* window) { return self(window).events_; }

GlfwWindow::GlfwWindow(const std::string& title, render::Size size, bool within_screen) {
  // Limits Mesa's software renderer to one core: the others are for the engine.
  setenv("LP_NUM_THREADS", "1", 0);
  if (!glfwInit()) throw NoDisplay(last_error("no display"));
  if (within_screen) size = within(work_area(), size);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_DEPTH_BITS, 24);
  glfwWindowHint(GLFW_SAMPLES, 0);  // the renderer antialiases by itself
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "heml");
  window_ = glfwCreateWindow(size.width, size.height, title.c_str(), nullptr, nullptr);
  if (!window_) {
    const std::string reason = last_error("no OpenGL 3.3");
    glfwTerminate();
    throw NoDisplay(reason);
  }
  glfwSetWindowUserPointer(window_, this);
  glfwMakeContextCurrent(window_);
  try {
    load_functions();
  } catch (const std::runtime_error& error) {
    glfwTerminate();
    throw NoDisplay(error.what());
  }
  glfwSwapInterval(1);
  install_callbacks();
}

GlfwWindow::~GlfwWindow() {
  send_events_to(nullptr);
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void GlfwWindow::make_current() { glfwMakeContextCurrent(window_); }

render::Size GlfwWindow::size() const {
  render::Size size;
  glfwGetFramebufferSize(window_, &size.width, &size.height);
  return size;
}

render::Size GlfwWindow::window_size() const {
  render::Size size;
  glfwGetWindowSize(window_, &size.width, &size.height);
  return size;
}

void GlfwWindow::present() { glfwSwapBuffers(window_); }
GLADloadfunc GlfwWindow::loader() const { return glfwGetProcAddress; }

void GlfwWindow::send_events_to(WindowEvents* events) {
  if (events_) ImGui_ImplGlfw_Shutdown();
  events_ = events;
  if (events_) ImGui_ImplGlfw_InitForOpenGL(window_, false);
}

void GlfwWindow::pass_to_imgui(const Input& input) {
  if (const auto* key = std::get_if<KeyInput>(&input))
    ImGui_ImplGlfw_KeyCallback(window_, key->code, key->scancode, key->action, key->modifiers);
  if (const auto* typed = std::get_if<CharacterInput>(&input)) ImGui_ImplGlfw_CharCallback(window_, typed->character);
  if (const auto* wheel = std::get_if<WheelInput>(&input))
    ImGui_ImplGlfw_ScrollCallback(window_, static_cast<double>(wheel->across), static_cast<double>(wheel->notches));
  if (const auto* motion = std::get_if<MotionInput>(&input)) mouse_ = motion->at;
  if (const auto* button = std::get_if<ButtonInput>(&input)) {
    down_[static_cast<std::size_t>(button->button)] = button->down;
    ImGui_ImplGlfw_MouseButtonCallback(window_, static_cast<int>(button->button),
                                       button->down ? GLFW_PRESS : GLFW_RELEASE, 0);
  }
}

/// Dear ImGui's own look at the mouse is ahead where input waits.
void GlfwWindow::prepare_imgui(bool more_waits) {
  ImGui_ImplGlfw_NewFrame();
  ImGuiIO& io = ImGui::GetIO();
  if (!ImGui::IsMousePosValid(&io.MousePos)) return;
  if (!more_waits) {
    io.MousePos = {io.MousePos.x * pixel_ratio(), io.MousePos.y * pixel_ratio()};
    return;
  }
  io.MousePos = {mouse_.x(), mouse_.y()};
  std::copy(down_.begin(), down_.end(), io.MouseDown);
}

void GlfwWindow::set_title(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }
bool GlfwWindow::closed() const { return glfwWindowShouldClose(window_); }
void GlfwWindow::stay_open() { glfwSetWindowShouldClose(window_, GLFW_FALSE); }
bool GlfwWindow::visible() const {
  return size().width > 0 && size().height > 0 && !glfwGetWindowAttrib(window_, GLFW_ICONIFIED);
}
bool GlfwWindow::focused() const { return glfwGetWindowAttrib(window_, GLFW_FOCUSED); }

float GlfwWindow::content_scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  return std::clamp(std::max(x, y), 1.0f, 4.0f);
}

float GlfwWindow::pixel_ratio() const {
  int width = 0, height = 0;
  glfwGetWindowSize(window_, &width, &height);
  return width > 0 ? static_cast<float>(size().width) / static_cast<float>(width) : 1.0f;
}

void GlfwWindow::wait(double seconds) {
  if (seconds > 0)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
}

void GlfwWindow::wake() { glfwPostEmptyEvent(); }

void GlfwWindow::install_callbacks() {
  glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
    if (events_of(w))
      events_of(w)->came(KeyInput{panel_key(key, scancode), action != GLFW_RELEASE, action == GLFW_REPEAT,
                                  (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_SHIFT) != 0, key, scancode, action,
                                  mods});
  });
  glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned character) {
    if (events_of(w)) events_of(w)->came(CharacterInput{character});
  });
  glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int mods) {
    if (!events_of(w) || button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    events_of(w)->came(ButtonInput{static_cast<MouseButton>(button), action == GLFW_PRESS,
                                   (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_SHIFT) != 0});
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
    if (events_of(w))
      events_of(w)->came(
          MotionInput{self(w).pixel_ratio() * render::Vec2f(static_cast<float>(x), static_cast<float>(y))});
  });
  glfwSetCursorEnterCallback(window_, [](GLFWwindow* w, int entered) {
    if (!events_of(w)) return;
    ImGui_ImplGlfw_CursorEnterCallback(w, entered);
    events_of(w)->changed();
  });
  glfwSetScrollCallback(window_, [](GLFWwindow* w, double x, double y) {
    if (events_of(w)) events_of(w)->came(WheelInput{static_cast<float>(x), static_cast<float>(y)});
  });
  glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int focused) {
    if (events_of(w)) ImGui_ImplGlfw_WindowFocusCallback(w, focused);
  });
  glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
    if (events_of(w) && count > 0) events_of(w)->came(DropInput{paths[0]});
  });
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) {
    if (events_of(w)) events_of(w)->changed();
  });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) {
    if (events_of(w)) events_of(w)->changed();
  });
}

}  // namespace heml::window
