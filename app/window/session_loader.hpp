#pragma once
// Starts the sessions of scenes; opens further ones on another thread while a session runs.
#include <app/window/recording_file.hpp>
#include <atomic>
#include <filesystem>
#include <future>
#include <heml/session/session.hpp>
#include <memory>
#include <optional>
#include <variant>

namespace heml::window {

struct OpenScene {
  Scene scene;
  RecordingFile file;  ///< `recording`, locked until the session has ended
  std::unique_ptr<Session> session;
  std::optional<std::filesystem::path> recording;  ///< file being written
  bool was_recorded = false;                       ///< the scene is a recording, or was resumed from one
  std::vector<std::string> comparisons;            ///< SessionOptions::comparisons
  std::optional<long> resumed;                     ///< tick at which it resumes another session
  std::vector<std::string> findings = {};          ///< what was found and chosen on opening, for people
};

/// Starts the session of a scene, whose frames wake the window. record: file to write, which is not to hold anything
/// yet. warnings: of reading the scene. Throws InputError.
OpenScene start(Scene scene, const std::optional<std::filesystem::path>& record,
                std::vector<std::string> comparisons = {}, std::vector<std::string> warnings = {});

/// STEM-2.jsonl in the folder of a file, or the next number that does not exist yet.
std::filesystem::path next_recording(const std::filesystem::path& file);

/// Prepares one session at a time on another thread: of a file, or resumed from a past time. Calls while one is under
/// way have no effect.
class SessionLoader {
 public:
  ~SessionLoader() { cancel(); }

  /// Opens a file and adds it to the recent ones (state_folder.hpp). record: recording of the first scene, if any; this
  /// one goes to next_recording() of it. options: of a bare mesh.
  void begin(const std::filesystem::path& path, const std::optional<std::filesystem::path>& record,
             const BareMeshOptions& options = {}, std::vector<std::string> comparisons = {});

  /// Replays a scene of Session::until() to its end; the session is then paused. record: an earlier recording, if any;
  /// this one goes to next_recording() of it, in state_folder() if its folder is not writable.
  void resume(Scene scene, const std::optional<std::filesystem::path>& record,
              std::vector<std::string> comparisons = {});

  bool is_busy() const { return result_.valid(); }
  bool is_ready() const;  ///< take() has an outcome
  /// Progress of a replay before resuming, %; none for a file.
  std::optional<int> progress() const;
  bool is_replaying() const { return progress() && !cancelled_; }  ///< before resuming, to an outcome
  void cancel() { cancelled_ = true; }

  /// The outcome, once: a session, or the error message; nothing before, or after cancel().
  std::optional<std::variant<OpenScene, std::string>> take();

 private:
  OpenScene replay_to(Scene scene, const std::optional<std::filesystem::path>& record,
                      std::vector<std::string> comparisons);

  std::atomic<bool> cancelled_{false};
  std::atomic<long> replayed_tick_{0};
  long target_tick_ = 0;  ///< tick to resume at; 0: a file is opened
  std::future<OpenScene> result_;
};

}  // namespace heml::window
