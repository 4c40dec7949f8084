#pragma once
// Fan kernels on packs of 16 bytes without intrinsics, for every processor.
#include <heml/elastic/fan_force_kernel.hpp>
#include <heml/elastic/fan_kernels.hpp>

namespace heml {
namespace {  // internal linkage: not merged with code for other processors

struct Portable {
  template <class Real>
  using pack = Pack<Real, 16 / sizeof(Real), Portable>;

  template <class Real>
  [[gnu::always_inline]] static inline void begin(Real* record, const Real* x) {
    for (int i = 0; i < 4; ++i) record[i] = x[i];
    for (int i = 4; i < 8; ++i) record[i] = 0;
  }

  template <class Real>
  [[gnu::always_inline]] static inline void end(const Real* force, Real* f) {
    for (int i = 0; i < 3; ++i) f[i] = force[i];
  }

  template <class Real>
  [[gnu::always_inline]] static inline void read(const Real* records, const std::uint16_t* index, pack<Real> x[3]) {
    constexpr int lanes = pack<Real>::lanes;
    Real column[3][lanes];
    for (int l = 0; l < lanes; ++l)
      for (int i = 0; i < 3; ++i) column[i][l] = records[index[l] + i];
    for (int i = 0; i < 3; ++i) x[i] = fan::pack_at<pack<Real>>(column[i]);
  }

  template <class Real>
  [[gnu::always_inline]] static inline void add(Real* records, const std::uint16_t* index, const pack<Real> f[3]) {
    for (int l = 0; l < pack<Real>::lanes; ++l)
      for (int i = 0; i < 3; ++i) records[index[l] + i] += f[i].v[l];
  }
};

}  // namespace
}  // namespace heml
