#pragma once
// The kernels of elastic/fan_terms.hpp. Stages that no law decides are compiled once for each instruction set and
// scalar, so that a law adds its tensions alone to the code.
#include <heml/elastic/added_volume.hpp>
#include <heml/elastic/fan_energy.hpp>
#include <heml/elastic/fan_flow_tensions.hpp>
#include <heml/elastic/fan_force_kernel.hpp>
#include <heml/elastic/fan_term_kernels.hpp>
#include <heml/elastic/remembered_tensions.hpp>

namespace heml::fan {

/// What the stages take for a law: tensions of every link, and a volume derivative.
struct AnyTensions {
  static constexpr bool uses_I2 = true, uses_J = true, uses_I4 = false;
};

template <class Real, class Isa>
struct TermStages {
  using Stages = ForceKernel<Real, Isa, AnyTensions>;
  using P = typename Stages::P;
  using Work = typename Stages::Work;
  using Group = typename Stages::Group;
  static constexpr std::size_t lanes = P::lanes;

  /// Writes the tensions of a law into work.tensions [1 .. m]. Parameters that differ are set in the law. shape, beyond:
  /// of elements that flow.
  using LawTensions = void (*)(void* law, const FanTerms<Real>& terms, const Group& group, const Real* shape,
                               Real* beyond, Work& work, Mask<P>& valid);

  template <class L>
  static void law_tensions(void* of_part, const FanTerms<Real>& terms, const Group& group, const Real*, Real*,
                           Work& work, Mask<P>& valid) {
    constexpr std::size_t of_shape = fan_constants(L::uses_I4);
    L& law = *static_cast<L*>(of_part);
    const Real* constant = group.rest;
    for (std::size_t i = 1; i <= group.m; ++i, constant += terms.constants * lanes) {
      if constexpr (std::size(L::parameters) > 0) read_parameters(terms, constant + of_shape * lanes, law);
      const FanRest<P> rest = read_rest<P, of_shape>(constant);
      FanTensions<P> t = fan_tensions<P>(law, rest, gram(group, work, i), rest.k * six_volumes(work, i), valid);
      if constexpr (!has_coupling<L, P>) t.a0 = t.a1 = P(0);
      if constexpr (!L::uses_J) t.u = P(0);
      work.tensions[i] = t;
    }
  }

  template <class L>
  static void flowed_law_tensions(void* of_part, const FanTerms<Real>& terms, const Group& group, const Real* shape,
                                  Real* beyond, Work& work, Mask<P>& valid) {
    L& law = *static_cast<L*>(of_part);
    const Real* constant = group.rest;
    for (std::size_t i = 1; i <= group.m; ++i, constant += terms.constants * lanes, beyond += lanes) {
      if constexpr (std::size(L::parameters) > 0) read_parameters(terms, constant + fan_constants(false) * lanes, law);
      const P k = pack_at<P>(constant + 4 * lanes);
      P A[6];
      for (std::size_t c = 0; c < 6; ++c, shape += lanes) A[c] = pack_at<P>(shape);
      const P limit = pack_at<P>(shape);
      shape += lanes;
      const FanGram<P> G = gram(group, work, i);
      const FanTensions<P> t = flowed_tensions<P>(law, A, k, G, k * six_volumes(work, i), valid);
      put(beyond, select(mises_measure(t, G, k) < limit, P(0), P(1)));  // 1 where it is no number
      work.tensions[i] = t;
    }
  }

  template <class L>
  [[gnu::always_inline]] static inline void read_parameters(const FanTerms<Real>& terms, const Real* from, L& law) {
    for (std::size_t k = 0; k < terms.parameter_count; ++k, from += lanes)
      if (terms.parameters[k] != terms.not_of_the_law)
        law.*L::parameters[terms.parameters[k]].member = pack_at<P>(from);
  }

  [[gnu::always_inline]] static inline FanGram<P> gram(const Group& group, const Work& work, std::size_t i) {
    const Spoke<P>&from = work.spoke[i], &to = work.spoke[i + 1];
    return {group.aa, from.bb, to.bb, from.ab, to.ab, dot(from.b, to.b)};
  }
  /// 6 V J.
  [[gnu::always_inline]] static inline P six_volumes(const Work& work, std::size_t i) {
    return dot(work.spoke[i].b, work.spoke[i + 1].c);
  }

  /// The entries of A* and k, whichever constants the law has.
  [[gnu::always_inline]] static inline FanRest<P> metric(const FanTerms<Real>& terms, const Group& group,
                                                         std::size_t i) {
    FanRest<P> rest = read_rest<P, fan_constants(false)>(group.rest + (i - 1) * terms.constants * lanes);
    if (!terms.is_principal) return rest;
    const P la = rest.p, l00 = rest.q00, l10 = rest.q01, l11 = rest.q11;
    rest.p = la * la, rest.q00 = l00 * l00, rest.q01 = l00 * l10, rest.q11 = l10 * l10 + l11 * l11;
    return rest;
  }

  static void add_volume(const FanTerms<Real>& terms, const Group& group, Work& work, Mask<P>& valid) {
    P scale = terms.kappa * Real(-1.0 / 6);
    const Real* constant = group.rest;
    for (std::size_t i = 1; i <= group.m; ++i, constant += terms.constants * lanes) {
      const P k = pack_at<P>(constant + 4 * lanes);
      if (terms.kappa_constant) scale = pack_at<P>(constant + terms.kappa_constant * lanes) * Real(-1.0 / 6);
      work.tensions[i].u +=
          scale * added_volume_derivative(terms.volume, terms.is_continued, k * six_volumes(work, i), valid);
    }
  }

  /// T += −V (η A ΔG A + ζ/2 (A:ΔG) A) / h with A = k A*, V = 1/6k; G becomes the next state.
  static void add_viscosity(const FanTerms<Real>& terms, const Group& group, Work& work, const Real* state,
                            Real* next) {
    const P eta = terms.eta * terms.per_step * Real(-1.0 / 6), zeta = terms.zeta * terms.per_step * Real(-1.0 / 12);
    for (std::size_t i = 1; i <= group.m; ++i, state += terms.state * lanes, next += terms.state * lanes) {
      const FanGram<P> G = gram(group, work, i);
      const P entries[6] = {G.aa, G.b00, G.b11, G.a0, G.a1, G.b01};
      P d[6];
      for (std::size_t c = 0; c < 6; ++c) {
        d[c] = entries[c] - pack_at<P>(state + c * lanes);
        put(next + c * lanes, entries[c]);
      }
      const auto [p, q00, q11, q01, k, m] = metric(terms, group, i);
      const P w00 = q00 * d[1] + q01 * d[5], w01 = q00 * d[5] + q01 * d[2];  // of A*ΔG
      const P w10 = q01 * d[1] + q11 * d[5], w11 = q01 * d[5] + q11 * d[2];
      const P pe = eta * k, pp = pe * p, y = p * d[0], bulk = zeta * k * (y + (w00 + w11));
      FanTensions<P>& t = work.tensions[i];
      t.aa += (pe * y + bulk) * p;
      t.b00 += pe * (w00 * q00 + w01 * q01) + bulk * q00;
      t.b11 += pe * (w10 * q01 + w11 * q11) + bulk * q11;
      t.b01 += pe * (w00 * q01 + w01 * q11) + bulk * q01;
      t.a0 += pp * (q00 * d[3] + q01 * d[4]);
      t.a1 += pp * (q01 * d[3] + q11 * d[4]);
    }
  }

  /// T + wJ as tensions, V wJ J G⁻¹, in the order of the state; what is crushed fades as in put_total_tensions().
  [[gnu::always_inline]] static inline void total_tensions(const Work& work, std::size_t i, P k, P total[6]) {
    const Spoke<P>&from = work.spoke[i], &to = work.spoke[i + 1];
    const FanTensions<P>& t = work.tensions[i];
    const P d = six_volumes(work, i), J = k * d, limit = P(min_remembered_J * min_remembered_J);
    const Mask<P> is_crushed = J * J < limit;
    const P fade = select(is_crushed, J * J / limit, P(1));
    const P scale = select(is_crushed, t.u * (J / limit * k), t.u) / select(is_crushed, P(1), d);
    P n[3];  // the cofactors of G are products of those of the edges: n, c1, −c0
    cross(from.b, to.b, n);
    total[0] = fade * t.aa + scale * dot(n, n);
    total[1] = fade * t.b00 + scale * dot(to.c, to.c);
    total[2] = fade * t.b11 + scale * dot(from.c, from.c);
    total[3] = fade * t.a0 + scale * dot(n, to.c);
    total[4] = fade * t.a1 - scale * dot(n, from.c);
    total[5] = fade * t.b01 - scale * dot(from.c, to.c);
  }

  /// T += Σ_branches (decay Q + gain (T − T0)); the next state is Q⁺ = decay Q + gain (T − T0), T0⁺ = T.
  static void add_relaxation(const FanTerms<Real>& terms, const Group& group, Work& work, const Real* state,
                             Real* next) {
    const P whole = terms.weight + Real(1);
    state += terms.viscous_state * lanes, next += terms.viscous_state * lanes;
    for (std::size_t i = 1; i <= group.m; ++i, state += terms.state * lanes, next += terms.state * lanes) {
      const P k = pack_at<P>(group.rest + ((i - 1) * terms.constants + 4) * lanes);
      FanTensions<P>& t = work.tensions[i];
      P total[6];
      total_tensions(work, i, k, total);
      P* entries[6] = {&t.aa, &t.b00, &t.b11, &t.a0, &t.a1, &t.b01};
      for (std::size_t c = 0; c < 6; ++c) {
        const P before = pack_at<P>(state + c * lanes);
        put(next + c * lanes, total[c]);
        P fixed = P(0);
        for (std::size_t b = 0; b < terms.branch_count; ++b) {
          const P decay = terms.branches[b].decay, gain = terms.branches[b].gain;
          const std::size_t at = (6 * (b + 1) + c) * lanes;
          const P left = decay * pack_at<P>(state + at) - gain * before;
          put(next + at, left + gain * total[c]);
          fixed += left;
        }
        *entries[c] = whole * *entries[c] + fixed;
      }
      t.u *= whole;
    }
  }

  [[gnu::always_inline]] static inline void put(Real* to, P value) { __builtin_memcpy(to, &value.v, sizeof value.v); }

  /// u −= p_t/6 with p_t the mean of the pressures of four nodes, which their records hold behind the position.
  static void add_pressure(const Group& group, Work& work, const Real* records, const std::uint16_t* index) {
    const auto at = [records](const std::uint16_t* nodes) {
      Real of_lane[lanes];
      for (std::size_t l = 0; l < lanes; ++l) of_lane[l] = records[nodes[l] + 3];
      return pack_at<P>(of_lane);
    };
    const P axis = at(index) + at(index + lanes), first = at(group.ring), scale = P(-1.0 / 24);
    P from = first;
    for (std::size_t i = 1; i <= group.m; ++i) {
      const P to = i == group.ring_nodes ? first : at(group.ring + i * lanes);
      work.tensions[i].u += scale * (axis + (from + to));
      from = to;
    }
  }

  /// T += Ta/6 m* m*ᵀ, reversed.
  static void add_active(const FanTerms<Real>& terms, const Group& group, Work& work) {
    const P scale = terms.active * Real(-1.0 / 6);
    const Real* constant = group.rest + terms.fibre_constant * lanes;
    for (std::size_t i = 1; i <= group.m; ++i, constant += terms.constants * lanes) {
      const P a = pack_at<P>(constant), b0 = pack_at<P>(constant + lanes), b1 = pack_at<P>(constant + 2 * lanes);
      const P sa = scale * a, s0 = scale * b0;
      FanTensions<P>& t = work.tensions[i];
      t.aa += sa * a, t.b00 += s0 * b0, t.b11 += scale * b1 * b1;
      t.a0 += sa * b0, t.a1 += sa * b1, t.b01 += s0 * b1;
    }
  }

  /// add_viscosity() of rest shapes that have flowed.
  static void add_flowed_viscosity(const FanTerms<Real>& terms, const Group& group, Work& work,
                                   const FanMemory<Real>& memory) {
    const Real *state = memory.state, *shape = memory.shape;
    Real* next = memory.next;
    for (std::size_t i = 1; i <= group.m; ++i, state += terms.state * lanes, next += terms.state * lanes) {
      const P k = pack_at<P>(group.rest + ((i - 1) * terms.constants + 4) * lanes);
      P G[6], dG[6], T[6];
      entries_of(gram(group, work, i), G);
      RestShape<P> rest;
      rest.volume = P(1.0 / 6) / k;
      for (std::size_t c = 0; c < 6; ++c) {
        rest.A[c] = k * pack_at<P>(shape + c * lanes);
        dG[c] = G[c] - pack_at<P>(state + c * lanes);
        T[c] = P(0);
        put(next + c * lanes, G[c]);
      }
      shape += fan_flow_numbers * lanes;
      add_viscous_tensions<P>(dG, rest, terms.eta, terms.zeta, terms.per_step, T);
      FanTensions<P>& t = work.tensions[i];
      P* entries[6] = {&t.aa, &t.b00, &t.b11, &t.a0, &t.a1, &t.b01};
      for (std::size_t c = 0; c < 6; ++c) *entries[c] -= T[c];
    }
  }

  static void add_terms(const FanTerms<Real>& terms, const Group& group, Work& work, const FanMemory<Real>& memory,
                        const Real* records, const std::uint16_t* index, Mask<P>& valid) {
    if (terms.branch_count > 0) add_relaxation(terms, group, work, memory.state, memory.next);
    if (terms.viscous_state > 0 && terms.flows)
      add_flowed_viscosity(terms, group, work, memory);
    else if (terms.viscous_state > 0)
      add_viscosity(terms, group, work, memory.state, memory.next);
    if (terms.pressure)
      add_pressure(group, work, records, index);
    else if (terms.has_volume)
      add_volume(terms, group, work, valid);
    if (terms.active != 0) add_active(terms, group, work);
  }

  [[gnu::noinline]] static bool block(LawTensions tensions, void* law, const FanBlock<Real>& block,
                                      const FanTerms<Real>& terms, FanMemory<Real> memory, const Real* x, Real* f) {
    alignas(64) Real records[8 * max_block_nodes];
    read_records<Isa>(block, x, records);
    if (terms.pressure)
      for (std::size_t n = 0; n < block.nodes; ++n) records[8 * n + 3] = terms.pressure[block.place[n] / 3];
    const std::uint16_t* index = block.index;
    const Real* shape = block.shape;
    Mask<P> valid = true;
    Work work;
    for (Spoke<P>& spoke : work.spoke) spoke = {};
    for (std::size_t g = 0; g < block.groups; ++g) {
      const FanSize size = block.size[g];
      Group group{size.tets, size.ring, index + 2 * lanes, shape, shape + size.ring * lanes, {}, {}, {}};
      Stages::read_group(group, index, records, work);
      tensions(law, terms, group, memory.shape, memory.beyond, work, valid);
      add_terms(terms, group, work, memory, records, index, valid);
      P axis = 0;
      for (std::size_t i = 1; i <= group.m; ++i) axis += work.tensions[i].aa;
      Stages::close_ring(group, work);
      Stages::add_forces(group, index, axis, work, records);
      index += (2 + size.ring) * lanes;
      shape += (size.ring + size.tets * terms.constants) * lanes;
      memory.state += size.tets * terms.state * lanes, memory.next += size.tets * terms.state * lanes;
      if (terms.flows) memory.shape += size.tets * fan_flow_numbers * lanes, memory.beyond += size.tets * lanes;
    }
    write_forces<Isa>(block, records + 4, f);
    return valid.all();
  }

  static void volumes(const FanBlock<Real>& block, std::size_t constants, const Real* x, Real* sum) {
    alignas(64) Real records[8 * max_block_nodes];
    read_records<Isa>(block, x, records);
    const std::uint16_t* index = block.index;
    const Real* shape = block.shape;
    const auto add = [&records](const std::uint16_t* nodes, P value) {
      for (std::size_t l = 0; l < lanes; ++l) records[nodes[l] + 4] += value.v[l];
    };
    Work work;
    for (Spoke<P>& spoke : work.spoke) spoke = {};
    for (std::size_t g = 0; g < block.groups; ++g) {
      const FanSize size = block.size[g];
      Group group{size.tets, size.ring, index + 2 * lanes, shape, shape + size.ring * lanes, {}, {}, {}};
      Stages::read_group(group, index, records, work);
      P of_tet[max_fan_tets + 2], whole = P(0);
      for (std::size_t i = 1; i <= group.m; ++i) whole += of_tet[i] = six_volumes(work, i) * P(1.0 / 6);
      of_tet[0] = of_tet[group.m + 1] = P(0);
      if (group.ring_nodes == group.m) of_tet[0] = of_tet[group.m];
      for (std::size_t i = 1; i <= group.ring_nodes; ++i) add(group.ring + (i - 1) * lanes, of_tet[i - 1] + of_tet[i]);
      add(index, whole);
      add(index + lanes, whole);
      index += (2 + size.ring) * lanes;
      shape += (size.ring + size.tets * constants) * lanes;
    }
    for (std::size_t n = 0; n < block.own; ++n) sum[block.place[n] / 3] = records[8 * n + 4];
    for (std::size_t n = block.own; n < block.nodes; ++n) block.shared_force[n - block.own] = records[8 * n + 4];
  }
};

/// The kernel of the law with that index in LawList.
template <class Real, class Isa>
FanTermKernel<Real> term_kernel(std::size_t law, bool continued) {
  using Stages = TermStages<Real, Isa>;
  using P = typename Stages::P;
  FanTermKernel<Real> kernel = nullptr;
  visit_law(law, continued, [&]<class Tag, bool with>(Tag, std::bool_constant<with>) {
    using One = typename Tag::template Law<Real, with>;
    using Many = typename Tag::template Law<P, with>;
    kernel = [](const void* scalar, const FanBlock<Real>& block, const FanTerms<Real>& terms, FanMemory<Real> memory,
                const Real* x, Real* f) {
      Many many = broadcast<Many, P>(*static_cast<const One*>(scalar));
      typename Stages::LawTensions tensions = &Stages::template law_tensions<Many>;
      if constexpr (Many::has_volume_term && !Many::uses_I4)
        if (terms.flows) tensions = &Stages::template flowed_law_tensions<Many>;
      return Stages::block(tensions, &many, block, terms, memory, x, f);
    };
  });
  return kernel;
}

template <class Real, class Isa, bool with_fibre>
bool energy_term_block(const void* law, const FanBlock<Real>& block, const FanTerms<Real>& terms,
                       FanMemory<Real> memory, const Real* x, Real* f) {
  using Stages = TermStages<Real, Isa>;
  using P = typename Stages::P;
  Mask<P> defined = true;
  const auto* numbers = static_cast<const InvariantEnergy<Real, false, with_fibre>*>(law);
  NotingEnergy<P, with_fibre> noting{numbers->template broadcast<P>(), &defined};
  const bool valid =
      Stages::block(&Stages::template law_tensions<NotingEnergy<P, with_fibre>>, &noting, block, terms, memory, x, f);
  return valid && defined.all();
}

template <class Real, class Isa>
FanTermKernel<Real> energy_term_kernel(bool with_fibre) {
  return with_fibre ? energy_term_block<Real, Isa, true> : energy_term_block<Real, Isa, false>;
}

template <class Real, class Isa>
FanTermKernels<Real> term_kernels() {
  return {term_kernel<Real, Isa>, energy_term_kernel<Real, Isa>, TermStages<Real, Isa>::volumes};
}

}  // namespace heml::fan
