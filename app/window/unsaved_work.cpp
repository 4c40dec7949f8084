#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <app/window/state_folder.hpp>
#include <app/window/unsaved_work.hpp>
#include <cerrno>
#include <charconv>
#include <heml/base/error.hpp>
#include <heml/base/write_file.hpp>

namespace heml::window {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view file_stem = "unsaved-";
constexpr auto save_interval = std::chrono::seconds(5);

/// Whether a scene file holds what the command did.
bool is_of_a_scene(const Command& command) {
  return std::holds_alternative<SetMaterial>(command) || std::holds_alternative<SetActiveStress>(command) ||
         std::holds_alternative<SetGravity>(command) || std::holds_alternative<SetDamping>(command) ||
         std::holds_alternative<SetIntegrator>(command) || std::holds_alternative<SetRate>(command) ||
         std::holds_alternative<SetBudget>(command) || std::holds_alternative<SetTables>(command) ||
         std::holds_alternative<SetBoundary>(command) || std::holds_alternative<SetLoads>(command) ||
         std::holds_alternative<TagRegion>(command);
}

/// The program that wrote a file, by the file's name; 0: it is another file.
pid_t writer_of(const fs::path& path) {
  const std::string name = path.stem().string();
  pid_t writer = 0;
  if (path.extension() == ".jsonl" && name.starts_with(file_stem))
    std::from_chars(name.data() + file_stem.size(), name.data() + name.size(), writer);
  return writer;
}

bool still_runs(pid_t program) { return kill(program, 0) == 0 || errno != ESRCH; }

/// Returns false if there is too much to write.
bool write_recording(Scene scene, const fs::path& path) {
  try {
    const std::string text = recording_of(std::move(scene), path.parent_path());
    if (text.size() > UnsavedWork::max_bytes) return false;
    fs::create_directories(path.parent_path());
    write_file(path, text);
  } catch (const std::exception&) {  // the file is optional
  }
  return true;
}

}  // namespace

std::string recording_of(Scene scene, const fs::path& folder) {
  const long tick = scene.recorded_ticks.value_or(0);
  scene.checkpoints.clear();
  scene.recorded_end = RecordedEnd{tick, {}, {}, {}, {}};
  return recording_text(scene, folder);
}

fs::path UnsavedWork::file() {
  const fs::path folder = state_folder();
  return folder.empty() ? folder : folder / fmt::format("{}{}.jsonl", file_stem, getpid());
}

void UnsavedWork::done(const Command& command) {
  if (!unwritten_) next_ = Clock::now() + save_interval;
  changed_ = unwritten_ = true;
  by_tools_ = by_tools_ || !is_of_a_scene(command);
}

void UnsavedWork::saved() {
  if (writing_.valid()) writing_.wait();
  writing_ = {};
  std::error_code failed;
  if (changed_) fs::remove(file(), failed);
  changed_ = by_tools_ = unwritten_ = is_full_ = false;
}

void UnsavedWork::scene_saved() {
  if (!by_tools_) saved();
}

void UnsavedWork::adopt(const fs::path& left) {
  std::error_code failed;
  fs::rename(left, file(), failed);
  changed_ = by_tools_ = true;
}

bool UnsavedWork::is_due() const {
  const bool writes = writing_.valid() && writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
  return unwritten_ && !is_full_ && !writes && !file().empty() && Clock::now() >= next_;
}

void UnsavedWork::save(Scene scene) {
  unwritten_ = false;
  if (writing_.valid()) is_full_ = !writing_.get();
  if (is_full_) return;  // the work only grows
  writing_ = std::async(std::launch::async, write_recording, std::move(scene), file());
}

std::optional<fs::path> UnsavedWork::left_behind() {
  std::optional<fs::path> latest;
  std::error_code failed;
  for (fs::directory_iterator entry(state_folder(), failed), end; !failed && entry != end; entry.increment(failed)) {
    const pid_t writer = writer_of(entry->path());
    if (writer <= 0 || still_runs(writer)) continue;
    std::error_code unknown;
    if (!latest || fs::last_write_time(entry->path(), unknown) > fs::last_write_time(*latest, unknown))
      latest = entry->path();
  }
  return latest;
}

}  // namespace heml::window
