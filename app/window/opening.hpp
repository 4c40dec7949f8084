#pragma once
// Scenes and the sessions they run in; those dropped onto the window are read beside the running one.
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
};

/// Starts the session of a scene, with a window that is woken by its frames.
/// record: where; of the second scene and later ones the number goes into the name. Throws InputError.
OpenScene start(Scene scene, const std::optional<std::filesystem::path>& record, int number);

/// A file on its way to being a session.
class Opening {
 public:
  void begin(const std::filesystem::path& path, const std::optional<std::filesystem::path>& record);
  bool under_way() const { return result_.valid(); }

  /// What came of it, once: a session, or why there is none.
  std::optional<std::variant<OpenScene, std::string>> take();

 private:
  int number_ = 1;  ///< of scenes so far
  std::future<OpenScene> result_;
};

}  // namespace heml::window
