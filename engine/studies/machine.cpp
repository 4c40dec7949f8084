#include <fstream>
#include <heml/scenario/build_identity.hpp>
#include <sstream>
#include <studies/machine.hpp>
#include <studies/naive_loops.hpp>
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

/// Size of the data cache of a level, bytes, from Linux's sysfs; 0: unknown.
std::size_t cache_size(int level) {
  const auto word = [](int index, const char* what) {
    std::ifstream file("/sys/devices/system/cpu/cpu0/cache/index" + std::to_string(index) + "/" + what);
    std::string text;
    file >> text;
    return text;
  };
  for (int index = 0; index < 8; ++index) {
    if (word(index, "level") != std::to_string(level) || word(index, "type") == "Instruction") continue;
    std::istringstream size(word(index, "size"));
    std::size_t count = 0;
    char unit = ' ';
    size >> count >> unit;
    return count << (unit == 'K' ? 10 : unit == 'M' ? 20 : 0);
  }
  return 0;
}

}  // namespace

Machine this_machine() {
  return {cpu_model(),   static_cast<int>(std::max(1u, std::thread::hardware_concurrency())),
          cache_size(1), cache_size(2),
          cache_size(3), compiler_name(),
          HEML_FLAGS,    HEML_VERSION,
          naive_flags(), HEML_COMMIT};
}

Json to_json(const Machine& m) {
  return {{"cpu", m.cpu},      {"cores", m.cores},     {"L1_bytes", m.L1},
          {"L2_bytes", m.L2},  {"L3_bytes", m.L3},     {"compiler", m.compiler},
          {"flags", m.flags},  {"version", m.version}, {"naive_flags", m.naive_flags},
          {"commit", m.commit}};
}

}  // namespace heml
