#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <heml/base/error.hpp>
#include <heml/mesh/mesher_process.hpp>
#include <stdexcept>

namespace heml {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* name = "heml-mesher";
constexpr int out_of_memory = 2;   // exit code of the helper (mesher/main.cpp)
constexpr int cannot_start = 127;  // exit code of shells and the dynamic linker
constexpr int answer_fd = 3;       // stdout and stderr are for messages

#ifdef HEML_SANITIZED
constexpr bool limits_memory = false;  // sanitizers reserve terabytes of address space
#else
constexpr bool limits_memory = true;
#endif

// Searches $HEML_MESHER alone if it is set; else this program's folder, ../libexec/heml, ../lib/heml and the build
// tree. Empty if not found.
std::filesystem::path find_helper() {
  std::vector<std::filesystem::path> places;
  std::error_code error;
  if (const char* given = std::getenv("HEML_MESHER")) {
    places = {given};
  } else {
    const auto folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
    places = {folder / name, folder / "../libexec/heml" / name, folder / "../lib/heml" / name};
#ifdef HEML_BUILT_MESHER
    places.emplace_back(HEML_BUILT_MESHER);
#endif
  }
  for (const auto& place : places)
    if (std::filesystem::is_regular_file(place, error) && access(place.c_str(), X_OK) == 0) return place;
  return {};
}

[[noreturn]] void fail_in(const char* call) {
  throw std::runtime_error(fmt::format("{}: {}", call, std::strerror(errno)));
}

// An anonymous file in memory: freed when the last process closes it.
class MemoryFile {
 public:
  MemoryFile() : fd_(memfd_create(name, MFD_CLOEXEC)) {
    if (fd_ < 0) fail_in("memfd_create");
  }
  ~MemoryFile() { close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  int fd() const { return fd_; }

  /// Writes at offset 0 and leaves the file position there, where the helper starts reading.
  void put(std::string_view text) {
    for (off_t at = 0; !text.empty();) {
      const ssize_t count = pwrite(fd_, text.data(), text.size(), at);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) fail_in("write");
      at += count;
      text.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  std::string contents() const {
    std::string text(static_cast<std::size_t>(std::max<off_t>(lseek(fd_, 0, SEEK_END), 0)), '\0');
    for (std::size_t at = 0; at < text.size();) {
      const ssize_t count = pread(fd_, text.data() + at, text.size() - at, static_cast<off_t>(at));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) fail_in("read");
      at += static_cast<std::size_t>(count);
    }
    return text;
  }

 private:
  int fd_;
};

// Descriptors that become the child's streams.
struct Streams {
  int input, words, answer;
};

// Runs in the child between fork and exec: only async-signal-safe calls.
[[noreturn]] void exec_helper(char* const* arguments, Streams from, pid_t parent, const ProcessLimits& limits) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(cannot_start);  // the parent ended before prctl()
  const auto limit = [](auto resource, double value, rlim_t grace = 0) {
    const rlimit both{static_cast<rlim_t>(value), static_cast<rlim_t>(value) + grace};
    setrlimit(resource, &both);
  };
  limit(RLIMIT_CPU, std::ceil(limits.cpu_seconds) + 1, 1);  // SIGXCPU first: at the hard limit it is SIGKILL
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, limits.bytes);  // bounds the answer, a file in memory
  if (limits_memory) limit(RLIMIT_AS, limits.bytes);
  for (int* fd : {&from.input, &from.words, &from.answer}) *fd = fcntl(*fd, F_DUPFD_CLOEXEC, answer_fd + 1);
  dup2(from.input, STDIN_FILENO);
  dup2(from.words, STDOUT_FILENO);
  dup2(from.words, STDERR_FILENO);
  dup2(from.answer, answer_fd);
  execv(arguments[0], arguments);
  _exit(cannot_start);
}

struct Ending {
  int status = 0;
  bool timed_out = false;
  std::string words;  ///< beginning of its output
};

std::atomic<pid_t> running_helper{0};

// Collects the helper's output until it ends; kills it after the wall time `seconds`.
Ending wait_for(pid_t helper, int output, double seconds) {
  constexpr std::size_t longest = 4096;
  Ending ending;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  for (;;) {
    const double left = std::chrono::duration<double, std::milli>(end - Clock::now()).count();
    pollfd ready{output, POLLIN, 0};
    const int events = left <= 0 ? 0 : poll(&ready, 1, static_cast<int>(std::min(left + 1, 1e6)));
    if (events < 0 && errno == EINTR) continue;
    if (events == 0 && left > 1e6) continue;
    if (events <= 0) {
      ending.timed_out = true;
      kill(helper, SIGKILL);
      break;
    }
    char buffer[1024];
    const ssize_t count = read(output, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    ending.words.append(buffer, std::min<std::size_t>(count, longest - std::min(longest, ending.words.size())));
  }
  while (waitpid(helper, &ending.status, 0) < 0 && errno == EINTR) continue;
  running_helper = 0;
  return ending;
}

Ending run(const std::filesystem::path& helper, const HelperTask& task, const MemoryFile& input,
           const MemoryFile& answer) {
  std::vector<std::string> words{helper.string()};
  words.insert(words.end(), task.arguments.begin(), task.arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail_in("pipe");
  const pid_t parent = getpid(), child = fork();
  if (child == 0) exec_helper(pointers.data(), {input.fd(), ends[1], answer.fd()}, parent, task.limits);
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    fail_in("fork");
  }
  running_helper = child;
  Ending ending = wait_for(child, ends[0], task.limits.seconds);
  close(ends[0]);
  return ending;
}

// The last line of the helper's output, with control characters replaced.
std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  text.erase(0, text.find_last_of('\n') + 1);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = '?';
  return text.empty() ? "the helper gave no reason" : text;
}

}  // namespace

void kill_helper() {
  const pid_t helper = running_helper.exchange(0);
  if (helper <= 0) return;
  kill(helper, SIGKILL);
  waitpid(helper, nullptr, 0);
}

std::string run_mesher(const HelperTask& task, std::string_view input) {
  const std::filesystem::path helper = find_helper();
  if (helper.empty())
    throw InputError(task.subject, "",
                     "this program reads tetrahedral meshes only: its helper heml-mesher is not there",
                     "build with HEML_ASSIMP and HEML_TETGEN on, or set HEML_MESHER to where it is");
  MemoryFile request, answer;
  request.put(input);
  const Ending ending = run(helper, task, request, answer);
  const auto refuse = [&](const std::string& problem) {
    throw InputError(task.subject, "", task.doing + " " + problem, task.remedy);
  };
  if (ending.timed_out) refuse(fmt::format("takes longer than {} s", task.limits.seconds));
  if (WIFSIGNALED(ending.status)) {
    const int signal = WTERMSIG(ending.status);
    if (signal == SIGXCPU) refuse(fmt::format("takes longer than {} s", task.limits.cpu_seconds));
    throw MesherFailure(task.subject, "",
                        fmt::format("the mesher cannot handle it (signal {}, {})", signal, strsignal(signal)),
                        "repair or simplify the surface");
  }
  const int code = WEXITSTATUS(ending.status);
  if (code == out_of_memory) refuse(fmt::format("takes more than {:.0f} MB of memory", task.limits.bytes / 1e6));
  if (code == cannot_start)
    throw InputError(task.subject, "", fmt::format("the helper {} cannot be started", helper.string()),
                     last_line(ending.words));
  if (code != 0) throw MesherFailure(task.subject, "", last_line(ending.words));
  return answer.contents();
}

}  // namespace heml
