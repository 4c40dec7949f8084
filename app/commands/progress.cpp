#include <fmt/format.h>
#include <unistd.h>

#include <app/commands/progress.hpp>
#include <chrono>
#include <cstdio>
#include <utility>

namespace heml {
namespace {

double now_in_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// ", 4 min left"; in the first 3 s and the first hundredth, from which nothing can be estimated, ", for 2 s".
std::string times(double seconds, double fraction) {
  if (seconds < 1 || fraction >= 1) return "";
  if (seconds < 3 || fraction <= 0.01) return fmt::format(", for {:.0f} s", seconds);
  const double rest = seconds / fraction * (1 - fraction);
  return rest < 90 ? fmt::format(", {:.0f} s left", rest) : fmt::format(", {:.0f} min left", rest / 60);
}

}  // namespace

Progress::Progress(std::string what)
    : what_(std::move(what)), terminal_(isatty(STDERR_FILENO)), begin_(now_in_seconds()) {
  if (terminal_) thread_ = std::jthread([this](const std::stop_token& stop) { go_on(stop); });
}

Progress::~Progress() {
  thread_ = {};  // ends it
  clear();
}

void Progress::show(double fraction, const std::string& doing) {
  if (!terminal_) return;
  const std::scoped_lock lock(mutex_);
  fraction_ = fraction;
  doing_ = doing;
  if (const double now = now_in_seconds(); now - last_ >= 0.1) print(now);
}

void Progress::print_result(const std::string& line) {
  const std::scoped_lock lock(mutex_);
  clear();
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

void Progress::print(double now) {
  last_ = now;
  printed_ = true;
  std::fprintf(stderr, "\r\033[Kheml: %s %3.0f %%%s %s", what_.c_str(), 100 * fraction_,
               times(now - begin_, fraction_).c_str(), doing_.c_str());
  std::fflush(stderr);
}

void Progress::clear() {
  if (std::exchange(printed_, false)) std::fprintf(stderr, "\r\033[K");
}

/// The thread that shows that the program is alive.
void Progress::go_on(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    wake_.wait_for(lock, stop, std::chrono::seconds(1), [] { return false; });
    if (const double now = now_in_seconds(); !stop.stop_requested() && now - last_ >= 1) print(now);
  }
}

}  // namespace heml
