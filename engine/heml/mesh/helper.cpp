#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <heml/base/error.hpp>
#include <heml/mesh/helper.hpp>

namespace heml {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* name = "heml-mesher";
constexpr int cannot_start = 127;  // as shells have it; also the dynamic linker's

#ifdef HEML_SANITIZED
constexpr bool limits_memory = false;  // sanitizers reserve terabytes of addresses
#else
constexpr bool limits_memory = true;
#endif

// $HEML_MESHER, beside this program, in the folders for programs' programs, in the build tree; empty when nowhere.
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

// In the child, between fork and exec: only calls that are safe there.
[[noreturn]] void become_helper(char* const* arguments, int output, const HelperLimits& limits) {
  const auto limit = [](auto resource, double value) {
    const rlimit both{static_cast<rlim_t>(value), static_cast<rlim_t>(value)};
    setrlimit(resource, &both);
  };
  limit(RLIMIT_CPU, std::ceil(limits.seconds) + 1);
  limit(RLIMIT_CORE, 0);
  if (limits_memory) limit(RLIMIT_AS, limits.bytes);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  execv(arguments[0], arguments);
  _exit(cannot_start);
}

struct Ending {
  int status = 0;
  bool timed_out = false;
  std::string text;  ///< the beginning of what it printed
};

// Collects what the helper prints until it ends or its time is over, which ends it.
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
    ending.text.append(buffer, std::min<std::size_t>(count, longest - std::min(longest, ending.text.size())));
  }
  while (waitpid(helper, &ending.status, 0) < 0 && errno == EINTR) continue;
  return ending;
}

Ending run(const std::filesystem::path& helper, const std::vector<std::string>& arguments, const HelperLimits& limits) {
  std::vector<std::string> words{helper.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(fmt::format("pipe: {}", std::strerror(errno)));
  const pid_t child = fork();
  if (child == 0) become_helper(pointers.data(), ends[1], limits);
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    throw std::runtime_error(fmt::format("fork: {}", std::strerror(errno)));
  }
  Ending ending = wait_for(child, ends[0], limits.seconds);
  close(ends[0]);
  return ending;
}

// The helper's last line, as one message may hold it.
std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  text.erase(0, text.find_last_of('\n') + 1);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = '?';
  return text.empty() ? "the helper gave no reason" : text;
}

}  // namespace

ScratchFolder::ScratchFolder() {
  std::error_code error;
  std::string place = (std::filesystem::temp_directory_path(error) / "heml-XXXXXX").string();
  if (error || !mkdtemp(place.data()))
    throw InputError(place, "", fmt::format("cannot make a temporary folder: {}", std::strerror(errno)), "set TMPDIR");
  path_ = place;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void run_helper(const std::string& subject, const std::vector<std::string>& arguments, const HelperLimits& limits) {
  const std::filesystem::path helper = find_helper();
  if (helper.empty())
    throw InputError(subject, "", "this program reads tetrahedral meshes only: its helper heml-mesher is not there",
                     "build with HEML_ASSIMP and HEML_TETGEN on, or set HEML_MESHER to where it is");
  const Ending ending = run(helper, arguments, limits);
  if (ending.timed_out || (WIFSIGNALED(ending.status) && WTERMSIG(ending.status) == SIGXCPU))
    throw InputError(subject, "", fmt::format("filling or reading it takes longer than {} s", limits.seconds),
                     "a coarser surface, a larger radius_edge_ratio or max_volume");
  if (WIFSIGNALED(ending.status))
    throw InputError(subject, "",
                     fmt::format("the mesher cannot handle it (signal {}, {})", WTERMSIG(ending.status),
                                 strsignal(WTERMSIG(ending.status))),
                     "repair or simplify the surface");
  if (WEXITSTATUS(ending.status) == cannot_start)
    throw InputError(subject, "", fmt::format("the helper {} cannot be started", helper.string()),
                     last_line(ending.text));
  if (WEXITSTATUS(ending.status) != 0) throw InputError(subject, "", last_line(ending.text));
}

}  // namespace heml
