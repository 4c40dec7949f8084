#include <fmt/format.h>
#include <unistd.h>

#include <app/commands/progress.hpp>
#include <chrono>
#include <cstdio>

namespace heml {
namespace {

double now_in_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// ", 4 min left"; empty in the first 3 s, which are too short to estimate from.
std::string left(double seconds, double fraction) {
  if (seconds < 3 || fraction <= 0.01 || fraction >= 1) return "";
  const double rest = seconds / fraction * (1 - fraction);
  return rest < 90 ? fmt::format(", {:.0f} s left", rest) : fmt::format(", {:.0f} min left", rest / 60);
}

}  // namespace

Progress::Progress(std::string what)
    : what_(std::move(what)), terminal_(isatty(STDERR_FILENO)), begin_(now_in_seconds()) {}

Progress::~Progress() {
  if (printed_) std::fprintf(stderr, "\r\033[K");
}

void Progress::show(double fraction, const std::string& doing) {
  if (!terminal_) return;
  const double now = now_in_seconds();
  if (now - last_ < 0.1) return;
  last_ = now;
  printed_ = true;
  std::fprintf(stderr, "\r\033[Kheml: %s %3.0f %%%s %s", what_.c_str(), 100 * fraction,
               left(now - begin_, fraction).c_str(), doing.c_str());
  std::fflush(stderr);
}

}  // namespace heml
