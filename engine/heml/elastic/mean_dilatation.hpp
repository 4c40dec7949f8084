#pragma once
// Mean dilatation of quadratic tetrahedra against locking: most of the volume term is evaluated at the mean volume
// ratio of an element, not at each of its four integration points q.
//     J̄ = Σ V_q J_q / V,  V = Σ V_q,  E = V κ̄ ψ(J̄),  p = κ̄ ψ'(J̄),  f = −p Σ V_q ∇J_q: the exact gradient of E.
//     K = (κ̄ ψ''/V) g gᵀ + p Σ V_q ∇²J_q,  g = Σ V_q ∇J_q: of one element, without coupling to others.
//
// The points keep κ − κ̄ = min(κ, 13/6 μ), the bulk modulus of Poisson's ratio 0.3, and the element takes the rest κ̄.
// With J̄ alone, a dilatation that varies linearly within an element would cost nothing, and conformal displacements,
// which bend without shear, are of that kind: a beam of one element across would be 50 % too soft.
#include <heml/base/shared.hpp>
#include <heml/elastic/group_loops.hpp>
#include <heml/elastic/outer_product.hpp>
#include <heml/elastic/step_weights.hpp>
#include <heml/math/bytes.hpp>
#include <vector>

namespace heml {

/// Stiffness of a quadratic element, indices [node][xyz].
template <class Real>
using QuadraticMatrix = Real[30][30];

/// κ of each slot (padded) of a group, Pa.
template <class Real>
std::vector<Real> volume_moduli(const ElementGroup<Real>& group, const Material& material);

/// Leaves the points of a material with a volume term their share of κ, in the material or in the group's parameters,
/// and returns the rest of each slot (padded), Pa.
template <class Real>
std::vector<Real> split_volume_modulus(Material& material, Shared<ElementGroup<Real>>& group);

/// Of the elements of one group, four consecutive slots each; two fill a packet. Threads may call the functions of
/// packets [begin, end) on disjoint ranges. x: positions of virtual corners.
template <class Real>
class MeanDilatation {
 public:
  using Group = ElementGroup<Real>;

  /// kappa: κ̄ of each slot (padded), Pa.
  MeanDilatation(std::vector<Real> kappa, VolumeTerm term, bool continuation)
      : kappa_(std::move(kappa)), term_(term), continuation_(continuation) {}

  /// Adds the forces (N) to the corner forces. Returns whether ψ is defined at every element.
  bool add_forces(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real* corner) const;
  /// Adds the energies (J) of each packet.
  void add_energies(const Group& group, const Real* x, std::size_t begin, std::size_t end, double* of_packet) const;
  /// Adds upper bounds of λ_max(M⁻¹K), 1/s², of the elements to those of their slots (8 a packet), over the factors of
  /// the elements (StepWeights).
  void add_frequency_bounds(const Group& group, const VirtualCorners<Real>& corners, const StepWeights<Real>& weights,
                            const Real* x, std::size_t begin, std::size_t end, Real* bounds) const;

  /// To be called before linearise().
  void resize(const Group& group) {
    pressure_.resize(group.volume.size() / 4);
    outer_.resize(group.volume.size() / 4);
  }
  /// Evaluates p and (κ̄ψ''/V) g gᵀ at x for the calls below, and adds p V_q ∇²J_q to the stiffness of every slot
  /// (elastic/edge_stiffness.hpp).
  void linearise(const Group& group, const Real* x, std::size_t begin, std::size_t end, Real* K);
  /// Negative ψ'' counts as 0 from here to the next linearise().
  void project();
  /// Adds −g (κ̄ψ''/V) gᵀdx to the forces at the nodes of each element, 30 an element of the body.
  void add_force_differential(const Group& group, const VirtualCorners<Real>& corners, const Real* dx,
                              std::size_t begin, std::size_t end, Real* of_element) const;
  /// Adds (κ̄ψ''/V) g gᵀ of the element whose first slot is given.
  void add_stiffness(std::size_t first_slot, QuadraticMatrix<Real>& K) const;
  /// (κ̄ψ''/V) g gᵀ of each element of the group.
  const OuterProduct<Real>* outer_products() const { return outer_.data(); }
  /// p of a slot at the point of linearise(), Pa.
  Real pressure(std::size_t s) const { return pressure_[s / 4]; }
  const Real* kappa() const { return kappa_.data(); }  ///< κ̄ of each slot, padded
  std::size_t bytes() const { return bytes_of(kappa_, pressure_, outer_); }

 private:
  struct Value {
    Real pressure, stiffness;  ///< p, Pa; κ̄ψ''/V, Pa/m³
  };
  Value value(const Group& group, const Real* x, std::size_t first_slot) const;

  std::vector<Real> kappa_;
  VolumeTerm term_;
  bool continuation_;
  // Of each element, at the point of linearise().
  std::vector<Real> pressure_;
  std::vector<OuterProduct<Real>> outer_;
};

}  // namespace heml
