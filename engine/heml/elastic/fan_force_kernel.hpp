#pragma once
// The force kernel of every law and instruction set.
//
// Forces are those of elastic/tension.hpp with k = 1/6V and A* = 6V A, which needs no division and no V. A fan is
// traversed in three passes, so that a pass keeps few values in registers and its iterations do not depend on one
// another:
//
//   nodes ──► spokes b, b·b, a·b ──► tensions of each tetrahedron ──► forces at each ring node ──► nodes
//
// A link shared by tetrahedra of a fan has the sum of their tensions: f_i = −((t_ii + t'_ii) b_i + (t_ia + t'_ia) a +
// …). In a closed ring the last node comes before the first.
#include <heml/elastic/fan_parts.hpp>

namespace heml::fan {

/// C = k LᵀGL and T = ⅙ L S Lᵀ (returned with reversed sign), L the Cholesky factor of A*.
template <class P, PrincipalLaw<P> L>
[[gnu::always_inline]] inline FanTensions<P> fan_tensions(const L& law, const FanRest<P>& rest, const FanGram<P>& G,
                                                          P J, Mask<P>& valid) {
  const P la = rest.p, l00 = rest.q00, l10 = rest.q01, l11 = rest.q11;  // of the Cholesky factor
  const P w00 = G.b00 * l00 + G.b01 * l10, w10 = G.b01 * l00 + G.b11 * l10, w01 = G.b01 * l11, w11 = G.b11 * l11;
  P C[6] = {la * la * G.aa,    l00 * w00 + l10 * w10, l11 * w11, la * (G.a0 * l00 + G.a1 * l10),
            la * (G.a1 * l11), l00 * w01 + l10 * w11};
  for (P& entry : C) entry *= rest.k;
  const auto stress = principal_stress(law, principal_state<L::is_continued>(law, C, J), J);
  if constexpr (!L::always_valid) valid = valid && law.valid(Invariants<P>{C[0] + C[1] + C[2], P(0), J});
  const P sixth = -1.0 / 6, la6 = la * sixth, l006 = l00 * sixth, l106 = l10 * sixth, l116 = l11 * sixth;
  const P* S = stress.S;
  const P r10 = l10 * S[1] + l11 * S[5], r11 = l10 * S[5] + l11 * S[2];
  return {
      la6 * la * S[0], l006 * l00 * S[1], l106 * r10 + l116 * r11, la6 * (l00 * S[3]), la6 * (l10 * S[3] + l11 * S[4]),
      l006 * r10,      stress.wJ * sixth};
}

/// T = ⅓ [(w1 + w2 I1) A* − w2 k A*GA* + w4 m* m*ᵀ + w5 k (m* n*ᵀ + n* m*ᵀ)] with I1 = k A*:G, tr C² = k² tr(A*G)²,
/// I4 = k m*·G m*, n* = A*G m* and I5 = k² n*·G m*.
template <class P, InvariantLaw<P> L>
[[gnu::always_inline]] inline FanTensions<P> fan_tensions(const L& law, const FanRest<P>& rest, const FanGram<P>& G,
                                                          P J, Mask<P>& valid) {
  const auto& [p, q00, q11, q01, k, m] = rest;
  const P third = -1.0 / 3, y = p * G.aa;
  Invariants<P> at{P(0), P(0), J, P(1)};
  P w00, w01, w10, w11, v0, v1;  // of A*G
  if constexpr (L::uses_I2) {
    w00 = q00 * G.b00 + q01 * G.b01, w01 = q00 * G.b01 + q01 * G.b11;
    w10 = q01 * G.b00 + q11 * G.b01, w11 = q01 * G.b01 + q11 * G.b11;
    v0 = q00 * G.a0 + q01 * G.a1, v1 = q01 * G.a0 + q11 * G.a1;
    at.I1 = k * (y + (w00 + w11));
    const P square = y * y + P(2) * (p * (G.a0 * v0 + G.a1 * v1) + w01 * w10) + w00 * w00 + w11 * w11;
    at.I2 = (at.I1 * at.I1 - k * k * square) * P(0.5);
  } else {
    at.I1 = k * (y + (q00 * G.b00 + q11 * G.b11) + P(2) * (q01 * G.b01));
  }
  P mm[6];
  if constexpr (L::uses_I4) {
    mm[0] = m[0] * m[0], mm[1] = m[1] * m[1], mm[2] = m[2] * m[2];
    mm[3] = m[0] * m[1], mm[4] = m[0] * m[2], mm[5] = m[1] * m[2];
    at.I4 = k * (mm[0] * G.aa + mm[1] * G.b00 + mm[2] * G.b11 + P(2) * (mm[3] * G.a0 + mm[4] * G.a1 + mm[5] * G.b01));
  }
  [[maybe_unused]] P n[3];
  if constexpr (FibreShearLaw<L>) {
    const P h0 = G.aa * m[0] + G.a0 * m[1] + G.a1 * m[2], h1 = G.a0 * m[0] + G.b00 * m[1] + G.b01 * m[2];
    const P h2 = G.a1 * m[0] + G.b01 * m[1] + G.b11 * m[2];
    n[0] = p * h0, n[1] = q00 * h1 + q01 * h2, n[2] = q01 * h1 + q11 * h2;
    at.I5 = k * k * (h0 * n[0] + h1 * n[1] + h2 * n[2]);
  }
  if constexpr (!L::always_valid) valid = valid && law.valid(at);

  const FirstDerivatives<P> s = law.first_derivatives(at);
  FanTensions<P> t;
  if constexpr (L::uses_I2) {
    const P c = -(s.w2 * third) * k, pull = (s.w1 + s.w2 * at.I1) * third, cp = c * p;
    const P z00 = c * w00 + pull, z01 = c * w01, z10 = c * w10, z11 = c * w11 + pull;
    t.aa = (c * y + pull) * p;
    t.b00 = z00 * q00 + z01 * q01, t.b11 = z10 * q01 + z11 * q11, t.b01 = z00 * q01 + z01 * q11;
    t.a0 = cp * v0, t.a1 = cp * v1;
  } else {
    const P pull = s.w1 * third;
    t.aa = pull * p, t.b00 = pull * q00, t.b11 = pull * q11, t.b01 = pull * q01;
    if constexpr (L::uses_I4) t.a0 = t.a1 = P(0);
  }
  if constexpr (L::uses_I4) {
    const P w4 = s.w4 * third;
    t.aa += w4 * mm[0], t.b00 += w4 * mm[1], t.b11 += w4 * mm[2];
    t.a0 += w4 * mm[3], t.a1 += w4 * mm[4], t.b01 += w4 * mm[5];
  }
  if constexpr (FibreShearLaw<L>) {
    const P w5 = s.w5 * third * k, twice = w5 + w5;
    t.aa += twice * (m[0] * n[0]), t.b00 += twice * (m[1] * n[1]), t.b11 += twice * (m[2] * n[2]);
    t.a0 += w5 * (m[0] * n[1] + m[1] * n[0]), t.a1 += w5 * (m[0] * n[2] + m[2] * n[0]);
    t.b01 += w5 * (m[1] * n[2] + m[2] * n[1]);
  }
  if constexpr (L::uses_J) t.u = s.wJ * P(-1.0 / 6);
  return t;
}

template <class Real, class Isa, class L>
struct ForceKernel {
  using P = typename Isa::template pack<Real>;
  static constexpr std::size_t constants = fan_constants(L::uses_I4), lanes = P::lanes;

  struct Work {
    Spoke<P> spoke[max_fan_tets + 3];           ///< [1 .. ring]; [0] and [ring + 1] continue a closed ring
    FanTensions<P> tensions[max_fan_tets + 2];  ///< [1 .. m]; [0] and [m + 1]: continue a closed ring, or zero
  };

  /// Nodes, constants and axis of a group.
  struct Group {
    std::size_t m, ring_nodes;
    const std::uint16_t* ring;
    const Real *foot, *rest;
    P p[3], a[3], aa;
  };

  [[gnu::always_inline]] static inline void read_ring(const Group& group, const Real* records, Work& work) {
    for (std::size_t i = 0; i < group.ring_nodes; ++i) {
      Spoke<P>& spoke = work.spoke[i + 1];
      read_spoke<Isa>(records, group.ring + i * lanes, pack_at<P>(group.foot + i * lanes), group.p, group.a, spoke.b);
      spoke.bb = dot(spoke.b, spoke.b);
      spoke.ab = dot(spoke.b, group.a);
      if constexpr (L::uses_J) cross(spoke.b, group.a, spoke.c);
    }
    if (group.ring_nodes == group.m) {
      copy_spoke(work.spoke[0], work.spoke[group.m]);
      copy_spoke(work.spoke[group.m + 1], work.spoke[1]);
    }
  }

  /// Copies pack by pack: a store from a struct copy is not forwarded to the next load of a pack.
  [[gnu::always_inline]] static inline void copy_spoke(Spoke<P>& to, const Spoke<P>& from) {
    for (int i = 0; i < 3; ++i) to.b[i].v = from.b[i].v;
    to.bb.v = from.bb.v, to.ab.v = from.ab.v;
    if constexpr (L::uses_J)
      for (int i = 0; i < 3; ++i) to.c[i].v = from.c[i].v;
  }

  /// Tensions beyond the ends of an open ring.
  [[gnu::always_inline]] static inline void zero_tensions(FanTensions<P>& t) {
    t.b00 = t.b11 = t.b01 = P(0);
    if constexpr (has_coupling<L, P>) t.a0 = t.a1 = P(0);
    if constexpr (L::uses_J) t.u = P(0);
  }

  /// Evaluates the tensions of every tetrahedron. Returns their sum on the axis.
  [[gnu::always_inline]] static inline P evaluate_tensions(const L& law, const Group& group, Work& work,
                                                           Mask<P>& valid) {
    P axis = 0;
    const Real* constant = group.rest;
    for (std::size_t i = 1; i <= group.m; ++i, constant += constants * lanes) {
      const Spoke<P>&from = work.spoke[i], &to = work.spoke[i + 1];
      const FanRest<P> rest = read_rest<P, constants>(constant);
      const FanGram<P> G{group.aa, from.bb, to.bb, from.ab, to.ab, dot(from.b, to.b)};
      const P J = L::uses_J ? rest.k * dot(from.b, to.c) : P(1);
      work.tensions[i] = fan_tensions<P>(law, rest, G, J, valid);
      axis += work.tensions[i].aa;
    }
    close_ring(group, work);
    return axis;
  }

  /// Sets the tensions before the first tetrahedron and after the last.
  [[gnu::always_inline]] static inline void close_ring(const Group& group, Work& work) {
    if (group.ring_nodes == group.m) {
      FanTensions<P>&before = work.tensions[0], &last = work.tensions[group.m];
      before.b11 = last.b11, before.b01 = last.b01;
      if constexpr (has_coupling<L, P>) before.a1 = last.a1;
      if constexpr (L::uses_J) before.u = last.u;
    } else {
      zero_tensions(work.tensions[0]);
      zero_tensions(work.tensions[group.m + 1]);
    }
  }

  /// Adds the forces at the ring nodes to the records and sums their reactions for p and q.
  [[gnu::always_inline]] static inline void add_ring_forces(const Group& group, const Work& work, Real* records,
                                                            P at_p[3], P at_q[3]) {
    for (std::size_t i = 1; i <= group.ring_nodes; ++i) {
      const Spoke<P>&before = work.spoke[i - 1], &spoke = work.spoke[i], &after = work.spoke[i + 1];
      const FanTensions<P>&s = work.tensions[i - 1], &t = work.tensions[i];
      const P t_bb = s.b11 + t.b00, t_ab = s.a1 + t.a0, foot = pack_at<P>(group.foot + (i - 1) * lanes);
      P f[3];
      for (int j = 0; j < 3; ++j) {
        f[j] = t_bb * spoke.b[j] + (s.b01 * before.b[j] + t.b01 * after.b[j]);
        if constexpr (has_coupling<L, P>) {
          f[j] += t_ab * group.a[j];
          at_q[j] += t_ab * spoke.b[j];
        }
        if constexpr (L::uses_J) {
          const int k = (j + 1) % 3, l = (j + 2) % 3;
          f[j] += t.u * after.c[j] - s.u * before.c[j];
          at_q[j] += t.u * (spoke.b[k] * after.b[l] - spoke.b[l] * after.b[k]);
        }
        at_p[j] += f[j];
        at_q[j] -= foot * f[j];
      }
      Isa::add(records + 4, group.ring + (i - 1) * lanes, f);
    }
  }

  /// Reads the axis and the spokes of a group.
  [[gnu::always_inline]] static inline void read_group(Group& group, const std::uint16_t* index, const Real* records,
                                                       Work& work) {
    read_axis<Isa>(records, index, group.p, group.a);
    group.aa = dot(group.a, group.a);
    read_ring(group, records, work);
  }

  /// Adds the forces of a group to the records. axis: the sum of the tensions on the axis.
  [[gnu::always_inline]] static inline void add_forces(const Group& group, const std::uint16_t* index, P axis,
                                                       const Work& work, Real* records) {
    P at_p[3] = {0, 0, 0}, at_q[3] = {0, 0, 0};
    add_ring_forces(group, work, records, at_p, at_q);
    for (int i = 0; i < 3; ++i) {
      at_q[i] += axis * group.a[i];
      at_p[i] = -(at_p[i] + at_q[i]);
    }
    Isa::add(records + 4, reread(index + lanes), at_q);
    Isa::add(records + 4, reread(index), at_p);
  }

  /// Adds the forces of one group of fans to the records.
  [[gnu::always_inline]] static inline void run(const L& law, FanSize size, const std::uint16_t* index,
                                                const Real* shape, Real* records, Work& work, Mask<P>& valid) {
    Group group{size.tets, size.ring, index + 2 * lanes, shape, shape + size.ring * lanes, {}, {}, {}};
    read_group(group, index, records, work);
    const P axis = evaluate_tensions(law, group, work, valid);
    add_forces(group, index, axis, work, records);
  }

  /// What the next group reads, which comes from memory where a body is larger than the caches: as much as this one.
  /// Of the last group that is beyond the end, where nothing is read.
  [[gnu::always_inline]] static inline void prefetch(const Real* from, std::size_t count) {
    for (std::size_t i = 0; i < count; i += 128 / sizeof(Real)) __builtin_prefetch(from + i, 0, 2);
  }

  static bool block(const L& law, const FanBlock<Real>& block, const Real* x, Real* f) {
    alignas(64) Real records[8 * max_block_nodes];
    read_records<Isa>(block, x, records);
    const std::uint16_t* index = block.index;
    const Real* shape = block.shape;
    Mask<P> valid = true;
    Work work;
    for (Spoke<P>& spoke : work.spoke) spoke = {};
    for (std::size_t g = 0; g < block.groups; ++g) {
      const FanSize size = block.size[g];
      const std::size_t shapes = (size.ring + size.tets * constants) * lanes;
      prefetch(shape + shapes, shapes);
      run(law, size, index, shape, records, work, valid);
      index += (2 + size.ring) * lanes;
      shape += shapes;
    }

    write_forces<Isa>(block, records + 4, f);
    return valid.all();
  }
};

/// Kernel of the law with that index in LawList.
template <class Real, class Isa>
FanKernel<Real> force_kernel(std::size_t law, bool continued) {
  using P = typename Isa::template pack<Real>;
  FanKernel<Real> kernel = nullptr;
  visit_law(law, continued, [&]<class Tag, bool with>(Tag, std::bool_constant<with>) {
    using One = typename Tag::template Law<Real, with>;
    using Many = typename Tag::template Law<P, with>;
    kernel = [](const void* scalar, const FanBlock<Real>& block, const Real* x, Real* f) {
      return ForceKernel<Real, Isa, Many>::block(broadcast<Many, P>(*static_cast<const One*>(scalar)), block, x, f);
    };
  });
  return kernel;
}

}  // namespace heml::fan
