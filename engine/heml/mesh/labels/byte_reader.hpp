#pragma once
// Reads the bytes of a file in order, inflated where they are compressed. Memory: two small buffers.
#include <zlib.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <vector>

namespace heml {

class ByteReader {
 public:
  /// offset: of the first byte in the file. compressed: a gzip or zlib stream begins there. Throws InputError for a
  /// file that cannot be read.
  ByteReader(const std::filesystem::path& path, std::uint64_t offset, bool compressed);
  ~ByteReader();
  ByteReader(const ByteReader&) = delete;
  ByteReader& operator=(const ByteReader&) = delete;

  /// Throws InputError unless the file can hold so many bytes more. Call before taking memory for them.
  void expect(std::uint64_t bytes) const;

  /// As many bytes as are left, up to all of `to`. Throws InputError for a damaged stream.
  std::size_t read_some(std::span<char> to);
  /// All of `to`. Throws InputError where the file ends before.
  void read(std::span<char> to);
  void skip(std::uint64_t bytes);

 private:
  std::size_t inflate_some(std::span<char> to);
  [[noreturn]] void fail_at_end() const;

  std::string file_;
  std::ifstream in_;
  std::uint64_t left_ = 0;       ///< bytes of the file from the offset
  std::uint64_t delivered_ = 0;  ///< bytes read so far
  bool compressed_, ended_ = false;
  z_stream stream_{};
  std::vector<char> buffer_;
};

/// Whether the file begins as gzip streams do.
bool is_gzip_file(const std::filesystem::path& path);

}  // namespace heml
