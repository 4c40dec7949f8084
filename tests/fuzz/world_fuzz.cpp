// Plays whole scenes made from seeds (scene_generator.hpp), to show that nothing a scene can say brings the engine
// down: it is recorded, its recording replayed by another number of threads and verified, exported, and solved.
//
//   world_fuzz [--seconds S] [--first SEED] [--cases N] [--keep FOLDER]
//   world_fuzz SCENE.json            plays one file, in this process
//
// A case ends in InputError, in a halt, or well. All else is a failure: a crash, a report of a sanitizer, a leak,
// another exception, more than 1 GB, 30 s of computing that cannot be interrupted, a state that is not finite, a recording that does
// not verify. A failure leaves its scene in FOLDER/SEED.
#include <fmt/format.h>
#include <sanitizer/lsan_interface.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <heml/base/error.hpp>
#include <heml/scenario/explain.hpp>
#include <heml/scenario/frame_series.hpp>
#include <heml/scenario/json_text.hpp>
#include <heml/scenario/recorder.hpp>
#include <heml/scenario/solve.hpp>
#include <heml/scenario/verify.hpp>
#include <sstream>
#include <stdexcept>

#include "scene_generator.hpp"

namespace heml::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

enum class Outcome { played, halted, event_refused, refused, too_long, too_large };
constexpr const char* outcome_names[] = {"played", "halted", "event refused", "refused", "too long", "too large"};

constexpr long max_ticks = 20;
constexpr int max_cells = 200, max_refined = 400;
constexpr int interrupted_after = 3, hangs_after = 30;       // s of the process's computing: others may load the machine
constexpr unsigned stands_still_after = 300;                 // s
constexpr long max_memory = 1 << 20;                         // KiB more than before a batch
constexpr int batch = 20;                                    // cases a process

/// What a case must not end in.
struct Failure : std::logic_error {
  using std::logic_error::logic_error;
};
/// A case that needs more time than it may have.
struct TooLong {};

World* playing = nullptr;  // the world that SIGPROF interrupts

/// Makes a world the one that is played, during its lifetime.
struct Playing {
  explicit Playing(World& world) { playing = &world; }
  ~Playing() { playing = nullptr; }
  Playing(const Playing&) = delete;
  Playing& operator=(const Playing&) = delete;
};

/// Sends SIGPROF once the process has computed for so long; never with 0.
void limit_computing(int seconds) {
  const itimerval limit{{0, 0}, {seconds, 0}};
  setitimer(ITIMER_PROF, &limit, nullptr);
}

/// The first SIGPROF ends the tick under way; the second finds a world that cannot be interrupted, and ends the process.
extern "C" void on_limit(int) {
  std::signal(SIGPROF, SIG_DFL);
  if (playing) playing->interrupt();
  limit_computing(hangs_after - interrupted_after);
}

void expect(bool holds, const std::string& what) {
  if (!holds) throw Failure(what);
}

/// Makes the scene one that is played in a moment; false where it cannot be.
bool limit_work(Scene& scene) {
  SolverSettings& solver = scene.solver;
  solver.duration = std::min(solver.duration, max_ticks * solver.tick());
  solver.threads = std::clamp(solver.threads, 1, 2);
  std::erase_if(scene.output_times, [&](double time) { return time > solver.duration; });
  // Before it plays, a refined scene is solved at rest several times, which nothing interrupts: of quadratic elements
  // half a minute under sanitizers.
  if (solver.quadratic) scene.mesh.refine.reset();
  if (scene.mesh.refine) scene.mesh.refine->tets = std::min(scene.mesh.refine->tets, max_refined);
  if (!scene.mesh.box) return true;
  const auto& [nx, ny, nz] = scene.mesh.box->cells;
  return 1l * nx * ny * nz <= max_cells;
}

void expect_finite(const World& world) {
  for (const auto& list : {world.positions(), world.velocities()})
    for (std::size_t n = 0; n < list.size(); ++n)
      expect(list[n].allFinite(), fmt::format("node {} is not finite after tick {}", n, world.ticks()));
}

void after_tick(const World& world) {
  if (world.unfinished()) throw TooLong{};
  expect_finite(world);
}

void expect_same_when_read_back(const Scene& scene, const fs::path& folder) {
  const std::string written = scene_text(scene, folder);
  std::string again;
  try {
    again = scene_text(parse_scene(written, scene.file), folder);
  } catch (const InputError& error) {
    throw Failure(fmt::format("a scene that was written is refused: {}", error.what()));
  }
  expect(again == written, "a scene that was written reads as another");
}

void export_frames(World& world, const fs::path& folder) {
  for (const char* ending : {"vtu", "ply", "obj"}) write_frame(folder / fmt::format("frame.{}", ending), world);
}

/// Records, and exports what was reached. Whether an event was refused: then the recording has no end.
bool record(const Scene& scene, const fs::path& file, bool& halted) {
  const auto world = load_world(scene);
  const Playing now(*world);
  Recorder recorder(file, scene, *world, 3);
  bool refused = false;
  try {
    halted = replay(scene, *world, after_tick, &recorder).halt.has_value();
  } catch (const InputError&) {
    refused = true;
  }
  expect_finite(*world);
  export_frames(*world, file.parent_path());
  return refused;
}

void expect_verified(const fs::path& file, bool partial) {
  std::optional<Scene> recording;
  try {
    recording = read_scene(file);
    recording->solver.threads = 3 - recording->solver.threads;
    const auto world = load_world(*recording);
    const Playing now(*world);
    const ReplayResult played = replay(*recording, *world, after_tick);
    const Verification verified = verify(*recording, played, partial);
    expect(verified.passed, fmt::format("its recording does not verify: {}", verified.reason));
  } catch (const InputError& error) {
    throw Failure(fmt::format("its recording is refused: {}", error.what()));
  }
}

/// The scene of a text, played in all ways.
Outcome play(const std::string& text, const fs::path& file) {
  const fs::path folder = file.parent_path();
  std::signal(SIGPROF, on_limit);
  limit_computing(interrupted_after);
  alarm(stands_still_after);
  try {
    Scene scene = parse_scene(text, file);
    expect_same_when_read_back(scene, folder);
    if (!limit_work(scene)) return Outcome::too_large;
    bool halted = false;
    const bool refused = record(scene, folder / "recording.jsonl", halted);
    expect_verified(folder / "recording.jsonl", refused);
    explain(scene);
    solve(scene, folder / "out");
    return refused ? Outcome::event_refused : halted ? Outcome::halted : Outcome::played;
  } catch (const InputError& error) {
    const std::string_view message = error.what();
    expect(!message.empty() && message.find('\n') == message.npos, "an error that is not one line");
    return Outcome::refused;
  } catch (const TooLong&) {
    return Outcome::too_long;
  }
}

/// What the processes that play share with the one that watches.
struct Shared {
  std::uint64_t seed;
  std::array<long, std::size(outcome_names)> outcomes;
};

/// Plays seeds [first, end), telling where it is. Its messages go to a file, for the one that finds it dead.
[[noreturn]] void play_batch(std::uint64_t first, std::uint64_t end, const fs::path& folder, Shared& shared) {
  std::freopen((folder / "messages").c_str(), "w", stderr);
  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  for (std::uint64_t seed = first; seed < end; ++seed) {
    shared.seed = seed;
    const std::string text = scene_of_seed(seed);
    std::ofstream(folder / "scene.json") << text << '\n';
    std::freopen((folder / "messages").c_str(), "w", stderr);
    try {
      ++shared.outcomes[static_cast<std::size_t>(play(text, folder / "scene.json"))];
    } catch (const std::exception& error) {
      fmt::print(stderr, "failure: {}\n", error.what());
      std::fflush(stderr);
      _exit(1);
    }
    rusage now{};
    getrusage(RUSAGE_SELF, &now);
    if (now.ru_maxrss - before.ru_maxrss > max_memory) {
      fmt::print(stderr, "failure: {} MiB of memory\n", now.ru_maxrss / 1024);
      std::fflush(stderr);
      _exit(1);
    }
  }
  limit_computing(0);
  alarm(0);
  if (__lsan_do_recoverable_leak_check()) {
    fmt::print(stderr, "failure: a leak in seeds {} to {}\n", first, end - 1);
    std::fflush(stderr);
    _exit(1);
  }
  _exit(0);
}

/// The first line of a process's messages that says what it died of.
std::string cause_of(const fs::path& messages, int status) {
  std::ifstream in(messages);
  for (std::string line; std::getline(in, line);)
    for (const char* word : {"failure: ", "ERROR: ", "runtime error: ", "terminate called", "Assertion", "terminating"})
      if (const auto at = line.find(word); at != line.npos) return line;
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF) return "computes on when interrupted";
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) return "stands still";
  return WIFSIGNALED(status) ? fmt::format("ended by signal {}", WTERMSIG(status))
                             : fmt::format("ended with {}", WEXITSTATUS(status));
}

struct Options {
  double seconds = 20;
  std::uint64_t first = 1, cases = ~0ull >> 1;
  fs::path keep = "world_fuzz_failures";
};

int run(const Options& options) {
  std::string pattern = (fs::temp_directory_path() / "world_fuzz_XXXXXX").string();
  const fs::path folder = mkdtemp(pattern.data());
  write_small_meshes(folder);
  auto& shared =
      *static_cast<Shared*>(mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  const auto begin = Clock::now();
  const std::uint64_t end = options.first + options.cases;
  long failures = 0;
  std::uint64_t next = options.first;
  while (next < end && std::chrono::duration<double>(Clock::now() - begin).count() < options.seconds) {
    const std::uint64_t stop = std::min<std::uint64_t>(next + batch, end);
    const pid_t child = fork();
    if (child == 0) play_batch(next, stop, folder, shared);
    int status = 0;
    waitpid(child, &status, 0);
    next = stop;
    if (status == 0) continue;
    next = shared.seed + 1;
    ++failures;
    const fs::path kept = options.keep / std::to_string(shared.seed);
    fs::create_directories(kept);
    fs::copy(folder, kept, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    fmt::print("FAILED seed {}: {}\n  again: world_fuzz {}\n", shared.seed, cause_of(folder / "messages", status),
               (fs::absolute(kept) / "scene.json").string());
    std::fflush(stdout);
  }
  fs::remove_all(folder);
  fmt::print("{} cases, {} failed;", next - options.first, failures);
  for (std::size_t k = 0; k < std::size(outcome_names); ++k)
    fmt::print(" {} {}{}", shared.outcomes[k], outcome_names[k], k + 1 < std::size(outcome_names) ? "," : "\n");
  return failures > 0;
}

int play_file(const fs::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  fmt::print("{}\n", outcome_names[static_cast<std::size_t>(play(text.str(), file))]);
  return 0;
}

}  // namespace
}  // namespace heml::fuzz

extern "C" const char* __asan_default_options() { return "quarantine_size_mb=32:allocator_may_return_null=0"; }

int main(int argc, char** argv) {
  heml::fuzz::Options options;
  if (argc == 2 && argv[1][0] != '-') return heml::fuzz::play_file(argv[1]);
  for (int k = 1; k + 1 < argc; k += 2) {
    const std::string name = argv[k];
    if (name == "--seconds") options.seconds = std::stod(argv[k + 1]);
    if (name == "--first") options.first = std::stoull(argv[k + 1]);
    if (name == "--cases") options.cases = std::stoull(argv[k + 1]);
    if (name == "--keep") options.keep = argv[k + 1];
  }
  return heml::fuzz::run(options);
}
