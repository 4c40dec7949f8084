#pragma once
// The engine thread: steps a world at a fixed rate of simulated against wall time, takes commands through a queue,
// publishes immutable frames. Neither side waits for the other:
//
//    window thread                                    engine thread
//    ─────────────                                    ─────────────
//    post(command) ──────► queue ───────────────────► at the start of a tick: record, apply
//                                                     tick, tick, tick … at 1/rate seconds each
//    latest() ◄────────── three frames, swapped ◄──── publish, when the viewer has taken the last one
//                         by one atomic
//
// When the engine cannot keep up it slows simulated time, says so in Frame::pace, and never runs a burst to catch up.
//
// A recording is played as it was: until its end nothing is chosen by the clock, which it holds the choices of. An
// earlier moment is reached by playing what led there in a session of its own (until(), fast_forward_to()): no state is
// stored.
#include <filesystem>
#include <functional>
#include <heml/scenario/scene.hpp>
#include <heml/session/frame.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace heml {

struct SessionOptions {
  std::optional<std::filesystem::path> record;  ///< JSON Lines file every command and checkpoint is appended to
  std::filesystem::path recovery_file;          ///< what led to the last recovery is written there; empty: nowhere
  std::vector<std::string> comparisons;  ///< other ways to compute the body, side by side (variant.hpp); empty: none
  bool start_paused = false;
  long fast_forward_to = 0;  ///< a tick to go to first, as Session::fast_forward_to() does
  std::function<void()>
      on_frame;  ///< called on the engine thread after a frame is published (to wake a sleeping viewer)
  std::function<void()> before_tick;  ///< tests: called on the engine thread before each tick
};

class Session {
 public:
  /// Builds the world of a scene and starts its thread. Throws InputError as load_world() and variant_of() do.
  Session(const Scene& scene, SessionOptions options);
  ~Session();  ///< stops the thread and closes the recording
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // From any one thread (the window's); none of these waits for a step.
  void post(Command command);
  void play();
  void pause();
  void step_once();                    ///< one tick, then pause
  void fast_forward_to(long tick);     ///< goes there as fast as it can, then on as before; a pause ends it on the way
  void show(Field field);              ///< which scalars frames carry from now on
  void enable_stretches(bool wanted);  ///< whether Frame::stretches is filled from now on
  void enable_errors(bool wanted);     ///< whether Frame::mesh_error and time_error are found from now on
  const Frame& latest();               ///< the newest frame; stays as it is until the next call
  bool frame_waiting() const;          ///< true when latest() would return a newer one

  /// The scene with all that led to a frame of this session as its script, and Scene::recorded_ticks where that ends.
  /// A session of it that hurries there is in the same state to the bit, and goes on from there by itself.
  Scene until(const Frame& moment) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heml
