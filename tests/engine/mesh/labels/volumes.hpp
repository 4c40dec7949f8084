#pragma once
// Files of label maps, byte by byte, and phantoms.
#include <zlib.h>

#include <array>
#include <bit>
#include <cstring>
#include <filesystem>
#include <heml/mesh/labels/label_map.hpp>
#include <string>

#include "engine/mesh/files.hpp"

namespace heml::test {

/// A file in one folder of this process, removed at the end.
class VolumeFile {
 public:
  VolumeFile(const std::string& name, const std::string& bytes) : path_(folder().file(name, bytes)) {}
  ~VolumeFile() { std::filesystem::remove(path_); }
  VolumeFile(const VolumeFile&) = delete;
  VolumeFile& operator=(const VolumeFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  static const TemporaryFolder& folder() {
    static const TemporaryFolder shared;
    return shared;
  }
  std::filesystem::path path_;
};

/// Puts a number into bytes at a place.
template <class Number>
void put(std::string& bytes, std::size_t at, Number number, bool big = false) {
  std::array<char, sizeof(Number)> raw;
  std::memcpy(raw.data(), &number, sizeof(Number));
  for (std::size_t b = 0; b < raw.size(); ++b) bytes[at + (big ? raw.size() - 1 - b : b)] = raw[b];
}

/// Gzip (16) or zlib (0) of bytes.
inline std::string deflated(const std::string& bytes, int wrapper = 16) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, 15 + wrapper, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, bytes.size()) + 64, '\0');
  std::string in = bytes;
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

/// A cube of n voxels a side and 0.2 m, centred at 0, label(x) of their centres.
template <class Label>
LabelMap phantom(int n, std::vector<int> values, Label label) {
  LabelMap map;
  map.size = {n, n, n};
  map.axes = Mat3::Identity() * (0.2 / n);
  map.origin = Vec3::Constant(-0.1 + 0.1 / n);
  map.values = std::move(values);
  map.source = "phantom";
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        map.voxels.push_back(static_cast<std::uint8_t>(label(Vec3(map.origin + map.axes * Vec3(i, j, k)))));
  return map;
}

}  // namespace heml::test
