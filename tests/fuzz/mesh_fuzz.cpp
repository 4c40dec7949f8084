// libFuzzer target for mesh readers: the first byte selects the format, the rest is the file.
#include <cstddef>
#include <cstdint>

#include "engine/mesh/any_format.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  heml::read_and_check(data[0] % heml::formats.size(), {reinterpret_cast<const char*>(data) + 1, size - 1});
  return 0;
}
