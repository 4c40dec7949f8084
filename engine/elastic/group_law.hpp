#pragma once
// The loops over a group with the law's type erased: one virtual call for thousands of elements.
#include <heml/elastic/element_group.hpp>
#include <heml/materials/material.hpp>
#include <limits>
#include <memory>

namespace heml {

/// What a viewer may want to know of an element.
template <class Real>
struct ElementState {
  Real J;
  Real stretch;    ///< largest principal stretch
  Real von_mises;  ///< Pa, of the Cauchy stress
};

template <class Real>
class GroupLaw {
 public:
  virtual ~GroupLaw() = default;
  /// See group_forces(). Any number of threads on disjoint ranges.
  virtual bool forces(const ElementGroup<Real>& group, const Real* x, std::size_t begin, std::size_t end,
                      Real* corner) const = 0;
  /// Largest element_frequency_bound() of packets [begin, end), 1/s².
  virtual Real frequency_bound(const ElementGroup<Real>& group, const Real* x, std::size_t begin,
                               std::size_t end) const = 0;
  /// Σ V W over the group, J, summed in the order of slots.
  virtual double energy(const ElementGroup<Real>& group, const Real* x) const = 0;
  /// First slot where the law is not defined, or group.size().
  virtual std::size_t first_invalid(const ElementGroup<Real>& group, const Real* x) const = 0;
  /// One state a slot.
  virtual void states(const ElementGroup<Real>& group, const Real* x, ElementState<Real>* out) const = 0;
};

/// The material must be one that material_problem() has nothing against.
template <class Real>
std::unique_ptr<GroupLaw<Real>> make_group_law(const Material& material, bool continuation);

}  // namespace heml
