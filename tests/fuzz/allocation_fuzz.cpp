// Makes worlds of scenes from seeds (scene_generator.hpp) and steps them with one allocation failing, the n-th for many
// n: this ends in std::bad_alloc or InputError, or goes well, and the sanitizers find neither a leak nor worse. A
// program of its own, since it replaces operator new. The text is read before: the JSON library allocates in its
// destructors and does not survive a failure.
//
//   allocation_fuzz [--seconds S] [--first SEED] [--cases N]
#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <heml/base/error.hpp>
#include <heml/scenario/scene.hpp>
#include <new>

#include "scene_generator.hpp"

namespace {

std::atomic<long> allowed{-1};  // allocations until one fails; negative: none does
std::atomic<long> made{0};

void* allocate(std::size_t bytes, std::size_t alignment) {
  ++made;
  if (allowed >= 0 && allowed-- == 0) return nullptr;
  bytes = std::max<std::size_t>(bytes, 1);
  return alignment ? std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment)
                   : std::malloc(bytes);
}

void* allocate_or_throw(std::size_t bytes, std::size_t alignment) {
  if (void* memory = allocate(bytes, alignment)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t bytes) { return allocate_or_throw(bytes, 0); }
void* operator new[](std::size_t bytes) { return allocate_or_throw(bytes, 0); }
void* operator new(std::size_t bytes, std::align_val_t a) { return allocate_or_throw(bytes, std::size_t(a)); }
void* operator new[](std::size_t bytes, std::align_val_t a) { return allocate_or_throw(bytes, std::size_t(a)); }
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return allocate(bytes, 0); }
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept { return allocate(bytes, 0); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { std::free(memory); }

namespace heml::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

enum class Outcome { loaded, refused, out_of_memory };

long failing = -1;        // the allocation that fails now, for whoever sees the program end
std::uint64_t tried = 1;  // the seed

[[noreturn]] void tell_and_end() {
  allowed = -1;
  fmt::print(stderr, "failure: terminated as allocation {} of seed {} failed\n", failing, tried);
  std::abort();
}

/// Makes the scene's world and steps it with the n-th allocation failing; n < 0: none.
Outcome load(const Scene& scene, long n) {
  failing = n;
  made = 0;
  allowed = n;
  Outcome outcome = Outcome::loaded;
  try {
    const std::unique_ptr<World> world = load_world(scene);
    for (const Event& event : scene.events)
      if (!world->halt()) static_cast<void>(world->apply(event.command));
    for (int tick = 0; tick < 2 && !world->halt(); ++tick) world->tick();
  } catch (const InputError&) {
    outcome = Outcome::refused;
  } catch (const std::bad_alloc&) {
    outcome = Outcome::out_of_memory;
  }
  allowed = -1;
  return outcome;
}

int run(double seconds, std::uint64_t cases) {
  std::set_terminate(tell_and_end);
  std::string pattern = (fs::temp_directory_path() / "allocation_fuzz_XXXXXX").string();
  const fs::path folder = mkdtemp(pattern.data());
  write_small_meshes(folder);
  const auto begin = Clock::now();
  const auto over = [&] { return std::chrono::duration<double>(Clock::now() - begin).count() >= seconds; };
  long scenes = 0, loads = 0, ended = 0;
  const std::uint64_t end = tried + cases;
  for (; tried < end && !over(); ++tried) {
    const std::string text = scene_of_seed(tried);
    const fs::path file = folder / "scene.json";
    Scene scene;
    try {
      scene = parse_scene(text, file);
    } catch (const InputError&) {
      continue;
    }
    scene.solver.threads = 1;
    if (load(scene, -1) != Outcome::loaded) continue;  // also fills what is read once
    load(scene, -1);
    const long count = made;
    ++scenes;
    const long stride = 1 + count / 60;
    for (long n = static_cast<long>(tried) % stride; n < count && !over(); n += stride, ++loads)
      ended += load(scene, n) == Outcome::out_of_memory;
  }
  fs::remove_all(folder);
  fmt::print("{} scenes made {} times with an allocation failing; {} ended by it\n", scenes, loads, ended);
  return ended == 0;
}

}  // namespace
}  // namespace heml::fuzz

int main(int argc, char** argv) {
  double seconds = 10;
  std::uint64_t cases = ~0ull >> 1;
  for (int k = 1; k + 1 < argc; k += 2) {
    const std::string name = argv[k];
    if (name == "--seconds") seconds = std::stod(argv[k + 1]);
    if (name == "--first") heml::fuzz::tried = std::stoull(argv[k + 1]);
    if (name == "--cases") cases = std::stoull(argv[k + 1]);
  }
  return heml::fuzz::run(seconds, cases);
}
