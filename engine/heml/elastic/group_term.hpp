#pragma once
// One term of the energy of a group of elements, with its type erased. A material is a list of them: its law; a volume
// term where not the law's own; its memory (viscosity, relaxation).
//
// Loops over many elements are one virtual call; those of a uniform law are the vectorised ones of group_loops.hpp.
// What is asked of one slot at a time (parameters that differ between elements, assembly, memory) goes through the
// functions of a slot, from which the loops here are made.
#include <heml/elastic/group_loops.hpp>
#include <heml/elastic/slot_memory.hpp>
#include <heml/elastic/subelement_map.hpp>
#include <heml/materials/material.hpp>
#include <memory>
#include <vector>

namespace heml {

/// Sum over terms of S = 2 ∂W/∂C in the rest frame of the Cholesky factor of A (elastic/tension.hpp), and of wJ, Pa.
template <class Real>
struct StressSum {
  Real S[6] = {0, 0, 0, 0, 0, 0}, wJ = 0;

  /// S = L⁻¹ T L⁻ᵀ / V.
  void add(const Tensions<Real>& t, const RestShape<Real>& rest);
};

template <class Real>
class GroupTerm {
 public:
  using Group = ElementGroup<Real>;
  virtual ~GroupTerm() = default;

  // Of one slot, whose link is whole.
  virtual Tensions<Real> tensions(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                                  const RestShape<Real>& rest) const = 0;
  virtual Tensions<Real> tension_differential(const Group& group, std::size_t s,
                                              const ElementKinematics<Real>& kinematics, const RestShape<Real>& rest,
                                              const KinematicsDifferential<Real>& change) const = 0;
  /// A bound on λ_max(M_t⁻¹K_t), 1/s².
  virtual Real slot_frequency_bound(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                                    const RestShape<Real>& rest) const = 0;
  /// V W, J.
  virtual double energy(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                        const RestShape<Real>& rest) const = 0;
  /// Whether that energy is stored elastically, or the incremental potential of what remembers.
  virtual bool stores() const { return true; }
  virtual bool valid(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics) const = 0;
  /// Deviatoric principal Kirchhoff stresses at eigenvalues c of C, Pa.
  virtual void deviatoric_stress(const Group& group, std::size_t s, const Real c[3], Real J, Real tau[3]) const = 0;

  // Of packets [begin, end). Any number of threads on disjoint ranges.
  /// See group_forces().
  virtual bool forces(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real* corner,
                      bool add) const;
  /// See group_stiffness().
  virtual void stiffness(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real* K,
                         bool add) const;
  /// Sums of energy() over each packet into of_packet (#packets), overwritten or added to.
  virtual void energies(const Group& group, const Real* x, std::size_t begin, std::size_t end, double* of_packet,
                        bool add) const;
  /// Largest slot_frequency_bound().
  virtual Real frequency_bound(const Group& group, const Real* x, std::size_t begin, std::size_t end) const;
  /// The same of λ_max(M_t⁻¹D_t), 1/s, D the damping matrix of the term.
  virtual Real damping_bound(const Group&, const Real*, std::size_t, std::size_t) const { return 0; }

  // Terms that remember: a step of length h from what was committed last begins; what it reached is kept; all is
  // forgotten, the state x being one that has lasted.
  virtual void begin_step(Real) {}
  virtual void commit(const Group&, const Real*) {}
  virtual void reset_history(const Group&, const Real*) {}
  /// All that the term keeps of its slots from step to step; nothing for a law.
  virtual SlotMemories<Real> memory() = 0;
  /// An edit of the mesh: what slot s remembers is that of an element, of which it is a piece from now on, reshaped so.
  virtual void reshape(const std::vector<SubelementMap<Real>>&) {}
};

/// Writes or adds one slot's corner forces.
template <class Real>
void write_slot_forces(const Real f[12], const ElementGroup<Real>& group, std::size_t s, Real* corner, bool add) {
  Real* to = corner + 3 * (group.first_corner + 4 * s);
  for (int i = 0; i < 12; ++i) to[i] = add ? to[i] + f[i] : f[i];
}

/// Writes or adds one slot's stiffness (elastic/edge_stiffness.hpp).
template <class Real>
void write_edge_stiffness(const Real k[edge_entries], std::size_t s, Real* K, bool add) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  Real* to = K + edge_entries * lanes * (s / lanes) + s % lanes;
  for (std::size_t i = 0; i < edge_entries; ++i) to[lanes * i] = add ? to[lanes * i] + k[i] : k[i];
}

/// Reads it back.
template <class Real>
void read_edge_stiffness(const Real* K, std::size_t s, Real k[edge_entries]) {
  constexpr std::size_t lanes = ElementGroup<Real>::lanes;
  const Real* from = K + edge_entries * lanes * (s / lanes) + s % lanes;
  for (std::size_t i = 0; i < edge_entries; ++i) k[i] = from[lanes * i];
}

/// The terms of a material. without_volume: the isochoric part alone (elastic/nodal_pressure.hpp has the rest).
/// The material must be one that material_problem() has nothing against; none for a law that is no continuum.
template <class Real>
std::vector<std::unique_ptr<GroupTerm<Real>>> make_terms(const Material& material, bool continuation,
                                                         bool without_volume);

}  // namespace heml
