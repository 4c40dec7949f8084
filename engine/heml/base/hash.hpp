#pragma once
// 64-bit hashes of the bits of numbers, to compare the states of two runs. Not cryptographic.
#include <bit>
#include <cstdint>

namespace heml {

/// Mixes a word into the hash `state` and returns the new hash (finaliser of SplitMix64; Steele, Lea & Flood 2014).
inline std::uint64_t hash_combine(std::uint64_t state, std::uint64_t word) {
  std::uint64_t z = state + 0x9e3779b97f4a7c15ull + word;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}
inline std::uint64_t hash_combine(std::uint64_t state, double value) {
  return hash_combine(state, std::bit_cast<std::uint64_t>(value));
}
inline std::uint64_t hash_combine(std::uint64_t state, float value) {
  return hash_combine(state, static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(value)));
}

}  // namespace heml
