// Tests the helper process with shell scripts instead of heml-mesher.
#include <doctest/doctest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <heml/mesh/mesher_process.hpp>

#include "engine/mesh/helpers.hpp"

namespace heml::mesher_process_test {

namespace {

HelperTask task_with(double cpu_seconds, double seconds) {
  return {.subject = "a.obj",
          .doing = "reading it",
          .arguments = {"read"},
          .limits = {.cpu_seconds = cpu_seconds, .seconds = seconds, .bytes = 4e9},
          .remedy = "remedy"};
}

// A child process that runs a helper and waits for it. Both inherit the write end of a pipe, so its end of file shows
// that both have ended.
class Program {
 public:
  Program() {
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    pid_ = fork();
    if (pid_ == 0) {
      for (int signal = 1; signal < 32; ++signal) std::signal(signal, SIG_DFL);
      dup2(ends[1], told_fd);
      close(ends[0]);
      close(ends[1]);
      try {
        run_mesher(task_with(60, 60));
      } catch (...) {
      }
      _exit(0);
    }
    close(ends[1]);
    told_ = ends[0];
  }
  ~Program() { close(told_); }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  static constexpr int told_fd = 9;

  bool has_started() { return is_ready() && read(told_, &byte_, 1) == 1; }
  bool has_ended() { return is_ready() && read(told_, &byte_, 1) == 0; }
  void end_by(int signal) {
    kill(pid_, signal);
    waitpid(pid_, nullptr, 0);
  }

 private:
  bool is_ready() const {
    pollfd told{told_, POLLIN, 0};
    return poll(&told, 1, 20'000) == 1;
  }

  pid_t pid_;
  int told_;
  char byte_ = 0;
};

}  // namespace

TEST_CASE("the helper gets its input and returns its answer through memory") {
  const TemporaryFolder folder, scratch;
  const Environment temporary("TMPDIR", (scratch / "").string());
  const Environment helper("HEML_MESHER", helper_of(folder, "echo noise; ls \"$TMPDIR\" >&2; cat >&3"));
  const std::string text(3'000'000, 'x');
  CHECK(run_mesher(task_with(60, 60), text) == text);
  CHECK(run_mesher(task_with(60, 60)).empty());
}

TEST_CASE("a program that ends in any way takes its helper with it and leaves no file") {
  for (int signal : {SIGTERM, SIGINT, SIGHUP, SIGKILL, SIGSEGV}) {
    CAPTURE(signal);
    const TemporaryFolder folder, scratch;
    const Environment temporary("TMPDIR", (scratch / "").string());
    const Environment helper("HEML_MESHER", helper_of(folder, "printf s >&9; exec sleep 60"));
    Program program;
    REQUIRE(program.has_started());
    program.end_by(signal);
    CHECK(program.has_ended());
    CHECK(std::filesystem::is_empty(scratch / ""));
  }
}

TEST_CASE("the helper's CPU time and wall time are limited") {
  const TemporaryFolder folder;
  const auto told = [&](const char* script, double cpu_seconds, double seconds) {
    const Environment helper("HEML_MESHER", helper_of(folder, script));
    return refusal([&] { run_mesher(task_with(cpu_seconds, seconds)); });
  };
  CHECK(told("while :; do :; done", 0, 600) == "a.obj: reading it takes longer than 0 s (remedy)");
  CHECK(told("exec sleep 600", 600, 0.2) == "a.obj: reading it takes longer than 0.2 s (remedy)");
}

}  // namespace heml::mesher_process_test
