#include <atomic>
#include <cstdio>
#include <heml/base/log.hpp>

namespace heml {
namespace {
std::atomic<bool> quiet_mode{false};
}

void log_line(const std::string& level, const std::string& text) {
  if (level.empty() && quiet_mode) return;
  const std::string line = level.empty() ? fmt::format("heml: {}\n", text) : fmt::format("heml: {}: {}\n", level, text);
  std::fwrite(line.data(), 1, line.size(), stderr);
}

void set_quiet(bool quiet) { quiet_mode = quiet; }

}  // namespace heml
