#include <app/window/spacemouse.hpp>
#include <atomic>
#include <utility>

#ifdef HEML_SPACEMOUSE
#include <dlfcn.h>
#include <poll.h>
#include <spnav.h>

#include <csignal>
#include <thread>
#endif

namespace heml::window {
namespace {
constexpr float full = 350;                  // of an axis, as far as the cap goes
constexpr float still = 0.08f, twist = 0.2f;  // dead zones: who shifts the cap twists it a little
}  // namespace

HandState hand_state(const SpaceMouseState& mouse) {
  const auto axis = [&](std::size_t k, float dead_zone) {
    return beyond_dead_zone(static_cast<float>(mouse.axes[k]) / full, dead_zone);
  };
  HandState state;
  state.move = {axis(0, still), axis(1, still), -axis(2, still)};
  state.turn_right = -axis(4, twist);
  state.turn_down = -axis(3, twist);
  state.grasp = mouse.buttons[0];
  state.clamp = mouse.buttons[1];
  return state;
}

struct SpaceMouseFinder::Search {
  std::atomic<bool> found{false};
};

#ifdef HEML_SPACEMOUSE
namespace {

/// The library, opened when it is first wanted: programs without a window need neither it nor what it links.
struct Library {
  decltype(&spnav_open) open = nullptr;
  decltype(&spnav_close) close = nullptr;
  decltype(&spnav_fd) descriptor = nullptr;
  decltype(&spnav_poll_event) poll_event = nullptr;

  Library() {
    void* const opened = dlopen("libspnav.so.0", RTLD_NOW | RTLD_LOCAL);
    if (!opened) return;
    open = reinterpret_cast<decltype(open)>(dlsym(opened, "spnav_open"));
    close = reinterpret_cast<decltype(close)>(dlsym(opened, "spnav_close"));
    descriptor = reinterpret_cast<decltype(descriptor)>(dlsym(opened, "spnav_fd"));
    poll_event = reinterpret_cast<decltype(poll_event)>(dlsym(opened, "spnav_poll_event"));
  }
  bool is_there() const { return open && close && descriptor && poll_event; }
};

const Library& library() {
  static const Library opened;
  return opened;
}

class SpaceMouse final : public HandDevice {
 public:
  ~SpaceMouse() override { library().close(); }
  panel::DeviceInfo info() const override {
    return {"SpaceMouse", "Read from spacenavd",
            {"cap moves", "left button grasps, lets go", "right button leaves a clamp", "a twist turns the view"}, true};
  }

  std::optional<HandState> read() override {
    constexpr int most = 1000;  // events: more than come between two pictures
    for (int events = 0; events < most; ++events) {
      pollfd daemon{library().descriptor(), POLLIN, 0};
      if (poll(&daemon, 1, 0) <= 0) break;
      spnav_event event{};
      // Without an event where there was something to read, the daemon has closed the connection.
      if (library().poll_event(&event) == 0) return std::nullopt;
      take(event);
      if (event.type == SPNAV_EVENT_BUTTON) break;  // the next call reads on: a press that was short is seen too
    }
    return hand_state(state_);
  }

 private:
  void take(const spnav_event& event) {
    if (event.type == SPNAV_EVENT_MOTION) {
      const spnav_event_motion& m = event.motion;
      state_.axes = {m.x, m.y, m.z, m.rx, m.ry, m.rz};
    }
    if (event.type == SPNAV_EVENT_BUTTON && event.button.bnum >= 0 && event.button.bnum < 2)
      state_.buttons[static_cast<std::size_t>(event.button.bnum)] = event.button.press != 0;
    if (event.type == SPNAV_EVENT_DEV) state_ = {};  // plugged in or out
  }

  SpaceMouseState state_;
};

}  // namespace

SpaceMouseFinder::SpaceMouseFinder() : search_(std::make_shared<Search>()) {
  // Detached: the end of the program does not wait for a daemon that never answers. One that closes the connection at
  // once would end the program by a signal.
  std::thread([search = search_] {
    sigset_t pipe;
    sigemptyset(&pipe);
    sigaddset(&pipe, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe, nullptr);
    search->found = library().is_there() && library().open() == 0;
  }).detach();
}

std::unique_ptr<HandDevice> SpaceMouseFinder::take() {
  return search_->found.exchange(false) ? std::make_unique<SpaceMouse>() : nullptr;
}
#else
SpaceMouseFinder::SpaceMouseFinder() = default;
std::unique_ptr<HandDevice> SpaceMouseFinder::take() { return nullptr; }
#endif

}  // namespace heml::window
