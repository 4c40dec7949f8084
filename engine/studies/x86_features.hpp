#pragma once
// Instruction set extensions that GCC and clang may use with -march=native: predefined macro and name for
// __builtin_cpu_supports(). Empty on other architectures.
//
//    #define HEML_NAME(macro, name) , name
//    const char* names[] = {"" HEML_X86_FEATURES(HEML_NAME)};
#ifdef __x86_64__
#define HEML_X86_FEATURES(each)                                                                                        \
  each(__SSE2__, "sse2") each(__SSE3__, "sse3") each(__SSSE3__, "ssse3") each(__SSE4_1__, "sse4.1")                    \
      each(__SSE4_2__, "sse4.2") each(__SSE4A__, "sse4a") each(__POPCNT__, "popcnt") each(__AVX__, "avx")              \
          each(__AVX2__, "avx2") each(__FMA__, "fma") each(__FMA4__, "fma4") each(__XOP__, "xop") each(__BMI__, "bmi") \
              each(__BMI2__, "bmi2") each(__AVX512F__, "avx512f") each(__AVX512CD__, "avx512cd")                       \
                  each(__AVX512DQ__, "avx512dq") each(__AVX512BW__, "avx512bw") each(__AVX512VL__, "avx512vl")         \
                      each(__AVX512IFMA__, "avx512ifma") each(__AVX512VBMI__, "avx512vbmi")                            \
                          each(__AVX512VBMI2__, "avx512vbmi2") each(__AVX512VNNI__, "avx512vnni")                      \
                              each(__AVX512BITALG__, "avx512bitalg") each(__AVX512VPOPCNTDQ__, "avx512vpopcntdq")
#else
#define HEML_X86_FEATURES(each)
#endif

/// True if a macro is defined as 1.
#define HEML_IS_ONE(macro) (HEML_TEXT_OF(macro)[0] == '1')
#define HEML_TEXT_OF(text) #text
