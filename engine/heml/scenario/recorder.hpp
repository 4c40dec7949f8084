#pragma once
// Appends a session to a JSON Lines file as it goes:
//
//   {"schema_version": 1, "mesh": ..., "recorded": {...}}    the scene, which mesh it was, and who records
//   {"step": 0, "checkpoint": "...", "nodes": "..."}         state before tick 0
//   {"step": 12, "grasp": {"node": 3, "radius": 0.01}}       commands, before the tick they act on
//   ...
//   {"step": 900, "end": true, "checkpoints": 3, "hash": "..."}    the state before the commands of that
//   tick
//
// Every line is handed to the system before the next is made, so a crash loses the line being written and no other. A
// world that halts stops within a tick: the end then names that tick, the state before it, and why ("halt").
#include <filesystem>
#include <heml/scenario/scene.hpp>
#include <heml/world/world.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace heml {

class AppendFile;

/// A scene as its recordings hold it: with which mesh it was, and whose bits its states are. world: as built from it.
Scene as_recorded(const Scene& scene, const World& world);

/// Any of its functions throws InputError when the file takes no more; what comes after is not written any more.
class Recorder {
 public:
  /// Replaces the file. world: as built from the scene, between two ticks and not halted. checkpoint_every: ticks.
  /// past: every command since the world was made, which are written first; scene is then as_recorded() before them.
  /// hash_before: state_hash() before those of the coming tick, where they may have changed it.
  /// Throws InputError when the file cannot be written or the scene reads it.
  Recorder(const std::filesystem::path& path, const Scene& scene, const World& world, long checkpoint_every = 500,
           std::span<const Event> past = {}, std::optional<std::uint64_t> hash_before = {});
  Recorder(Recorder&&) noexcept;
  Recorder& operator=(Recorder&&) noexcept;
  ~Recorder();

  /// A command that takes effect at the world's coming tick, and has been applied.
  void command(const World& world, const Command& command);

  /// To be called after every tick: writes a checkpoint when one is due.
  void ticked(const World& world);

  /// Ends the recording for now: the next line takes the place of this end. Does nothing where the file is no regular
  /// one. For callers that others may stop at any time without a word.
  void end_for_now(const World& world);

  /// The last checkpoint and the end. Nothing is written afterwards.
  void end(const World& world);

 private:
  void write(const std::string& line);
  std::string last_line(const World& world) const;
  void checkpoint(const World& world);
  bool is_before_commands(const World& world) const;

  std::unique_ptr<AppendFile> file_;  ///< none once it ended
  std::optional<std::size_t> size_;   ///< bytes before the end that stands for now; none: no such end stands
  long every_, checkpoints_ = 0, last_checkpoint_ = -1;
  long tick_ = 0;                  ///< the coming one
  std::uint64_t hash_ = 0;         ///< of the state before its commands
  bool halted_ = false;            ///< as of the last call
  std::vector<std::string> moot_;  ///< lines of commands given to a world that had halted: they count after a reset
};

}  // namespace heml
