#include <unistd.h>

#include <app/commands/progress.hpp>
#include <chrono>
#include <cstdio>

namespace heml {

Progress::Progress(std::string what) : what_(std::move(what)), terminal_(isatty(STDERR_FILENO)) {}

Progress::~Progress() {
  if (printed_) std::fprintf(stderr, "\r\033[K");
}

void Progress::show(double fraction, const std::string& doing) {
  if (!terminal_) return;
  const double now = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  if (now - last_ < 0.1) return;
  last_ = now;
  printed_ = true;
  std::fprintf(stderr, "\r\033[Kheml: %s %3.0f %% %s", what_.c_str(), 100 * fraction, doing.c_str());
  std::fflush(stderr);
}

}  // namespace heml
