#pragma once
// The loops of viscosity and relaxation over a group of elements (elastic/viscoelastic_term.hpp). They give the bits of
// the functions of one slot.
#include <algorithm>
#include <cmath>
#include <heml/elastic/avx2_dispatch.hpp>
#include <heml/elastic/group_term.hpp>
#include <heml/elastic/remembered_tensions.hpp>
#include <span>

namespace heml {

/// A term's parameters and state during a step. law: packet_tensions() of the isochoric law in the packets that are
/// evaluated; null without branches, of which there are then none.
template <class Real>
struct MemoryOf {
  Real eta, zeta, per_step, weight;
  std::size_t stride;
  std::span<const RelaxationBranch<Real>> branches;
  const Real* law = nullptr;
};

/// T and wJ of the law in one lane.
template <class Real>
[[gnu::always_inline]] inline Real law_entry(const Real* law, std::size_t packet, std::size_t i, std::size_t l) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  return law[lanes * (tension_entries * packet + i) + l];
}

/// Adds the tensions that are constant during a step: Σ_branches (decay Q − gain T_iso) of a slot's committed state.
template <class Real>
[[gnu::always_inline]] inline void add_fixed_tensions(std::span<const RelaxationBranch<Real>> branches,
                                                      const Real* of_slot, Real T[6]) {
  for (std::size_t b = 0; b < branches.size(); ++b)
    for (std::size_t i = 0; i < 6; ++i)
      T[i] += branches[b].decay * of_slot[12 + 6 * b + i] - branches[b].gain * of_slot[6 + i];
}

/// V/h (η/4 |ΔC|² + ζ/8 (tr ΔC)²) + ½ T*:G of an element, T* its constant tensions.
template <class Real>
[[gnu::always_inline]] inline Real memory_energy(const Real dG[6], const Real fixed[6], const Real G[6],
                                                 const RestShape<Real>& rest, Real eta, Real zeta, Real per_step) {
  Real factor[3][3], dC[6];
  cholesky3(rest.A, factor);
  into_rest_frame(factor, dG, dC);
  const Real trace = dC[0] + dC[1] + dC[2];
  return rest.volume * per_step * (eta / 4 * double_contraction3(dC, dC) + zeta / 8 * trace * trace) +
         double_contraction3(fixed, G) / 2;
}

/// In the order of ViscoelasticTerm::tensions(), so that both give the same bits.
template <bool relaxes, class Real>
[[gnu::always_inline]] inline void memory_forces(const MemoryOf<Real>& of, const ElementGroup<Real>& group,
                                                 const Real* x, const Real* state, std::size_t begin, std::size_t end,
                                                 Real* corner, bool add) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  for (std::size_t p = begin; p < end; ++p) {
    const Packet<Real, false> packet(group, x, p * lanes);
    Real before[6][lanes], fixed[6][lanes], law[tension_entries][lanes], out[12][lanes];
    for (std::size_t l = 0; l < lanes; ++l) {
      const Real* of_slot = state + of.stride * (p * lanes + l);
      for (std::size_t i = 0; i < 6; ++i) before[i][l] = of_slot[i];
      Real sum[6] = {};
      if constexpr (relaxes) add_fixed_tensions(of.branches, of_slot, sum);
      for (std::size_t i = 0; relaxes && i < 6; ++i) fixed[i][l] = sum[i];
      for (std::size_t i = 0; relaxes && i < tension_entries; ++i) law[i][l] = law_entry(of.law, p - begin, i, l);
    }
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      const Corners<Real> at(packet.x, l);
      const RestShape<Real> rest = packet.rest(l);
      const auto kinematics =
          element_kinematics<false, relaxes, false, false>(at.x[0], at.x[1], at.x[2], at.x[3], rest);
      Real dG[6], f[12];
      Tensions<Real> t{};
      for (std::size_t i = 0; i < 6; ++i) {
        dG[i] = kinematics.G[i] - before[i][l];
        if constexpr (relaxes) t.T[i] = fixed[i][l] + of.weight * law[i][l];
      }
      if constexpr (relaxes) t.wJ = of.weight * law[6][l];
      add_viscous_tensions(dG, rest, of.eta, of.zeta, of.per_step, t.T);
      forces_from_tensions<relaxes>(t, kinematics.e, kinematics.cross, f);
      for (int i = 0; i < 12; ++i) out[i][l] = f[i];
    }
    write_packet_corners(out, corner + 3 * (group.first_corner + 4 * p * lanes), add);
  }
}

template <class Real>
HEML_WIDE void wide_memory_forces(const MemoryOf<Real>& of, const ElementGroup<Real>& group, const Real* x,
                                  const Real* state, std::size_t begin, std::size_t end, Real* corner, bool add) {
  if (of.law)
    memory_forces<true>(of, group, x, state, begin, end, corner, add);
  else
    memory_forces<false>(of, group, x, state, begin, end, corner, add);
}

/// What a packet's elements remember: Gram matrices, and the tensions that are constant during a step.
template <class Real>
struct PacketMemory {
  static constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  Real before[6][lanes], fixed[6][lanes];

  [[gnu::always_inline]] PacketMemory(const MemoryOf<Real>& of, const Real* state, std::size_t packet) {
    for (std::size_t l = 0; l < lanes; ++l) {
      const Real* of_slot = state + of.stride * (packet * lanes + l);
      Real sum[6] = {};
      add_fixed_tensions(of.branches, of_slot, sum);
      for (std::size_t i = 0; i < 6; ++i) before[i][l] = of_slot[i], fixed[i][l] = sum[i];
    }
  }
};

/// Adds V/h (η (A_ab B + u_b u_aᵀ) + ζ u_a u_bᵀ), u_a = Σ_b A_ab e_b, B = Σ_a u_a e_aᵀ = F Fᵀ: the second derivatives
/// of V/h (η/4 |ΔC|² + ζ/8 (tr ΔC)²) by the edges, but for those in the tensions.
template <class Real>
[[gnu::always_inline]] inline void add_viscous_stiffness(const Real e[3][3], const RestShape<Real>& rest, Real eta,
                                                         Real zeta, Real per_step, Real K[edge_entries]) {
  const Real* A = rest.A;
  const Real a[3][3] = {{A[0], A[3], A[4]}, {A[3], A[1], A[5]}, {A[4], A[5], A[2]}};
  Real u[3][3], B[3][3];
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) u[k][i] = a[k][0] * e[0][i] + a[k][1] * e[1][i] + a[k][2] * e[2][i];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) B[i][j] = u[0][i] * e[0][j] + u[1][i] * e[1][j] + u[2][i] * e[2][j];
  const Real shear = rest.volume * per_step * eta, bulk = rest.volume * per_step * zeta;
  for (int r = 0, at = 0; r < 9; ++r)
    for (int c = 0; c <= r; ++c, ++at) {
      const int k = r / 3, i = r % 3, l = c / 3, j = c % 3;
      K[at] += shear * (a[k][l] * B[i][j] + u[l][i] * u[k][j]) + bulk * (u[k][i] * u[l][j]);
    }
}

struct MemoryFamily {};
template <class Real>
using MemoryPack = Pack<Real, static_cast<int>(32 / sizeof(Real)), MemoryFamily>;

/// `scale` times the stiffness without the law's part, into K or added to it.
template <class Real>
HEML_WIDE void wide_memory_stiffness(const MemoryOf<Real>& of, const ElementGroup<Real>& group, const Real* x,
                                     const Real* state, std::size_t begin, std::size_t end, Real scale, Real* K,
                                     bool add) {
  using P = MemoryPack<Real>;
  constexpr std::size_t lanes = ElementGroup<Real>::lanes, width = P::lanes;
  const auto pack_of = [](const Real* values) {
    typename P::Vector v;
    __builtin_memcpy(&v, values, sizeof v);
    return P(v);
  };
  for (std::size_t p = begin; p < end; ++p) {
    const Packet<Real, false> packet(group, x, p * lanes);
    const PacketMemory<Real> memory(of, state, p);
    for (std::size_t first = 0; first < lanes; first += width) {
      const PackedElements<P, false> at(packet, first);
      const auto kinematics =
          element_kinematics<false, false, false, false>(at.x[0], at.x[1], at.x[2], at.x[3], at.rest);
      P dG[6], k[edge_entries];
      Tensions<P> t{};
      for (std::size_t i = 0; i < 6; ++i) {
        dG[i] = kinematics.G[i] - pack_of(memory.before[i] + first);
        t.T[i] = pack_of(memory.fixed[i] + first);
      }
      add_viscous_tensions<P>(dG, at.rest, of.eta, of.zeta, of.per_step, t.T);
      for (P& entry : k) entry = P(0);
      add_viscous_stiffness<P>(kinematics.e, at.rest, of.eta, of.zeta, of.per_step, k);
      add_geometric_stiffness(t, kinematics.e, k);
      for (P& entry : k) entry *= P(scale);
      write_packed_stiffness(k, p, first, K, add);
    }
  }
}

/// `scale` times the incremental potential without the law's part of each packet, J.
template <class Real>
HEML_WIDE void wide_memory_energies(const MemoryOf<Real>& of, const ElementGroup<Real>& group, const Real* x,
                                    const Real* state, std::size_t begin, std::size_t end, double scale,
                                    double* of_packet, bool add) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  for (std::size_t p = begin; p < end; ++p) {
    const Packet<Real, false> packet(group, x, p * lanes);
    const PacketMemory<Real> memory(of, state, p);
    Real of_slot[lanes];
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      const Corners<Real> at(packet.x, l);
      const RestShape<Real> rest = packet.rest(l);
      const auto kinematics = element_kinematics<false, false, false, false>(at.x[0], at.x[1], at.x[2], at.x[3], rest);
      Real dG[6], fixed[6];
      for (std::size_t i = 0; i < 6; ++i) dG[i] = kinematics.G[i] - memory.before[i][l], fixed[i] = memory.fixed[i][l];
      of_slot[l] = memory_energy(dG, fixed, kinematics.G, rest, of.eta, of.zeta, of.per_step);
    }
    double sum = add ? of_packet[p] : 0.0;
    const std::size_t used = std::min(lanes, group.size() - p * lanes);  // padding repeats the last element
    for (std::size_t l = 0; l < used; ++l) sum += scale * static_cast<double>(of_slot[l]);
    of_packet[p] = sum;
  }
}

/// The total tensions T of a slot replace those before; the branches follow their change.
template <class Real>
[[gnu::always_inline]] inline void store_tensions(std::span<const RelaxationBranch<Real>> branches, const Real T[6],
                                                  Real* of_slot) {
  for (std::size_t b = 0; b < branches.size(); ++b) {
    Real* Q = of_slot + 12 + 6 * b;
    for (std::size_t i = 0; i < 6; ++i) Q[i] = branches[b].decay * Q[i] + branches[b].gain * (T[i] - of_slot[6 + i]);
  }
  std::copy_n(T, 6, of_slot + 6);
}

/// Stores what the next step starts from: Gram matrices at x, and of the branches their tensions.
template <bool relaxes, class Real>
[[gnu::always_inline]] inline void store_memory(const MemoryOf<Real>& of, const ElementGroup<Real>& group,
                                                const Real* x, std::size_t begin, std::size_t end, Real* state) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  for (std::size_t p = begin; p < end; ++p) {
    const Packet<Real, false> packet(group, x, p * lanes);
    Real G[6][lanes], T[6][lanes] = {};
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      const Corners<Real> at(packet.x, l);
      const auto kinematics =
          element_kinematics<false, relaxes, false, false>(at.x[0], at.x[1], at.x[2], at.x[3], packet.rest(l));
      for (int i = 0; i < 6; ++i) G[i][l] = kinematics.G[i];
      if constexpr (relaxes) {
        Tensions<Real> law;
        Real total[6];
        for (std::size_t i = 0; i < 6; ++i) law.T[i] = law_entry(of.law, p - begin, i, l);
        law.wJ = law_entry(of.law, p - begin, 6, l);
        put_total_tensions(law, kinematics.cross, kinematics.at.J, packet.volume[l], total);
        for (int i = 0; i < 6; ++i) T[i][l] = total[i];
      }
    }
    for (std::size_t l = 0; l < lanes; ++l) {
      Real* of_slot = state + of.stride * (p * lanes + l);
      Real total[6];
      for (std::size_t i = 0; i < 6; ++i) of_slot[i] = G[i][l], total[i] = T[i][l];
      if constexpr (relaxes) store_tensions(of.branches, total, of_slot);
    }
  }
}

template <class Real>
HEML_WIDE void wide_store_memory(const MemoryOf<Real>& of, const ElementGroup<Real>& group, const Real* x,
                                 std::size_t begin, std::size_t end, Real* state) {
  if (of.law)
    store_memory<true>(of, group, x, begin, end, state);
  else
    store_memory<false>(of, group, x, begin, end, state);
}

/// Calls work(begin, end, tensions of the law there) for runs of packets whose tensions stay in the cache.
template <class Real, class Work>
void each_run_with_law(const GroupTerm<Real>& law, const ElementGroup<Real>& group, const Real* x, std::size_t begin,
                       std::size_t end, const Work& work) {
  constexpr std::size_t run = 8, lanes = ElementGroup<Real>::lanes;
  Real of_packets[run * tension_entries * lanes];
  for (std::size_t p = begin; p < end; p += run) {
    const std::size_t last = std::min(p + run, end);
    law.packet_tensions(group, x, p, last, of_packets);
    work(p, last, of_packets);
  }
}

/// Writes bounds of the damping of packets [begin, end), 1/s, into bounds (8 a packet), or adds them:
/// uᵀDu = V/2 (η |dC|² + ζ/2 (tr dC)²).
template <class Real>
[[gnu::always_inline]] inline void viscous_bounds(const MemoryOf<Real>& of, const ElementGroup<Real>& group,
                                                  const Real* weights, const Real* x, std::size_t begin,
                                                  std::size_t end, Real* bounds, bool add) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  for (std::size_t p = begin; p < end; ++p, bounds += lanes) {
    const Packet<Real, false> packet(group, x, p * lanes);
    const PacketWeights<Real> of_corners(group, weights, p);
    Real bound[lanes];
#pragma GCC ivdep
    for (std::size_t l = 0; l < lanes; ++l) {
      const Corners<Real> at(packet.x, l);
      const RestShape<Real> rest = packet.rest(l);
      const auto kinematics = element_kinematics<true, true, false, false>(at.x[0], at.x[1], at.x[2], at.x[3], rest);
      bound[l] = 4 / group.density *
                 (2 * of.eta * stretch_bounds(kinematics.at).max * max_gradient(rest.A, of_corners.at(l)) +
                  of.zeta / 4 * corner_sums(kinematics, rest, of_corners.at(l)).n1);
    }
    for (std::size_t l = 0; l < lanes; ++l) bounds[l] = (add ? bounds[l] : 0) + bound[l];
  }
}

template <class Real>
HEML_WIDE void wide_viscous_bounds(const MemoryOf<Real>& of, const ElementGroup<Real>& group, const Real* weights,
                                   const Real* x, std::size_t begin, std::size_t end, Real* bounds, bool add) {
  viscous_bounds(of, group, weights, x, begin, end, bounds, add);
}

}  // namespace heml
