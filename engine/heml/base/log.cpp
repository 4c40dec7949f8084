#include <cstdio>
#include <heml/base/log.hpp>
#include <heml/base/warning_collector.hpp>

namespace heml {

void log_line(const std::string& level, const std::string& text) {
  const std::string line = level.empty() ? fmt::format("heml: {}\n", text) : fmt::format("heml: {}: {}\n", level, text);
  if (level == "warning") WarningCollector::add(text);
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace heml
