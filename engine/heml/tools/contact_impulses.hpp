#pragma once
// Contact in explicit steps: the impulse that keeps a point of the body out of a surface, and Coulomb's of friction
// (J. J. Moreau's time stepping: M. Jean, The non-smooth contact dynamics method, 1999). Masses are lumped, so a node
// on a table has its impulse in closed form, whatever its neighbours do:
//
//   first half    v½ = v + ½h a,   x = x₀ + h v½ would be inside  ──► v½ += p n/m, so that x lies on the surface
//   second half   v = v½ + ½h a, of what was stopped: inward      ──► v += p n/m, so that it is not
//
// and friction takes up to μ p of what slides, all of it where that is enough: what sticks, sticks. There is no
// stiffness to choose, the stable step is what it was, and a node is never inside by more than round-off. A surface at
// rest gives no energy. Points inside faces share nodes: those go round a few times. A probe that goes far in a step is
// met at several places on its way. Tissue that meets tissue: self_contact_impulses.hpp.
#include <heml/tools/contacts.hpp>
#include <heml/tools/self_contact_impulses.hpp>

namespace heml {

template <class Real>
class ContactImpulses {
 public:
  /// From here on forces are a mean over the steps to come.
  void begin_tick();
  /// Times are s, before and after the step. shrink: what the first half has divided velocities by, for damping.
  /// inverse_mass: #V, 1/kg. before: positions at the step's start, x: those after, v: velocities, 3 #V; x and v
  /// change.
  void first_half_step(Contacts& contacts, double time_before, double time_after, double shrink,
                       const std::vector<Real>& inverse_mass, const Real* before, Real* x, Real* v);
  void second_half_step(Contacts& contacts, const std::vector<Real>& inverse_mass, const Real* x, Real* v);

 private:
  struct Stopped {
    std::size_t surface;
    ContactPoint point;
    Vec3 velocity;  ///< m/s, of the surface
  };
  struct StepPath;  // of a step, or a part of it
  void stop_at(const StepPath& path, std::size_t s, Contacts& contacts, Real* v);
  void push(const Stopped& at, double closing, double weight, const std::vector<Real>& inverse_mass, Contacts& contacts,
            Real* v);
  void publish(Contacts& contacts, const Real* x) const;

  SelfContactImpulses<Real> tissue_;
  double normal_impulse_ = 0;  ///< N s, by tissue on tissue, since the tick began
  std::vector<Stopped> stopped_;
  std::vector<Vec3> impulse_;             ///< N s, of each surface, since the tick began
  double duration_ = 0;                   ///< s, likewise
  std::vector<ContactSurface> surfaces_;  ///< after the step
};

}  // namespace heml
