#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <app/window/state_folder.hpp>
#include <app/window/unsaved_work.hpp>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <heml/base/error.hpp>
#include <heml/base/write_file.hpp>
#include <iterator>
#include <sstream>

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

/// When a program began, s since 1970, to a second; none where the system does not tell.
std::optional<double> start_of(pid_t program) {
  std::ifstream stat(fmt::format("/proc/{}/stat", program)), system("/proc/stat");
  std::string text((std::istreambuf_iterator<char>(stat)), {}), word;
  double boot = 0, ticks = 0;
  for (std::string line; std::getline(system, line);)
    if (line.starts_with("btime ")) boot = std::atof(line.c_str() + 6);
  // Fields after the name, which is in parentheses and may hold spaces: state is the third, the start the 22nd.
  std::istringstream fields(text.substr(std::min(text.rfind(')') + 1, text.size())));
  for (int field = 3; field < 22 && fields >> word; ++field) continue;
  if (!(boot > 0) || !(fields >> ticks)) return std::nullopt;
  return boot + ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

/// Whether the program that wrote a file goes on. Another may have its number since: it began after the file was
/// written.
bool still_runs(pid_t program, const fs::path& file) {
  constexpr double precision = 2;  // s, of both times
  if (kill(program, 0) != 0 && errno == ESRCH) return false;
  struct stat status {};
  const std::optional<double> start = start_of(program);
  return !start || stat(file.c_str(), &status) != 0 || *start < static_cast<double>(status.st_mtime) + precision;
}

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
  if (!changed_ && (std::holds_alternative<Reset>(command) || std::holds_alternative<Release>(command))) return;
  if (!unwritten_) next_ = Clock::now() + save_interval;
  changed_ = unwritten_ = true;
  by_tools_ = by_tools_ || !is_of_a_scene(command);
}

void UnsavedWork::recording_ended() {
  next_ = Clock::now();
  changed_ = by_tools_ = unwritten_ = true;
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
  fs::last_write_time(file(), fs::file_time_type::clock::now(), failed);  // or it would seem to be of another program
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
    if (writer <= 0 || still_runs(writer, entry->path())) continue;
    std::error_code unknown;
    if (!latest || fs::last_write_time(entry->path(), unknown) > fs::last_write_time(*latest, unknown))
      latest = entry->path();
  }
  if (latest && *latest == file()) {  // of an earlier program of this number, as in containers: this one writes there
    const fs::path aside = fs::path(*latest).replace_filename(fmt::format("{}{}-earlier.jsonl", file_stem, getpid()));
    fs::rename(*latest, aside, failed);
    if (!failed) latest = aside;
  }
  return latest;
}

}  // namespace heml::window
