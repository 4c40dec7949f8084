#pragma once
// Fan kernels on packs of 64 bytes with AVX-512 intrinsics. Only for files compiled for AVX-512 F and DQ, and FMA.
#include <immintrin.h>

#include <heml/elastic/fan_force_kernel.hpp>
#include <heml/elastic/fan_kernels.hpp>

namespace heml {
namespace {  // internal linkage: not merged with code for other processors

struct Avx512 {
  template <class Real>
  using pack = Pack<Real, 64 / sizeof(Real), Avx512>;

  [[gnu::always_inline]] static inline void begin(float* record, const float* x) {
    _mm256_store_ps(record, _mm256_zextps128_ps256(_mm_loadu_ps(x)));
  }

  [[gnu::always_inline]] static inline void end(const float* force, float* f) {
    const __m128 v = _mm_load_ps(force);
    _mm_storel_pi(reinterpret_cast<__m64*>(f), v);
    _mm_store_ss(f + 2, _mm_movehl_ps(v, v));
  }

  /// Quarter q of row[l] is the record of lane l + 4 q.
  [[gnu::always_inline]] static inline void read(const float* records, const std::uint16_t* index, pack<float> x[3]) {
    __m512 row[4];
    for (int l = 0; l < 4; ++l) {
      __m512 r = _mm512_castps128_ps512(_mm_load_ps(records + index[l]));
      r = _mm512_insertf32x4(r, _mm_load_ps(records + index[l + 4]), 1);
      r = _mm512_insertf32x4(r, _mm_load_ps(records + index[l + 8]), 2);
      row[l] = _mm512_insertf32x4(r, _mm_load_ps(records + index[l + 12]), 3);
    }
    const __m512 xy01 = _mm512_unpacklo_ps(row[0], row[1]), xy23 = _mm512_unpacklo_ps(row[2], row[3]);
    const __m512 z01 = _mm512_unpackhi_ps(row[0], row[1]), z23 = _mm512_unpackhi_ps(row[2], row[3]);
    x[0].v = _mm512_shuffle_ps(xy01, xy23, 0x44);
    x[1].v = _mm512_shuffle_ps(xy01, xy23, 0xee);
    x[2].v = _mm512_shuffle_ps(z01, z23, 0x44);
  }

  template <int quarter>
  [[gnu::always_inline]] static inline void add_quarter(float* records, const std::uint16_t* index,
                                                        const __m512 row[4]) {
    for (int l = 0; l < 4; ++l) {
      float* at = records + index[l + 4 * quarter];
      _mm_store_ps(at, _mm_add_ps(_mm512_extractf32x4_ps(row[l], quarter), _mm_load_ps(at)));
    }
  }

  [[gnu::always_inline]] static inline void add(float* records, const std::uint16_t* index, const pack<float> f[3]) {
    const __m512 zero = _mm512_setzero_ps();
    const __m512 xy01 = _mm512_unpacklo_ps(f[0].v, f[1].v), xy23 = _mm512_unpackhi_ps(f[0].v, f[1].v);
    const __m512 z01 = _mm512_unpacklo_ps(f[2].v, zero), z23 = _mm512_unpackhi_ps(f[2].v, zero);
    const __m512 row[4] = {_mm512_shuffle_ps(xy01, z01, 0x44), _mm512_shuffle_ps(xy01, z01, 0xee),
                           _mm512_shuffle_ps(xy23, z23, 0x44), _mm512_shuffle_ps(xy23, z23, 0xee)};
    add_quarter<0>(records, index, row);
    add_quarter<1>(records, index, row);
    add_quarter<2>(records, index, row);
    add_quarter<3>(records, index, row);
  }

  [[gnu::always_inline]] static inline void begin(double* record, const double* x) {
    _mm512_store_pd(record, _mm512_zextpd256_pd512(_mm256_loadu_pd(x)));
  }

  [[gnu::always_inline]] static inline void end(const double* force, double* f) {
    _mm_storeu_pd(f, _mm_load_pd(force));
    f[2] = force[2];
  }

  /// Half h of row[l] is the record of lane l + 4 h.
  [[gnu::always_inline]] static inline void read(const double* records, const std::uint16_t* index, pack<double> x[3]) {
    __m512d row[4];
    for (int l = 0; l < 4; ++l)
      row[l] = _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_load_pd(records + index[l])),
                                  _mm256_load_pd(records + index[l + 4]), 1);
    const __m512d xz01 = _mm512_unpacklo_pd(row[0], row[1]), xz23 = _mm512_unpacklo_pd(row[2], row[3]);
    const __m512d y01 = _mm512_unpackhi_pd(row[0], row[1]), y23 = _mm512_unpackhi_pd(row[2], row[3]);
    const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13),
                  high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    x[0].v = _mm512_permutex2var_pd(xz01, low, xz23);
    x[1].v = _mm512_permutex2var_pd(y01, low, y23);
    x[2].v = _mm512_permutex2var_pd(xz01, high, xz23);
  }

  [[gnu::always_inline]] static inline void add(double* records, const std::uint16_t* index, const pack<double> f[3]) {
    const __m512d zero = _mm512_setzero_pd();
    const __m512i low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13),
                  high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    const __m512d xy02 = _mm512_unpacklo_pd(f[0].v, f[1].v), xy13 = _mm512_unpackhi_pd(f[0].v, f[1].v);
    const __m512d z02 = _mm512_unpacklo_pd(f[2].v, zero), z13 = _mm512_unpackhi_pd(f[2].v, zero);
    const __m512d row[4] = {_mm512_permutex2var_pd(xy02, low, z02), _mm512_permutex2var_pd(xy13, low, z13),
                            _mm512_permutex2var_pd(xy02, high, z02), _mm512_permutex2var_pd(xy13, high, z13)};
    for (int l = 0; l < 4; ++l) {
      double* at = records + index[l];
      _mm256_store_pd(at, _mm256_add_pd(_mm512_castpd512_pd256(row[l]), _mm256_load_pd(at)));
    }
    for (int l = 0; l < 4; ++l) {
      double* at = records + index[l + 4];
      _mm256_store_pd(at, _mm256_add_pd(_mm512_extractf64x4_pd(row[l], 1), _mm256_load_pd(at)));
    }
  }
};

}  // namespace
}  // namespace heml
