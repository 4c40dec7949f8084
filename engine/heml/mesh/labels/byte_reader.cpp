#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <heml/base/error.hpp>
#include <heml/mesh/labels/byte_reader.hpp>

namespace heml {
namespace {

constexpr std::uint64_t max_inflation = 1032;  // of deflate
constexpr std::size_t buffer_size = 1 << 16;

std::uint64_t size_of_plain_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw InputError(path.string(), "", "there is no such file");
  if (!std::filesystem::is_regular_file(status)) throw InputError(path.string(), "", "is not a plain file");
  return std::filesystem::file_size(path);
}

}  // namespace

ByteReader::ByteReader(const std::filesystem::path& path, std::uint64_t offset, bool compressed)
    : file_(path.string()), compressed_(compressed), buffer_(compressed ? buffer_size : 0) {
  const std::uint64_t size = size_of_plain_file(path);
  in_.open(path, std::ios::binary);
  if (!in_) throw InputError(file_, "", "cannot be read", "check the file's permissions");
  left_ = size - std::min(size, offset);
  in_.seekg(static_cast<std::streamoff>(size - left_));
  constexpr int gzip_or_zlib = 15 + 32;
  if (compressed_ && inflateInit2(&stream_, gzip_or_zlib) != Z_OK) throw std::bad_alloc();
}

ByteReader::~ByteReader() {
  if (compressed_) inflateEnd(&stream_);
}

void ByteReader::expect(std::uint64_t bytes) const {
  const std::uint64_t possible = compressed_ ? left_ * max_inflation + buffer_size : left_;
  if (bytes <= possible) return;
  throw InputError(file_, "",
                   fmt::format("its header announces {} bytes of voxels, and {}{} are there", bytes, left_,
                               compressed_ ? " compressed ones" : ""),
                   "the file was cut off, copy it again");
}

std::size_t ByteReader::read_some(std::span<char> to) {
  std::size_t got = 0;
  if (compressed_) {
    got = inflate_some(to);
  } else {
    in_.read(to.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(to.size(), left_)));
    got = static_cast<std::size_t>(in_.gcount());
    left_ -= got;
  }
  delivered_ += got;
  return got;
}

std::size_t ByteReader::inflate_some(std::span<char> to) {
  std::size_t got = 0;
  while (got < to.size() && !ended_) {
    if (stream_.avail_in == 0) {
      in_.read(buffer_.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(buffer_.size(), left_)));
      left_ -= static_cast<std::uint64_t>(in_.gcount());
      if (in_.gcount() == 0) break;
      stream_.next_in = reinterpret_cast<Bytef*>(buffer_.data());
      stream_.avail_in = static_cast<uInt>(in_.gcount());
    }
    const std::size_t wanted = std::min<std::size_t>(to.size() - got, 1u << 30);
    stream_.next_out = reinterpret_cast<Bytef*>(to.data() + got);
    stream_.avail_out = static_cast<uInt>(wanted);
    const int state = inflate(&stream_, Z_NO_FLUSH);
    got += wanted - stream_.avail_out;
    if (state == Z_STREAM_END)
      ended_ = true;
    else if (state != Z_OK)
      throw InputError(file_, fmt::format("byte {} of its inflated data", delivered_ + got),
                       fmt::format("its compressed data are damaged ({})", stream_.msg ? stream_.msg : "zlib"),
                       "copy or save the file again");
  }
  return got;
}

void ByteReader::read(std::span<char> to) {
  while (!to.empty()) {
    const std::size_t got = read_some(to);
    if (got == 0) fail_at_end();
    to = to.subspan(got);
  }
}

void ByteReader::skip(std::uint64_t bytes) {
  std::array<char, 4096> scrap;
  for (; bytes > 0; bytes -= std::min<std::uint64_t>(bytes, scrap.size()))
    read(std::span(scrap).first(static_cast<std::size_t>(std::min<std::uint64_t>(bytes, scrap.size()))));
}

void ByteReader::fail_at_end() const {
  throw InputError(file_, fmt::format("byte {}{}", delivered_, compressed_ ? " of its inflated data" : ""),
                   "the file ends here, in the middle of its header or voxels", "it was cut off, copy it again");
}

bool is_gzip_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return in.get() == 0x1f && in.get() == 0x8b;
}

}  // namespace heml
