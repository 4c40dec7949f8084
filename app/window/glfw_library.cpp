// Loads GLFW when a window is opened, so that commands without a window neither load nor need it and the display
// libraries that it depends on. Forwards the functions that the window and Dear ImGui's backend call.
#define GLFW_INCLUDE_NONE  // glad has the OpenGL functions
#include <GLFW/glfw3.h>
#include <dlfcn.h>

namespace {

void* library() {
  static void* const opened = dlopen("libglfw.so.3", RTLD_NOW | RTLD_LOCAL);
  return opened;
}

template <class Function>
Function* find(const char* name) {
  return reinterpret_cast<Function*>(dlsym(library(), name));
}

}  // namespace

// Without the library glfwInit() fails, and no other function is called.
int glfwInit() { return library() ? find<decltype(glfwInit)>("glfwInit")() : GLFW_FALSE; }

int glfwGetError(const char** description) {
  if (library()) return find<decltype(glfwGetError)>("glfwGetError")(description);
  if (description) *description = "a window needs libglfw.so.3 (Debian: libglfw3)";
  return GLFW_API_UNAVAILABLE;
}

#define FORWARD(Result, name, parameters, arguments)          \
  Result name parameters {                                    \
    static const auto function = find<decltype(name)>(#name); \
    return function arguments;                                \
  }
// clang-format off
FORWARD(GLFWcursor*, glfwCreateStandardCursor, (int shape), (shape))
FORWARD(void, glfwDestroyCursor, (GLFWcursor* cursor), (cursor))
FORWARD(const char*, glfwGetClipboardString, (GLFWwindow* window), (window))
FORWARD(void, glfwGetCursorPos, (GLFWwindow* window, double* xpos, double* ypos), (window, xpos, ypos))
FORWARD(void, glfwGetFramebufferSize, (GLFWwindow* window, int* width, int* height), (window, width, height))
FORWARD(const char*, glfwGetGamepadName, (int jid), (jid))
FORWARD(int, glfwGetGamepadState, (int jid, GLFWgamepadstate* state), (jid, state))
FORWARD(int, glfwGetInputMode, (GLFWwindow* window, int mode), (window, mode))
FORWARD(const float*, glfwGetJoystickAxes, (int jid, int* count), (jid, count))
FORWARD(const unsigned char*, glfwGetJoystickButtons, (int jid, int* count), (jid, count))
FORWARD(void, glfwGetMonitorWorkarea, (GLFWmonitor* monitor, int* x, int* y, int* width, int* height),
        (monitor, x, y, width, height))
FORWARD(int, glfwGetMouseButton, (GLFWwindow* window, int button), (window, button))
FORWARD(GLFWmonitor*, glfwGetPrimaryMonitor, (), ())
FORWARD(double, glfwGetTime, (), ())
FORWARD(int, glfwGetWindowAttrib, (GLFWwindow* window, int attrib), (window, attrib))
FORWARD(void, glfwGetWindowSize, (GLFWwindow* window, int* width, int* height), (window, width, height))
FORWARD(GLFWcharfun, glfwSetCharCallback, (GLFWwindow* window, GLFWcharfun callback), (window, callback))
FORWARD(void, glfwSetClipboardString, (GLFWwindow* window, const char* string), (window, string))
FORWARD(void, glfwSetCursor, (GLFWwindow* window, GLFWcursor* cursor), (window, cursor))
FORWARD(GLFWcursorenterfun, glfwSetCursorEnterCallback, (GLFWwindow* window, GLFWcursorenterfun callback),
        (window, callback))
FORWARD(void, glfwSetCursorPos, (GLFWwindow* window, double xpos, double ypos), (window, xpos, ypos))
FORWARD(GLFWerrorfun, glfwSetErrorCallback, (GLFWerrorfun callback), (callback))
FORWARD(void, glfwSetInputMode, (GLFWwindow* window, int mode, int value), (window, mode, value))
FORWARD(int, glfwJoystickIsGamepad, (int jid), (jid))
FORWARD(GLFWjoystickfun, glfwSetJoystickCallback, (GLFWjoystickfun callback), (callback))
FORWARD(GLFWkeyfun, glfwSetKeyCallback, (GLFWwindow* window, GLFWkeyfun callback), (window, callback))
FORWARD(GLFWmonitorfun, glfwSetMonitorCallback, (GLFWmonitorfun callback), (callback))
FORWARD(GLFWmousebuttonfun, glfwSetMouseButtonCallback, (GLFWwindow* window, GLFWmousebuttonfun callback),
        (window, callback))
FORWARD(GLFWscrollfun, glfwSetScrollCallback, (GLFWwindow* window, GLFWscrollfun callback), (window, callback))
FORWARD(GLFWwindowfocusfun, glfwSetWindowFocusCallback, (GLFWwindow* window, GLFWwindowfocusfun callback),
        (window, callback))
FORWARD(GLFWwindow*, glfwCreateWindow,
        (int width, int height, const char* title, GLFWmonitor* monitor, GLFWwindow* share),
        (width, height, title, monitor, share))
FORWARD(void, glfwDestroyWindow, (GLFWwindow* window), (window))
FORWARD(const char*, glfwGetKeyName, (int key, int scancode), (key, scancode))
FORWARD(GLFWglproc, glfwGetProcAddress, (const char* procname), (procname))
FORWARD(void, glfwGetWindowContentScale, (GLFWwindow* window, float* xscale, float* yscale), (window, xscale, yscale))
FORWARD(void*, glfwGetWindowUserPointer, (GLFWwindow* window), (window))
FORWARD(void, glfwMakeContextCurrent, (GLFWwindow* window), (window))
FORWARD(void, glfwPollEvents, (), ())
FORWARD(void, glfwPostEmptyEvent, (), ())
FORWARD(GLFWcursorposfun, glfwSetCursorPosCallback, (GLFWwindow* window, GLFWcursorposfun callback), (window, callback))
FORWARD(GLFWdropfun, glfwSetDropCallback, (GLFWwindow* window, GLFWdropfun callback), (window, callback))
FORWARD(GLFWframebuffersizefun, glfwSetFramebufferSizeCallback, (GLFWwindow* window, GLFWframebuffersizefun callback),
        (window, callback))
FORWARD(GLFWwindowrefreshfun, glfwSetWindowRefreshCallback, (GLFWwindow* window, GLFWwindowrefreshfun callback),
        (window, callback))
FORWARD(void, glfwSetWindowShouldClose, (GLFWwindow* window, int value), (window, value))
FORWARD(void, glfwSetWindowTitle, (GLFWwindow* window, const char* title), (window, title))
FORWARD(void, glfwSetWindowUserPointer, (GLFWwindow* window, void* pointer), (window, pointer))
FORWARD(void, glfwSwapBuffers, (GLFWwindow* window), (window))
FORWARD(void, glfwSwapInterval, (int interval), (interval))
FORWARD(void, glfwTerminate, (), ())
FORWARD(void, glfwWaitEventsTimeout, (double timeout), (timeout))
FORWARD(void, glfwWindowHint, (int hint, int value), (hint, value))
FORWARD(void, glfwWindowHintString, (int hint, const char* value), (hint, value))
FORWARD(int, glfwWindowShouldClose, (GLFWwindow* window), (window))
// clang-format on
#undef FORWARD
