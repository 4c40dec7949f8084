// Viewer: work done by hand that no file holds yet is asked about, saved, and restored after a crash.
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <app/window/lost_files.hpp>
#include <app/window/screenshot.hpp>
#include <app/window/viewer.hpp>
#include <ctime>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/base/write_file.hpp>

namespace heml::window {
namespace {

enum WorkAnswer : std::size_t { save, discard };  // the last: cancel
enum LeftAnswer : std::size_t { restore, drop };  // the last: later

std::string time_of(const std::filesystem::path& file) {
  struct stat facts {};
  return stat(file.c_str(), &facts) == 0 ? fmt::format("{:%Y-%m-%d %H:%M}", fmt::localtime(facts.st_mtime))
                                         : std::string();
}

}  // namespace

void Viewer::ask_to_quit() {
  ask_about_work("Save what was done before quitting?", [this] {
    unsaved_.saved();
    quits_ = true;
  });
}

/// Calls `then` once unsaved work is saved or not wanted; not if the question is cancelled. Unwanted work stays until
/// the program ends or another body is there: opening it may fail.
void Viewer::ask_about_work(const std::string& title, std::function<void()> then) {
  changed();
  if (!unsaved_.any()) return then();
  after_question_ = std::move(then);
  panel_->ask(title,
              "What tools and settings did since the start is in no file. Save writes a recording into the working "
              "folder; heml run opens it.",
              {"Save", "Discard", "Cancel"});
}

void Viewer::offer_left_work() {
  left_work_ = UnsavedWork::left_behind();
  if (!left_work_) return;
  panel_->ask("Go on with unsaved work?",
              "heml ended unexpectedly. What was done by hand until " + time_of(*left_work_) + " is in\n" +
                  left_work_->string(),
              {"Restore", "Discard", "Later"});
}

void Viewer::answer(std::size_t which) {
  const auto then = std::exchange(after_question_, nullptr);
  std::error_code failed;
  if (!then) {
    if (which == restore) return restore_work(*left_work_);
    if (which == drop) std::filesystem::remove(*left_work_, failed);
    return;
  }
  if (which > discard || (which == save && !save_work())) return;
  if (which == save) unsaved_.saved();
  then();
}

/// Writes a recording of all that was done into the working folder. Returns whether it could.
bool Viewer::save_work() {
  try {
    const auto path = unused_path(open_.scene.name, ".jsonl");
    Scene scene = open_.session->until(*live_);
    const std::string lost = keep_lost_files(scene);
    write_file(path, recording_of(std::move(scene), path.parent_path()));
    log_info("what was done is in {}{}", path.string(), lost);
    notify_saved("Saved " + path.string() + lost, path.parent_path());
    return true;
  } catch (const InputError& error) {
    panel_->show_error("Could not be saved", error.what());
    return false;
  }
}

void Viewer::restore_work(const std::filesystem::path& file) {
  if (session_loader_.is_busy()) return panel_->notify("Another session is being opened.");
  try {
    panel_->notify("Restoring …");
    run_after_resume_ = false;
    session_loader_.resume(read_scene(file), std::nullopt);
    restores_ = true;
  } catch (const InputError& error) {
    panel_->show_error("Could not be opened", error.what());
  }
}

}  // namespace heml::window
