#include <fmt/format.h>

#include <app/window/glfw_window.hpp>
#include <app/window/opening.hpp>
#include <chrono>
#include <cstdlib>

namespace heml::window {
namespace {

/// Where the last recovery of a scene is kept: in the user's folder for what programs did, if there is one.
std::filesystem::path recovery_file_of(const Scene& scene) {
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  if (!state && !home) return {};
  const std::filesystem::path folder =
      state && *state ? std::filesystem::path(state) : std::filesystem::path(home) / ".local" / "state";
  return folder / "heml" / fmt::format("recovery-{}.jsonl", std::filesystem::path(scene.file).stem().string());
}

}  // namespace

OpenScene start(Scene scene, const std::optional<std::filesystem::path>& record, int number) {
  SessionOptions options;
  options.record = record;
  options.recovery_file = recovery_file_of(scene);
  if (record && number > 1)
    options.record->replace_filename(
        fmt::format("{}-{}{}", record->stem().string(), number, record->extension().string()));
  options.on_frame = [] { GlfwWindow::wake(); };
  OpenScene result{std::move(scene), nullptr};
  result.session = std::make_unique<Session>(result.scene, options);
  return result;
}

void Opening::begin(const std::filesystem::path& path, const std::optional<std::filesystem::path>& record) {
  if (under_way()) return;
  result_ = std::async(std::launch::async, [path, record, number = number_ + 1] {
    struct Wake {
      ~Wake() { GlfwWindow::wake(); }
    } wake_at_end;
    return start(read_scene(path), record, number);
  });
}

std::optional<std::variant<OpenScene, std::string>> Opening::take() {
  if (!under_way() || result_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
  try {
    OpenScene opened = result_.get();
    ++number_;
    return opened;
  } catch (const std::exception& error) {
    return std::string(error.what());
  }
}

}  // namespace heml::window
