#pragma once
// Scenes and the sessions they run in; what is opened later is read beside the running one.
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
  std::unique_ptr<Session> session;
  std::optional<std::filesystem::path> recording;  ///< that is being written
  bool was_recorded = false;                       ///< the scene is a recording, or goes on from one
  std::vector<std::string> comparisons;            ///< SessionOptions::beside
  std::optional<long> resumed;                     ///< the tick of another session that this one goes on from
};

/// Starts the session of a scene, with a window that is woken by its frames. record: where. Throws InputError.
OpenScene start(Scene scene, const std::optional<std::filesystem::path>& record,
                std::vector<std::string> comparisons = {});

/// STEM-2.jsonl beside a file, or the next number that is not there yet.
std::filesystem::path next_recording(const std::filesystem::path& file);

/// A file or a moment of a session on its way to being a session.
class SessionLoader {
 public:
  ~SessionLoader() { cancel(); }

  /// record: of the scene the window began with; what is opened later gets the next number. A file that is opened is
  /// remembered (state_folder.hpp).
  void begin(const std::filesystem::path& path, const std::optional<std::filesystem::path>& record);

  /// A session that goes on from what led to a moment (Session::until()), once it has played that: paused.
  /// record: the file its own is named after, if any; where that folder cannot be written, in state_folder().
  void resume(Scene scene, const std::optional<std::filesystem::path>& record,
              std::vector<std::string> comparisons = {});

  bool under_way() const { return result_.valid(); }
  bool is_ready() const;  ///< there is something to take
  /// Of a moment that is gone back to: how much of the way is played, %.
  std::optional<int> progress() const;
  void cancel() { cancelled_ = true; }

  /// What came of it, once: a session, or why there is none; nothing of what was cancelled.
  std::optional<std::variant<OpenScene, std::string>> take();

 private:
  OpenScene reach(Scene scene, const std::optional<std::filesystem::path>& record,
                  std::vector<std::string> comparisons);

  std::atomic<bool> cancelled_{false};
  std::atomic<long> reached_{0};
  long goal_ = 0;  ///< the tick of the moment; 0: a file is opened
  std::future<OpenScene> result_;
};

}  // namespace heml::window
