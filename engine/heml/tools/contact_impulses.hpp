#pragma once
// Contact in explicit steps by impulses: a normal impulse keeps a point of the body out of a surface, a Coulomb impulse
// opposes sliding (J. J. Moreau's time stepping: M. Jean, The non-smooth contact dynamics method, 1999). Masses are
// lumped, so the impulse of a node on a table has a closed form, independent of its neighbours:
//
//   first half    v½ = v + ½h a,   x = x₀ + h v½ would be inside  ──► v½ += p n/m, so that x lies on the surface
//   second half   v = v½ + ½h a of a point stopped above: inward  ──► v += p n/m, so that it is not
//
// The friction impulse is at most μ p and removes all sliding where that suffices: the point sticks. No contact
// stiffness has to be chosen, the stable step is unchanged, and a node penetrates by no more than round-off. A surface
// at rest adds no energy. A fast probe is checked at several positions along its path within a step. Friction draws
// sticking points back to their anchors (contact_memory.hpp). Points that share nodes: probe_impulses.hpp,
// self_contact_impulses.hpp.
#include <heml/tools/contact_memory.hpp>
#include <heml/tools/contacts.hpp>
#include <heml/tools/probe_impulses.hpp>
#include <heml/tools/self_contact_impulses.hpp>

namespace heml {

template <class Real>
class ContactImpulses {
 public:
  /// Restarts the averages: reported forces are means over the steps since this call.
  void begin_tick();
  /// Corrects x and v (#V×3, m and m/s) of the first half of a step from time_before to time_after (s). before: #V×3,
  /// m, positions at the step's start. inverse_mass: #V, 1/kg, 0 at constrained nodes. shrink: the integrator's damping
  /// divisor; it weights the impulses in the report.
  void first_half_step(Contacts& contacts, double time_before, double time_after, double shrink,
                       const std::vector<Real>& inverse_mass, const Real* before, Real* x, Real* v);
  /// Removes inward velocities of the points that the first half stopped, and updates the contacts' reports.
  void second_half_step(Contacts& contacts, const std::vector<Real>& inverse_mass, const Real* x, Real* v);

  /// What a step changes here and in the reports, so that it can be taken again.
  struct Record;
  void keep(const Contacts& contacts, Record& record) const;
  void restore(const Record& record, Contacts& contacts);
  /// Nodes of the contacts of the step that first_half_step() began; some may be there more than once.
  void list_nodes(std::vector<int>& nodes) const;

  /// What carries over from step to step. A step that does not begin where the last one ended starts without it.
  const ContactMemory& memory() const { return memory_; }
  void set_memory(ContactMemory memory) { memory_ = std::move(memory); }

 private:
  struct Stopped {
    std::size_t surface;
    ContactPoint point;
    Vec3 velocity;                 ///< m/s, of the surface
    Vec3 drift;                    ///< m/s, along the surface: friction adds it to the velocity of sliding
    double normal = 0;             ///< N s, accumulated in this half
    Vec3 friction = Vec3::Zero();  ///< N s, accumulated in this half
  };
  struct StepPath;
  void stop_points(const StepPath& path, std::size_t s, Contacts& contacts, Real* v);
  Stopped& stopped_at(const StepPath& path, std::size_t s, const ContactPoint& point);
  void push(Stopped& stopped, const ContactPoint& point, double closing, double weight,
            const std::vector<Real>& inverse_mass, Contacts& contacts, Real* v);
  std::size_t probe_surface(const Contacts& contacts) const { return contacts.tables.size(); }
  bool tissue_is_touched() const;
  bool takes_turns(const Contacts& contacts) const;
  void update_anchors(const Real* x);
  void publish(Contacts& contacts, const Real* x);

  void report_probe(double weight, Contacts& contacts, const Real* v);

  /// Since the tick began.
  struct Sums {
    double normal_impulse = 0;  ///< N s, of self-contact
    std::vector<Vec3> impulse;  ///< N s, of each surface
    std::vector<int> touching;  ///< points of each surface in contact, most in a step
    double duration = 0;        ///< s
  };

  SelfContactImpulses<Real> tissue_;
  ProbeImpulses<Real> probe_;
  ContactMemory memory_;
  std::vector<Stopped> stopped_;          ///< in the first half the last surface first
  Sums sums_;
  std::vector<ContactSurface> surfaces_;  ///< at the end of the step
};

template <class Real>
struct ContactImpulses<Real>::Record {
  ContactMemory memory;
  Sums sums;
  std::vector<ContactReport> reports;
};

}  // namespace heml
