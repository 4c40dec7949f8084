#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <app/render/png.hpp>
#include <app/window/glfw_window.hpp>
#include <app/window/lost_files.hpp>
#include <app/window/session_loader.hpp>
#include <app/window/state_folder.hpp>
#include <chrono>
#include <heml/base/warning_collector.hpp>
#include <heml/scenario/skin.hpp>
#include <thread>

namespace heml::window {
namespace {

namespace fs = std::filesystem;

/// File of the last recovery of a scene, in state_folder(); empty if there is none.
fs::path recovery_file_of(const Scene& scene) {
  const fs::path folder = state_folder();
  return folder.empty() ? folder : folder / fmt::format("recovery-{}.jsonl", fs::path(scene.file).stem().string());
}

SessionOptions options_for(const Scene& scene, const std::optional<fs::path>& record) {
  SessionOptions options;
  options.record = record;
  options.recovery_file = recovery_file_of(scene);
  options.on_frame = [] { GlfwWindow::wake(); };
  return options;
}

/// A working folder that was removed seems writable, but has no path any more.
bool can_be_written(const fs::path& folder) {
  std::error_code failed;
  const fs::path whole = fs::canonical(folder.empty() ? "." : folder, failed);
  return !failed && access(whole.c_str(), W_OK) == 0;
}

/// What scene_around() chose, and other warnings on the way to a session, each once and without the file's path.
std::vector<std::string> findings_of(const Scene& scene, const std::vector<std::string>& warnings) {
  std::vector<std::string> findings;
  if (scene.chosen)
    for (const BareMeshChoices::Text& choice : scene.chosen->texts) findings.push_back(choice.text);
  for (std::string text : warnings) {
    if (text.starts_with(scene.file + ": ")) text.erase(0, scene.file.size() + 2);
    if (std::find(findings.begin(), findings.end(), text) == findings.end()) findings.push_back(std::move(text));
  }
  return findings;
}

/// A texture is read when it is first drawn, where nothing can be refused: it is tried here. Throws InputError.
void try_texture(const Frame& frame) {
  if (frame.skin && !frame.skin->surface.texture.empty()) render::read_png(frame.skin->surface.texture);
}

struct WakeAtEnd {
  ~WakeAtEnd() { GlfwWindow::wake(); }
};

}  // namespace

fs::path next_recording(const fs::path& file) {
  std::error_code failed;
  for (int number = 2;; ++number) {
    const fs::path next = file.parent_path() / fmt::format("{}-{}.jsonl", file.stem().string(), number);
    if (!fs::exists(next, failed)) return next;
  }
}

OpenScene start(Scene scene, const std::optional<fs::path>& record, std::vector<std::string> comparisons,
                std::vector<std::string> warnings) {
  OpenScene result{std::move(scene), {}, nullptr, record, false, std::move(comparisons), {}};
  if (record) result.file = RecordingFile(*record, result.scene);
  const WarningCollector further;
  hold_files(result.scene);
  result.was_recorded = result.scene.recorded_ticks.has_value();
  SessionOptions options = options_for(result.scene, record);
  options.comparisons = result.comparisons;
  result.session = std::make_unique<Session>(result.scene, options);
  try_texture(result.session->latest());
  warnings.insert(warnings.end(), further.texts().begin(), further.texts().end());
  result.findings = findings_of(result.scene, warnings);
  return result;
}

void SessionLoader::begin(const fs::path& path, const std::optional<fs::path>& record, const BareMeshOptions& options,
                          std::vector<std::string> comparisons) {
  if (is_busy()) return;
  target_tick_ = 0;
  cancelled_ = false;
  result_ = std::async(std::launch::async, [path, record, options, comparisons = std::move(comparisons)]() mutable {
    const WakeAtEnd wake_at_end;
    const WarningCollector warnings;
    Scene scene = read_scene(path, options);
    OpenScene opened = start(std::move(scene), record ? std::optional(next_recording(*record)) : std::nullopt,
                             std::move(comparisons), warnings.texts());
    remember_file(path);
    return opened;
  });
}

void SessionLoader::resume(Scene scene, const std::optional<fs::path>& record, std::vector<std::string> comparisons) {
  if (is_busy()) return;
  target_tick_ = std::max(1l, scene.recorded_ticks.value_or(0));
  replayed_tick_ = 0;
  cancelled_ = false;
  result_ = std::async(std::launch::async,
                       [this, scene = std::move(scene), record, comparisons = std::move(comparisons)]() mutable {
                         const WakeAtEnd wake_at_end;
                         return replay_to(std::move(scene), record, std::move(comparisons));
                       });
}

OpenScene SessionLoader::replay_to(Scene scene, const std::optional<fs::path>& record,
                                   std::vector<std::string> comparisons) {
  std::optional<fs::path> file;
  if (record) file = next_recording(*record);
  if (file && !can_be_written(file->parent_path()) && !state_folder().empty()) {
    fs::create_directories(state_folder());
    file = next_recording(state_folder() / record->filename());
  }
  const long target_tick = scene.recorded_ticks.value_or(0);
  SessionOptions options = options_for(scene, file);
  options.start_paused = true;
  options.fast_forward_to = target_tick;
  options.comparisons = comparisons;
  OpenScene result{std::move(scene), {}, nullptr, file, record.has_value(), std::move(comparisons), target_tick};
  if (file) result.file = RecordingFile(*file, result.scene);
  hold_files(result.scene);
  result.session = std::make_unique<Session>(result.scene, options);
  while (!cancelled_) {
    const Frame& frame = result.session->latest();
    replayed_tick_ = frame.tick;
    if (frame.fast_forward_target == 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return result;
}

bool SessionLoader::is_ready() const {
  return is_busy() && result_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::optional<int> SessionLoader::progress() const {
  if (!is_busy() || target_tick_ == 0) return std::nullopt;
  return static_cast<int>(100 * replayed_tick_ / target_tick_);
}

std::optional<std::variant<OpenScene, std::string>> SessionLoader::take() {
  if (!is_ready()) return std::nullopt;
  try {
    OpenScene opened = result_.get();
    if (!cancelled_) return opened;
    std::error_code failed;
    if (opened.resumed && opened.recording) {  // the file has only the replayed part
      opened.session.reset();
      fs::remove(*opened.recording, failed);
    }
    return std::nullopt;
  } catch (const std::exception& error) {
    if (cancelled_) return std::nullopt;
    return std::string(error.what());
  }
}

}  // namespace heml::window
