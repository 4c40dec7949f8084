#include <studies/peak.hpp>

namespace heml {
namespace {

constexpr int chains = 12;  // independent: more than the latency of a multiply-add (cycles) times two units

/// x ← m x + b in every lane of `chains` vectors. Compiled with contraction (engine/CMakeLists.txt).
#define HEML_PEAK_LOOP(function, attributes, vector_bytes)                           \
  template <class Real>                                                              \
  attributes void function(long turns) {                                             \
    typedef Real Vector __attribute__((vector_size(vector_bytes)));                  \
    Vector x[chains];                                                                \
    const Vector m = Vector{} + Real(0.5), b = Vector{} + Real(0.25);                \
    for (int k = 0; k < chains; ++k) x[k] = Vector{} + static_cast<Real>(k);         \
    for (long turn = 0; turn < turns; ++turn) {                                      \
      _Pragma("GCC unroll 12") for (int k = 0; k < chains; ++k) x[k] = x[k] * m + b; \
      asm volatile("");                                                              \
    }                                                                                \
    Vector sum = x[0];                                                               \
    for (int k = 1; k < chains; ++k) sum += x[k];                                    \
    volatile Real kept = sum[0];                                                     \
    static_cast<void>(kept);                                                         \
  }

HEML_PEAK_LOOP(portable_loop, , 16)
#ifdef __x86_64__
HEML_PEAK_LOOP(avx2_loop, [[gnu::target("avx2,fma")]], 32)
HEML_PEAK_LOOP(avx512_loop, [[gnu::target("avx512f,fma")]], 64)
#endif
#undef HEML_PEAK_LOOP

template <class Real>
void add_loops(const char* precision, std::vector<PeakLoop>& list) {
  const auto operations = [](int bytes) { return 2.0 * chains * bytes / sizeof(Real); };
  list.push_back({"portable", precision, portable_loop<Real>, operations(16)});
#ifdef __x86_64__
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (avx2) list.push_back({"avx2", precision, avx2_loop<Real>, operations(32)});
  if (avx2 && __builtin_cpu_supports("avx512f"))
    list.push_back({"avx512", precision, avx512_loop<Real>, operations(64)});
#endif
}

}  // namespace

std::vector<PeakLoop> peak_loops() {
  std::vector<PeakLoop> list;
  add_loops<float>("float", list);
  add_loops<double>("double", list);
  return list;
}

Triad::Triad(std::size_t bytes) : a_(bytes / 24, 0.0), b_(bytes / 24, 1.0), c_(bytes / 24, 2.0) {}

void Triad::run(ThreadTeam& team, long turns) {
  team.parallel_for(a_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (long turn = 0; turn < turns; ++turn) {
      double* a = a_.data();
      const double *b = b_.data(), *c = c_.data();
      for (std::size_t i = begin; i < end; ++i) a[i] = b[i] + 3.0 * c[i];
      asm volatile("" ::: "memory");
    }
  });
}

}  // namespace heml
