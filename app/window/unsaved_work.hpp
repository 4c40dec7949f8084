#pragma once
// Work done by hand that no recording holds yet. It is written on another thread, some seconds after it was done, into
// a recording of the user's state folder, which the next start of the program offers if this one ends unexpectedly:
//
//    done() ──► 5 s ──► is_due(): save() ──► thread: unsaved-4711.jsonl ──► stays until saved()
#include <chrono>
#include <filesystem>
#include <future>
#include <heml/scenario/scene.hpp>
#include <optional>

namespace heml::window {

/// A recording of the commands before a scene of Session::until() ends: replayed to there, the body is as it was.
std::string recording_of(Scene scene, const std::filesystem::path& folder);

class UnsavedWork {
 public:
  static constexpr std::size_t max_bytes = 64'000'000;  ///< of the file; work beyond is not written

  UnsavedWork() = default;
  ~UnsavedWork() = default;  ///< ends the writing; the file stays unless saved() was called
  UnsavedWork(const UnsavedWork&) = delete;
  UnsavedWork& operator=(const UnsavedWork&) = delete;

  void done(const Command& command);  ///< by hand, now; to reset or let go what nothing was done to is no work
  void recording_ended();             ///< early: what was done by hand is in no complete recording
  void saved();                       ///< in a recording, or not wanted: removes the file
  void scene_saved();                 ///< in a scene file, which holds settings and tables but not what tools did
  /// Takes over a file of left_behind(), whose work is now that of this program.
  void adopt(const std::filesystem::path& file);

  bool any() const { return changed_; }
  bool is_due() const;  ///< the file is to be written
  /// Writes a recording of a scene of Session::until(). Returns at once.
  void save(Scene scene);

  /// The latest file that a program has left which no longer runs, though another may have its number by now.
  static std::optional<std::filesystem::path> left_behind();

 private:
  using Clock = std::chrono::steady_clock;
  static std::filesystem::path file();

  bool changed_ = false;    ///< since saved()
  bool by_tools_ = false;   ///< and not by settings alone
  bool unwritten_ = false;  ///< since the file was written
  bool is_full_ = false;    ///< there is more than max_bytes
  Clock::time_point next_{};
  std::future<bool> writing_;  ///< whether it was small enough
};

}  // namespace heml::window
