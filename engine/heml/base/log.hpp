#pragma once
// Messages for people, on stderr: "heml: warning: ...". Results go to files and stdout, never through here.
#include <fmt/format.h>

#include <string>
#include <utility>

namespace heml {

/// One line on stderr. Any thread.
void log_line(const std::string& level, const std::string& text);

/// Something the user should know and that does not stop the work.
template <class... Args>
void warn(fmt::format_string<Args...> format, Args&&... args) {
  log_line("warning", fmt::format(format, std::forward<Args>(args)...));
}

/// What the program is doing; silenced by set_quiet().
template <class... Args>
void log_info(fmt::format_string<Args...> format, Args&&... args) {
  log_line("", fmt::format(format, std::forward<Args>(args)...));
}

/// Hides inform(), keeps warnings.
void set_quiet(bool quiet);

}  // namespace heml
