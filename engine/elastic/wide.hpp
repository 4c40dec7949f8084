#pragma once
// Loops compiled for AVX2 where the compiler's own target is older x86. A processor without it takes loops of the same
// operations in the same order, none contracted, so the same bits.

namespace heml {

#if defined(__x86_64__) && !defined(__AVX2__)
// Flat: what is called is inlined, since a function for other processors takes packs in other registers.
#define HEML_WIDE [[gnu::target("avx2"), gnu::flatten]]
inline bool has_wide() {
  static const bool has = __builtin_cpu_supports("avx2");
  return has;
}
#else
#define HEML_WIDE
inline bool has_wide() { return true; }
#endif

}  // namespace heml
