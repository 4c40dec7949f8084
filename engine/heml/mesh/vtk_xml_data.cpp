#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <heml/mesh/binary_values.hpp>
#include <heml/mesh/vtk_xml_data.hpp>
#include <vector>

namespace heml {
namespace {

constexpr std::size_t max_inflation = 1032;      // of deflate
constexpr std::uint64_t max_bytes = 1ull << 40;  // keeps sums of sizes far from overflow

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// Gives bytes of raw or base64 text in order.
class VtkByteStream {
 public:
  VtkByteStream(std::string_view text, bool base64, const Scanner& in, const std::string& what)
      : text_(text), base64_(base64), in_(in), what_(what) {}

  /// Fails unless so many bytes may follow; call it before memory is taken for them.
  void expect(std::uint64_t bytes) const {
    const std::size_t left = text_.size() - at_, possible = base64_ ? left / 4 * 3 + pending_.size() : left;
    if (bytes <= possible) return;
    fail(fmt::format("should hold {} bytes more, at most {} are there", bytes, possible));
  }

  std::string read(std::uint64_t bytes) {
    expect(bytes);
    const auto count = static_cast<std::size_t>(bytes);
    if (!base64_) {
      at_ += count;
      return std::string(text_.substr(at_ - count, count));
    }
    while (pending_.size() < count) decode_group();
    std::string result = pending_.substr(0, count);
    pending_.erase(0, count);
    return result;
  }

  std::size_t used() const { return at_; }

  [[noreturn]] void fail(const std::string& problem) const {
    in_.fail(fmt::format("the array {} {}", what_, problem), "the file is cut off or damaged, save it again");
  }

 private:
  // Decodes as much as is to be had in one go: four characters are three bytes, less those that '=' pads.
  void decode_group() {
    unsigned group = 0;
    int digits = 0, padding = 0;
    while (digits + padding < 4) {
      if (at_ >= text_.size()) fail("ends in the middle of its base64 text");
      const char c = text_[at_++];
      if (c == ' ' || (c >= '\t' && c <= '\r')) continue;
      const int digit = base64_digit(c);
      if (c == '=' && digits >= 2) {
        ++padding;
      } else if (digit >= 0 && padding == 0) {
        group = group << 6 | static_cast<unsigned>(digit);
        ++digits;
      } else {
        fail("has the character " + in_quotes(std::string_view(&c, 1)) + " in its base64 text");
      }
    }
    group <<= 6 * padding;
    for (int byte = 0; byte < 3 - padding; ++byte) pending_ += static_cast<char>(group >> (16 - 8 * byte) & 0xff);
  }

  std::string_view text_;
  bool base64_;
  const Scanner& in_;
  const std::string& what_;
  std::size_t at_ = 0;
  std::string pending_;  ///< decoded bytes that are not read yet
};

std::uint64_t next_size(VtkByteStream& stream, const VtkXmlCoding& coding) {
  const std::uint64_t size = unsigned_value(stream.read(coding.header_bytes), coding.order);
  if (size > max_bytes) stream.fail(fmt::format("announces {} bytes or blocks", size));
  return size;
}

/// Header: number of blocks, bytes of a block, bytes of the last block (0: as the others), compressed bytes of each. It
/// is padded where base64 encodes it by itself, as VTK does.
std::string inflated(VtkByteStream& stream, const VtkXmlCoding& coding, std::size_t limit) {
  const std::uint64_t blocks = next_size(stream, coding);
  if (blocks == 0) return {};
  stream.expect(blocks * coding.header_bytes);
  const std::uint64_t block_bytes = next_size(stream, coding), last_bytes = next_size(stream, coding);
  std::vector<std::uint64_t> sizes(static_cast<std::size_t>(blocks));
  for (std::uint64_t& size : sizes) size = next_size(stream, coding);
  std::string result;
  for (std::size_t b = 0; b < sizes.size(); ++b) {
    const std::uint64_t bytes = b + 1 == sizes.size() && last_bytes > 0 ? last_bytes : block_bytes;
    const std::string packed = stream.read(sizes[b]);
    const std::size_t begin = result.size();
    if (bytes > packed.size() * max_inflation || bytes > limit - begin)
      stream.fail(fmt::format("announces {} bytes that {} compressed ones should hold", bytes, packed.size()));
    result.resize(begin + static_cast<std::size_t>(bytes));
    uLongf written = static_cast<uLongf>(bytes);
    const int state = uncompress(reinterpret_cast<Bytef*>(result.data() + begin), &written,
                                 reinterpret_cast<const Bytef*>(packed.data()), static_cast<uLong>(packed.size()));
    if (state != Z_OK || written != bytes)
      stream.fail(fmt::format("cannot be inflated: block {} of {} is damaged", b + 1, sizes.size()));
  }
  return result;
}

}  // namespace

std::string vtk_array_bytes(std::string_view text, bool base64, const VtkXmlCoding& coding, std::size_t limit,
                            const Scanner& in, const std::string& what, std::size_t& used) {
  VtkByteStream stream(text, base64, in, what);
  std::string bytes;
  if (coding.compressed)
    bytes = inflated(stream, coding, limit);
  else
    bytes = stream.read(next_size(stream, coding));
  used = stream.used();
  return bytes;
}

}  // namespace heml
