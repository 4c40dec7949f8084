#include <unistd.h>

#include <fstream>
#include <heml/studies/machine.hpp>
#include <heml/studies/naive_loops.hpp>
#include <thread>

namespace heml {
namespace {

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) {
      const std::size_t colon = line.find(": ");
      if (colon != std::string::npos) return line.substr(colon + 2);
    }
  return "unknown";
}

std::size_t cache_size([[maybe_unused]] int level) {
#ifdef _SC_LEVEL1_DCACHE_SIZE
  const int names[] = {_SC_LEVEL1_DCACHE_SIZE, _SC_LEVEL2_CACHE_SIZE, _SC_LEVEL3_CACHE_SIZE};
  const long size = sysconf(names[level - 1]);
  if (size > 0) return static_cast<std::size_t>(size);
#endif
  return 0;
}

std::string compiler_name() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#else
  return "GCC " __VERSION__;
#endif
}

}  // namespace

Machine this_machine() {
  return {cpu_model(),   static_cast<int>(std::max(1u, std::thread::hardware_concurrency())),
          cache_size(1), cache_size(2),
          cache_size(3), compiler_name(),
          HEML_FLAGS,    HEML_VERSION,
          naive_flags()};
}

Json to_json(const Machine& m) {
  return {{"cpu", m.cpu},     {"cores", m.cores},     {"L1_bytes", m.L1},
          {"L2_bytes", m.L2}, {"L3_bytes", m.L3},     {"compiler", m.compiler},
          {"flags", m.flags}, {"version", m.version}, {"naive_flags", m.naive_flags}};
}

}  // namespace heml
