#pragma once
// Viscosity and relaxation in tension form. Stresses of the past are stored as tensions, six numbers per element, since
// T_ab = V g_a·S g_b is linear in S with constants of the rest shape.
//
//   Kelvin–Voigt: S_v = η Ċ + ζ/2 tr(Ċ) I, so T_v = V (η A ΔG A + ζ/2 (A:ΔG) A) / h with ΔG the change of the Gram
//   matrix over the step. G depends on squared lengths alone, so rigid motion is not damped, whatever its rotation.
//   Relaxation (quasi-linear, Prony series on the isochoric part; Simo 1987): for every branch
//   Q⁺ = e^(−h/τ) Q + γ e^(−h/2τ) (T_iso⁺ − T_iso).
//
// Both are gradients of an incremental potential, so that implicit steps can minimise it: weight·V W_iso + ½ T*:G + V
// (η/4h |ΔC|² + ζ/8h (tr ΔC)²), T* the tensions that are constant during the step.
//
//   slot s:  G0[6] T0[6] Q0[6] Q1[6] ...   at the last commit()
//
// Where fans evaluate the forces of the group, they keep the state in their own layout (elastic/fan_state.hpp), and
// ElasticBody copies it here for everything else. Kernels of points (elastic/point_stages.hpp) read the state from here
// and write the next one beside it.
#include <heml/elastic/group_term.hpp>
#include <heml/elastic/point_terms.hpp>
#include <heml/math/bytes.hpp>

namespace heml {

template <class Real>
struct MemoryOf;

/// A branch of relaxation in a step of h seconds.
template <class Real>
RelaxationBranch<Real> branch_during(Real gamma, Real tau, Real h);

template <class Real>
class ViscoelasticTerm final : public GroupTerm<Real> {
 public:
  using Group = ElementGroup<Real>;

  /// law: the isochoric part of the material's law.
  ViscoelasticTerm(std::unique_ptr<GroupTerm<Real>> law, const Material& material);

  bool forces(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real* corner,
              bool add) const override;
  void stiffness(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real scale, Real* K,
                 bool add) const override;
  void energies(const Group& group, const Real* x, std::size_t begin, std::size_t end, double scale, double* of_packet,
                bool add) const override;
  Tensions<Real> tensions(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                          const RestShape<Real>& rest) const override;
  Tensions<Real> tension_differential(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                                      const RestShape<Real>& rest,
                                      const KinematicsDifferential<Real>& change) const override;
  Real slot_frequency_bound(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                            const RestShape<Real>& rest, const CornerWeights<Real>& weights) const override;
  void frequency_bounds(const Group& group, const Real* weights, const Real* x, std::size_t begin, std::size_t end,
                        Real* bounds, bool add) const override;
  void damping_bounds(const Group& group, const Real* weights, const Real* x, std::size_t begin, std::size_t end,
                      Real* bounds, bool add) const override;
  double energy(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                const RestShape<Real>& rest) const override;
  bool stores() const override { return false; }
  bool valid(const Group&, std::size_t, const ElementKinematics<Real>&) const override { return true; }
  /// Zero: plastic flow depends on the elastic law alone.

  /// h: s; 0: no time passes; infinite: fully relaxed.
  void begin_step(Real h) override;
  void commit(const Group& group, const Real* x) override;
  void reset_history(const Group& group, const Real* x) override;
  /// frequency_bound() leaves out the stress that the state holds, which the fans know (FanForces::state_bound()).
  void leave_state_to_fans() { in_fans_ = true; }
  /// What kernels of points need: the next state they write, which advance() makes the present one.
  void put_in_points(PointTerms<Real>& terms);
  void advance(const Group& group);
  std::size_t numbers_a_slot() const { return stride_; }
  std::size_t scratch_bytes() const { return bytes_of(next_); }
  SlotStates<Real> slot_states() override { return {{&state_, stride_}}; }
  void reshape(const std::vector<SubelementMap<Real>>& subelement_maps) override;
  /// Adds to a slot's state, `sign` times, what a commit at x would store of x itself: G0 and T0.
  void add_present(const Group& group, std::size_t s, const Real* x, Real sign, Real* state) const;
  Real* state_of(std::size_t s) { return &state_[stride_ * s]; }

 private:
  struct Branch {
    Real gamma, tau;
  };
  MemoryOf<Real> memory() const;
  Tensions<Real> fixed_tensions(std::size_t s) const;
  Real slot_state_bound(const Group& group, std::size_t s, const CornerWeights<Real>& weights) const;
  void add_viscous(const Real dG[6], const RestShape<Real>& rest, Real T[6]) const;
  void total_tensions(const Group& group, std::size_t s, const ElementKinematics<Real>& kinematics,
                      const RestShape<Real>& rest, Real T[6]) const;
  void strain_change(std::size_t s, const ElementKinematics<Real>& kinematics, Real dG[6]) const;

  std::unique_ptr<GroupTerm<Real>> law_;
  Real eta_, zeta_;  ///< Pa s
  std::vector<Branch> branches_;
  std::vector<RelaxationBranch<Real>> steps_;  ///< of branches_, during the step
  Real total_gamma_ = 0;
  Real per_step_ = 0;        ///< 1/h
  Real weight_ = 0;          ///< Σ gain
  std::size_t stride_ = 12;  ///< values per slot of state_
  std::vector<Real> state_, next_;  ///< next_: as kernels of points have written it, else empty or of any content
  bool in_fans_ = false;
};

}  // namespace heml
