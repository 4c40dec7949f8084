#pragma once
// HEML_WIDE compiles a function for AVX2 where the build targets older x86 processors; has_avx2() says at run time
// whether to call it. Both versions do the same operations in the same order, without FMA contraction, so they give the
// same bits.

namespace heml {

// A sanitized flatten function takes minutes to compile.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define HEML_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define HEML_SANITIZED
#endif
#endif

#if defined(__x86_64__) && !defined(__AVX2__) && !defined(HEML_SANITIZED)
// flatten inlines all callees: a callee compiled for the baseline target would pass packs in other registers.
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
