#pragma once
// Fan kernels on packs of 32 bytes with AVX2 intrinsics. Only for files compiled for AVX2 and FMA.
#include <immintrin.h>

#include <heml/elastic/fan_force_kernel.hpp>
#include <heml/elastic/fan_kernels.hpp>

namespace heml {
namespace {  // internal linkage: not merged with code for other processors

struct Avx2 {
  template <class Real>
  using pack = Pack<Real, 32 / sizeof(Real), Avx2>;

  [[gnu::always_inline]] static inline void begin(float* record, const float* x) {
    _mm256_store_ps(record, _mm256_zextps128_ps256(_mm_loadu_ps(x)));
  }

  [[gnu::always_inline]] static inline void end(const float* force, float* f) {
    const __m128 v = _mm_load_ps(force);
    _mm_storel_pi(reinterpret_cast<__m64*>(f), v);
    _mm_store_ss(f + 2, _mm_movehl_ps(v, v));
  }

  [[gnu::always_inline]] static inline void read(const float* records, const std::uint16_t* index, pack<float> x[3]) {
    __m256 row[4];
    for (int l = 0; l < 4; ++l)
      row[l] = _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(records + index[l])),
                                    _mm_load_ps(records + index[l + 4]), 1);
    const __m256 xy01 = _mm256_unpacklo_ps(row[0], row[1]), xy23 = _mm256_unpacklo_ps(row[2], row[3]);
    const __m256 z01 = _mm256_unpackhi_ps(row[0], row[1]), z23 = _mm256_unpackhi_ps(row[2], row[3]);
    x[0].v = _mm256_shuffle_ps(xy01, xy23, 0x44);
    x[1].v = _mm256_shuffle_ps(xy01, xy23, 0xee);
    x[2].v = _mm256_shuffle_ps(z01, z23, 0x44);
  }

  [[gnu::always_inline]] static inline void add(float* records, const std::uint16_t* index, const pack<float> f[3]) {
    const __m256 zero = _mm256_setzero_ps();
    const __m256 xy01 = _mm256_unpacklo_ps(f[0].v, f[1].v), xy23 = _mm256_unpackhi_ps(f[0].v, f[1].v);
    const __m256 z01 = _mm256_unpacklo_ps(f[2].v, zero), z23 = _mm256_unpackhi_ps(f[2].v, zero);
    const __m256 row[4] = {_mm256_shuffle_ps(xy01, z01, 0x44), _mm256_shuffle_ps(xy01, z01, 0xee),
                           _mm256_shuffle_ps(xy23, z23, 0x44), _mm256_shuffle_ps(xy23, z23, 0xee)};
    for (int l = 0; l < 4; ++l) {
      float* at = records + index[l];
      _mm_store_ps(at, _mm_add_ps(_mm256_castps256_ps128(row[l]), _mm_load_ps(at)));
    }
    for (int l = 0; l < 4; ++l) {
      float* at = records + index[l + 4];
      _mm_store_ps(at, _mm_add_ps(_mm256_extractf128_ps(row[l], 1), _mm_load_ps(at)));
    }
  }

  [[gnu::always_inline]] static inline void begin(double* record, const double* x) {
    _mm256_store_pd(record, _mm256_loadu_pd(x));
    _mm256_store_pd(record + 4, _mm256_setzero_pd());
  }

  [[gnu::always_inline]] static inline void end(const double* force, double* f) {
    _mm_storeu_pd(f, _mm_load_pd(force));
    f[2] = force[2];
  }

  [[gnu::always_inline]] static inline void read(const double* records, const std::uint16_t* index, pack<double> x[3]) {
    const __m256d row[4] = {_mm256_load_pd(records + index[0]), _mm256_load_pd(records + index[1]),
                            _mm256_load_pd(records + index[2]), _mm256_load_pd(records + index[3])};
    const __m256d xz01 = _mm256_unpacklo_pd(row[0], row[1]), xz23 = _mm256_unpacklo_pd(row[2], row[3]);
    const __m256d y01 = _mm256_unpackhi_pd(row[0], row[1]), y23 = _mm256_unpackhi_pd(row[2], row[3]);
    x[0].v = _mm256_permute2f128_pd(xz01, xz23, 0x20);
    x[1].v = _mm256_permute2f128_pd(y01, y23, 0x20);
    x[2].v = _mm256_permute2f128_pd(xz01, xz23, 0x31);
  }

  [[gnu::always_inline]] static inline void add(double* records, const std::uint16_t* index, const pack<double> f[3]) {
    const __m256d zero = _mm256_setzero_pd();
    const __m256d xy02 = _mm256_unpacklo_pd(f[0].v, f[1].v), xy13 = _mm256_unpackhi_pd(f[0].v, f[1].v);
    const __m256d z02 = _mm256_unpacklo_pd(f[2].v, zero), z13 = _mm256_unpackhi_pd(f[2].v, zero);
    const __m256d row[4] = {_mm256_permute2f128_pd(xy02, z02, 0x20), _mm256_permute2f128_pd(xy13, z13, 0x20),
                            _mm256_permute2f128_pd(xy02, z02, 0x31), _mm256_permute2f128_pd(xy13, z13, 0x31)};
    for (int l = 0; l < 4; ++l) {
      double* at = records + index[l];
      _mm256_store_pd(at, _mm256_add_pd(row[l], _mm256_load_pd(at)));
    }
  }
};

}  // namespace
}  // namespace heml
