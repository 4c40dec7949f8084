#pragma once
// Loops compiled for AVX2 where the compiler's own target is older x86. A processor without it takes loops of the same
// operations in the same order, none contracted, so the same bits.

namespace heml {

// Sanitizers make so much of a flat function that it would take minutes to compile.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define HEML_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define HEML_SANITIZED
#endif
#endif

#if defined(__x86_64__) && !defined(__AVX2__) && !defined(HEML_SANITIZED)
// Flat: what is called is inlined, since a function for other processors takes packs in other registers.
#define HEML_WIDE [[gnu::target("avx2"), gnu::flatten]]
inline bool has_avx2() {
  static const bool has = __builtin_cpu_supports("avx2");
  return has;
}
#else
#define HEML_WIDE
inline bool has_avx2() { return true; }
#endif

}  // namespace heml
