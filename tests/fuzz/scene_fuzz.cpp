// libFuzzer target: any bytes parse as a scene or throw InputError.
#include <cstddef>
#include <cstdint>
#include <heml/base/error.hpp>
#include <heml/scenario/scene.hpp>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    heml::scene_line(heml::parse_scene(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.json"));
  } catch (const heml::InputError&) {
  }
  return 0;
}
