#pragma once
// Shared parts of the fan kernels: reading a block and its fans, writing forces.
//
// Isa defines the width of a pack and reads and writes records:
//
//   Isa::pack<Real>                        a Pack
//   Isa::read(records, index, x)           x[3] of the nodes a pack's lanes point at
//   Isa::add(records, index, f)            f[3] to those records, one lane after the other
//   Isa::begin(record, x)                  writes a record from the four numbers at x, the last of them unused
//   Isa::end(force, f)                     writes a record's force to f[3]
#include <heml/elastic/fan_block.hpp>
#include <heml/materials/law_list.hpp>
#include <heml/materials/law_packs.hpp>

namespace heml::fan {

template <class P>
[[gnu::always_inline]] inline P dot(const P a[3], const P b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class P>
[[gnu::always_inline]] inline P pack_at(const Lane<P>* from) {
  typename P::Vector v;
  __builtin_memcpy(&v, from, sizeof v);
  return P(v);
}

template <class P>
[[gnu::always_inline]] inline void cross(const P a[3], const P b[3], P out[3]) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    out[i] = a[j] * b[k] - a[k] * b[j];
  }
}

/// A ring node, as used by the tetrahedra on both sides of it.
template <class P>
struct Spoke {
  P b[3];    ///< from the axis, m
  P bb, ab;  ///< b·b, a·b
  P c[3];    ///< b × a, m²
};

/// The constants of one tetrahedron's rest shape (elastic/fan_block.hpp).
template <class P>
struct FanRest {
  P p, q00, q11, q01, k, m[3];
};

/// Products of the edges a, b0, b1 of a tetrahedron.
template <class P>
struct FanGram {
  P aa, b00, b11, a0, a1, b01;
};

/// Tensions of one tetrahedron with reversed sign (N/m), which sum to forces; u = −wJ/6 multiplies ∂(6V J)/∂x.
template <class P>
struct FanTensions {
  P aa, b00, b11, a0, a1, b01, u;
};

/// Whether a law couples axis and ring; the rest shape alone does not.
template <class L, class P>
inline constexpr bool has_coupling = L::uses_I2 || L::uses_I4 || PrincipalLaw<L, P>;

/// p and a = q − p.
template <class Isa, class Real, class P>
[[gnu::always_inline]] inline void read_axis(const Real* records, const std::uint16_t* index, P p[3], P a[3]) {
  Isa::read(records, index, p);
  Isa::read(records, index + P::lanes, a);
  for (int i = 0; i < 3; ++i) a[i] -= p[i];
}

/// b = r − p − φ a.
template <class Isa, class Real, class P>
[[gnu::always_inline]] inline void read_spoke(const Real* records, const std::uint16_t* index, P foot, const P p[3],
                                              const P a[3], P b[3]) {
  Isa::read(records, index, b);
  for (int i = 0; i < 3; ++i) b[i] = b[i] - p[i] - foot * a[i];
}

template <class P, std::size_t constants>
[[gnu::always_inline]] inline FanRest<P> read_rest(const Lane<P>* shape) {
  FanRest<P> rest;
  P* constant[] = {&rest.p, &rest.q00, &rest.q11, &rest.q01, &rest.k, rest.m, rest.m + 1, rest.m + 2};
  for (std::size_t i = 0; i < constants; ++i) *constant[i] = pack_at<P>(shape + i * P::lanes);
  return rest;
}

/// Copies nodes into records. Isa::begin reads four numbers, so the last node, which may end the array, is padded
/// first.
template <class Isa, class Real>
[[gnu::always_inline]] inline void read_nodes(const std::uint32_t* place, std::size_t count, const Real* x,
                                              Real* record) {
#pragma GCC unroll 4
  for (std::size_t n = 0; n + 1 < count; ++n, record += 8) Isa::begin(record, x + place[n]);
  if (count == 0) return;
  const Real* last = x + place[count - 1];
  const Real padded[4] = {last[0], last[1], last[2], 0};
  Isa::begin(record, padded);
}

/// Fills the records of a block's nodes and of the dummy nodes, a right-angled corner.
template <class Isa, class Real>
[[gnu::always_inline]] inline void read_records(const FanBlock<Real>& block, const Real* x, Real* records) {
  read_nodes<Isa>(block.place, block.own, x, records);
  read_nodes<Isa>(block.place + block.own, block.nodes - block.own, x, records + 8 * block.own);
  Real* record = records + 8 * block.nodes;
  for (int corner = 0; corner < 4; ++corner, record += 8)
    for (int i = 0; i < 8; ++i) record[i] = corner == i + 1 ? Real(1) : Real(0);
}

/// Writes the forces of own nodes to f and those of shared nodes to shared_force.
template <class Isa, class Real>
[[gnu::always_inline]] inline void write_forces(const FanBlock<Real>& block, const Real* record, Real* f) {
  const std::uint32_t* place = block.place;
  const std::size_t own = block.own, nodes = block.nodes;
  Real* to = block.shared_force;
#pragma GCC unroll 4
  for (std::size_t n = 0; n < own; ++n, record += 8) Isa::end(record, f + place[n]);
  for (std::size_t n = own; n < nodes; ++n, record += 8, to += 3) Isa::end(record, to);
}

/// Hides the origin of a pointer, so that the compiler reloads through it rather than keep values in scarce registers.
template <class T>
[[gnu::always_inline]] inline const T* reread(const T* pointer) {
  asm("" : "+r"(pointer));
  return pointer;
}

}  // namespace heml::fan
