#pragma once
// Messages to the user on stderr: "heml: warning: ...". Results go to files and stdout instead.
#include <fmt/format.h>

#include <string>
#include <utility>

namespace heml {

/// Writes "heml: LEVEL: TEXT" to stderr as one line; without LEVEL when it is empty. Thread-safe.
void log_line(const std::string& level, const std::string& text);

/// Reports a problem that does not stop the program.
template <class... Args>
void warn(fmt::format_string<Args...> format, Args&&... args) {
  log_line("warning", fmt::format(format, std::forward<Args>(args)...));
}

/// Reports progress.
template <class... Args>
void log_info(fmt::format_string<Args...> format, Args&&... args) {
  log_line("", fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace heml
