#pragma once
// Session: a world on an engine thread of its own. The thread ticks the world at a fixed rate of wall time, applies
// queued commands, and publishes immutable frames. Neither side waits for the other:
//
//    window thread                                    engine thread
//    ─────────────                                    ─────────────
//    post(command) ──────► queue ───────────────────► at the start of a tick: record, apply
//                                                     tick, tick, tick … at 1/rate seconds each
//    latest() ◄────────── three frames, swapped ◄──── publish, when the viewer has taken the last one
//                         by one atomic
//
// When the engine cannot keep up, simulated time slows (Frame::pace) and no burst catches up.
//
// A recording contains the choices that were made by the clock (budget, step cost, preconditioner); the session makes
// none of its own until the recording's end. An earlier time is reached by replaying the commands that led there in a
// new session (until(), fast_forward_to()): no states are stored.
#include <filesystem>
#include <functional>
#include <heml/scenario/scene.hpp>
#include <heml/session/frame.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace heml {

struct SessionOptions {
  std::optional<std::filesystem::path> record;  ///< JSON Lines file every command and checkpoint is appended to
  std::filesystem::path recovery_file;          ///< recording that reproduces the last recovery; empty: none
  std::vector<std::string> comparisons;         ///< variants for comparison runs, in the syntax of variant_of()
  bool start_paused = false;
  long fast_forward_to = 0;  ///< tick to fast-forward to first; 0: none
  std::function<void()>
      on_frame;  ///< called on the engine thread after a frame is published, to wake a sleeping viewer
  std::function<void()> before_tick;  ///< for tests: called on the engine thread before each tick
};

class Session {
 public:
  /// Builds the world of a scene and starts its thread. Throws InputError as load_world() and variant_of() do.
  Session(const Scene& scene, SessionOptions options);
  ~Session();  ///< stops the thread and closes the recording
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // From one thread (the window's). None waits for a tick.
  void post(Command command);
  void play();
  void pause();
  void step_once();                    ///< one tick, then pause
  /// Ticks at full speed up to `tick`, then on as before. 0 ends it where it is, and so does pause().
  void fast_forward_to(long tick);
  void show(Field field);              ///< the field in Frame::values from now on
  /// Leaves regions (ascending) out of the frames from now on; the simulation goes on with them.
  void hide_regions(const std::vector<int>& regions);
  void enable_stretches(bool wanted);  ///< whether Frame::stretches is filled from now on
  void enable_errors(bool wanted);     ///< whether Frame::mesh_error and time_error are filled from now on
  const std::vector<int>& regions() const;  ///< of the mesh, ascending
  const std::map<int, std::string>& region_names() const;  ///< those that the mesh's file names
  void enable_solid(bool wanted);      ///< whether Frame::solid and what goes with it is filled from now on
  const Frame& latest();               ///< the newest frame; unchanged until the next call
  bool frame_waiting() const;          ///< whether latest() would return a newer one
  /// Whether a frame of this session shows the results of every command posted and of everything else that it was asked
  /// to show. Of play(), pause() and steps Frame::paused and Frame::tick tell.
  bool has_answered(const Frame& frame) const;

  /// Returns the scene with the commands before a frame of this session as its events, and the frame's tick as
  /// Scene::recorded_ticks. A session of it that fast-forwards there reaches the same state to the bit.
  Scene until(const Frame& moment) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heml
