#include <cstring>
#include <heml/elastic/avx2_dispatch.hpp>
#include <heml/elastic/group_loops.hpp>
#include <heml/elastic/stiffness_product.hpp>

namespace heml {
namespace {

/// One vector register; count: registers per packet.
template <class Real>
struct Register {
  typedef Real Type __attribute__((vector_size(32)));
  static constexpr std::size_t lanes = 32 / sizeof(Real), count = ElementGroup<Real>::lanes / lanes;
};

template <class Real>
[[gnu::always_inline]] inline void multiply(const Real* K, const ElementGroup<Real>& group, const Real* dx,
                                            std::size_t begin, std::size_t end, Real* corner) {
  using V = typename Register<Real>::Type;
  constexpr std::size_t lanes = ElementGroup<Real>::lanes, width = Register<Real>::lanes;
  for (std::size_t p = begin; p < end; ++p) {
    alignas(32) Real de[9][lanes], out[12][lanes];
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t l = 0; l < lanes; l += 4) {
        Four<Real> of_lane[4];
        for (std::size_t k = 0; k < 4; ++k) {
          const std::size_t s = p * lanes + l + k;
          of_lane[k] = read_three(dx + 3 * group.node[a + 1][s]) - read_three(dx + 3 * group.node[0][s]);
        }
        transpose(of_lane);
        for (std::size_t i = 0; i < 3; ++i) write_four(of_lane[i], &de[3 * a + i][l]);
      }
    const Real* of_packet = K + edge_entries * lanes * p;
    for (std::size_t part = 0; part < Register<Real>::count; ++part) {
      V sum[3] = {};  // of the rows, by axis: the force at corner 0
#pragma GCC unroll 9
      for (int r = 0; r < 9; ++r) {
        V f = {};
#pragma GCC unroll 9
        for (int c = 0; c < 9; ++c) {
          V k, d;
          std::memcpy(&k, of_packet + static_cast<int>(lanes) * edge_entry(r, c) + part * width, sizeof k);
          std::memcpy(&d, &de[c][part * width], sizeof d);
          f += k * d;
        }
        sum[r % 3] += f;
        f = -f;
        std::memcpy(&out[3 + r][part * width], &f, sizeof f);
      }
      for (int i = 0; i < 3; ++i) std::memcpy(&out[i][part * width], &sum[i], sizeof sum[i]);
    }
    write_packet_corners(out, corner + 3 * (group.first_corner + 4 * p * lanes), false);
  }
}

template <class Real>
HEML_WIDE void wide_multiply(const Real* K, const ElementGroup<Real>& group, const Real* dx, std::size_t begin,
                             std::size_t end, Real* corner) {
  multiply(K, group, dx, begin, end, corner);
}

}  // namespace

template <class Real>
void multiply_stiffness(const Real* K, const ElementGroup<Real>& group, const Real* dx, std::size_t begin,
                        std::size_t end, Real* corner) {
  if (has_avx2())
    wide_multiply(K, group, dx, begin, end, corner);
  else
    multiply(K, group, dx, begin, end, corner);
}

template void multiply_stiffness(const float*, const ElementGroup<float>&, const float*, std::size_t, std::size_t,
                                 float*);
template void multiply_stiffness(const double*, const ElementGroup<double>&, const double*, std::size_t, std::size_t,
                                 double*);

}  // namespace heml
