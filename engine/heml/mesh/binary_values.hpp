#pragma once
// Numbers as binary mesh files hold them, of either byte order.
#include <bit>
#include <cstdint>
#include <string_view>

namespace heml {

enum class NumberKind { real, signed_integer, unsigned_integer };

/// bytes: up to 8.
inline std::uint64_t unsigned_value(std::string_view bytes, std::endian order) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[order == std::endian::big ? i : bytes.size() - 1 - i]);
  return value;
}

/// A float of 4 bytes or a double of 8.
inline double real_value(std::string_view bytes, std::endian order) {
  const std::uint64_t bits = unsigned_value(bytes, order);
  return bytes.size() == 4 ? std::bit_cast<float>(static_cast<std::uint32_t>(bits)) : std::bit_cast<double>(bits);
}

/// Unsigned integers of 8 bytes become negative from 2⁶³ on.
inline long long integer_value(std::string_view bytes, NumberKind kind, std::endian order) {
  const auto shift = 64 - 8 * static_cast<int>(bytes.size());
  const std::uint64_t high = unsigned_value(bytes, order) << shift;
  return kind == NumberKind::signed_integer ? static_cast<std::int64_t>(high) >> shift
                                            : static_cast<long long>(high >> shift);
}

}  // namespace heml
