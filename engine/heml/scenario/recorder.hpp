#pragma once
// Appends a session to a JSON Lines file as it goes:
//
//   {"schema_version": 1, "mesh": ..., "recorded": {...}}    the scene, and which mesh it was
//   {"step": 0, "checkpoint": "...", "nodes": "..."}         state before tick 0
//   {"step": 12, "grasp": {"node": 3, "radius": 0.01}}       commands, before the tick they act on
//   ...
//   {"step": 900, "end": true}
//
// Every line is handed to the system before the next is made, so a crash loses the line being written and no other.
#include <cstdio>
#include <filesystem>
#include <heml/scenario/scene.hpp>
#include <heml/world/world.hpp>
#include <memory>
#include <string>

namespace heml {

/// A scene as its recordings hold it: with which mesh it was, and whose bits its states are. world: as built from it.
Scene as_recorded(const Scene& scene, const World& world);

class Recorder {
 public:
  /// Replaces the file. world: as built from the scene, before its first tick. checkpoint_every: ticks.
  /// Throws InputError when the file cannot be written or is the scene's own.
  Recorder(const std::filesystem::path& path, const Scene& scene, const World& world, long checkpoint_every = 500);

  /// A command that takes effect at the world's coming tick.
  void command(const World& world, const Command& command);

  /// To be called after every tick: writes a checkpoint when one is due.
  void ticked(const World& world);

  /// The last checkpoint and the end. Nothing may be written afterwards.
  void end(const World& world);

 private:
  /// A disk that fills up ends the recording with a warning, not the session.
  void write(const std::string& line);
  void checkpoint(const World& world);

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;  ///< null once it ended
  long every_, last_checkpoint_ = -1, last_command_ = -1;
};

}  // namespace heml
