// The program: its commands (commands/), and what becomes of errors and signals.
#include <fmt/format.h>

#include <app/commands/command_line.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <heml/base/error.hpp>
#include <heml/base/log.hpp>
#include <heml/mesh/mesher_process.hpp>

namespace heml {
namespace {

/// Runs the program; turns exceptions into messages and exit codes.
int guarded_run(int argc, char** argv) {
  try {
    return run_command_line(argc, argv);
  } catch (const InputError& error) {
    log_line("error", error.what());
    return exit_input;
  } catch (const UsageError& error) {
    log_line("error", error.what());
    return exit_usage;
  } catch (const std::exception& error) {
    if (std::ferror(stdout)) return exit_done;  // of a print: flushed_output() reports it
    log_line("internal error", error.what());
    return exit_internal;
  }
}

/// Flushes stdout. If that fails, reports it once and returns exit_input, or `code` if that is an error already.
int flushed_output(int code) {
  errno = 0;
  const bool failed = std::fflush(stdout) != 0;
  if (!failed && !std::ferror(stdout)) return code;
  log_line("error",
           fmt::format("standard output: cannot be written{}{} (check where it goes, and the space left there)",
                       errno ? ": " : "", errno ? std::strerror(errno) : ""));
  return code == exit_done ? exit_input : code;
}

void end_by_signal(int signal) {
  kill_helper();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// Signals that end the program end the mesher's process first. Ignored signals (nohup) stay ignored.
void handle_signals() {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM})
    if (std::signal(signal, end_by_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
}

}  // namespace
}  // namespace heml

int main(int argc, char** argv) {
  heml::handle_signals();
  return heml::flushed_output(heml::guarded_run(argc, argv));
}
