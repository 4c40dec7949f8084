#pragma once
// Contact in implicit steps and statics: an energy that solvers minimise with all others.
//
//   out of a surface   k/2 gap² where gap < 0; k is that of a node, m ω² of the body's highest frequency, and becomes
//                      stiffer until no point of a solution is deeper inside than a bound (exterior penalty with
//                      continuation: J. Nocedal, S. Wright, Numerical Optimization, 2006, 17.1). It is defined
//                      everywhere, so that a tool may be pushed into tissue first and the solver finds the way out.
//   along it           Coulomb's friction as a spring of the same k from where a point stuck, which slips where it
//                      would bear more than μ N (P. Wriggers, Computational Contact Mechanics, 2006, 5.2): Huber's
//                      function, smooth and convex. N is that of the last solution; where it differs from the new
//                      one's, the problem is solved again (revise()).
//
// What sticks at rest does not creep: the spring is kept from step to step.
//
// Which pairs of tissue and tissue are in contact (self_contact.hpp) is settled while a problem is solved, so that its
// energy has no jumps: those that touch when a step begins, and those that a solution has let cross, for which it is
// solved again. So nothing tunnels, however far it goes in a step.
#include <heml/dynamics/objective.hpp>
#include <heml/tools/contacts.hpp>

namespace heml {

class ContactPotential {
 public:
  /// contacts must outlive this. bound: m. stiffness, before anything else: #V, N/m, of a point at each node; 0 where
  /// it is held.
  ContactPotential(Contacts& contacts, double bound) : contacts_(contacts), bound_(bound) {}
  void set_stiffness(std::vector<double> stiffness) { stiffness_ = std::move(stiffness); }

  bool empty() const { return contacts_.empty(); }

  /// A step, or an increment of load, begins at x, 3 #V, at a time, s: friction counts ways from here. What an attempt
  /// that came to nothing had assumed is forgotten.
  void begin(const Vector& x, double time);
  /// There are other surfaces now: what was known of any is forgotten.
  void reset();
  /// From now on tissue passes tissue.
  void disable_self_contact() { with_tissue_ = false; }
  /// Surfaces are where they are at a time, s, from now on; friction is assumed as it was at the step's start.
  void set_time(double time);

  /// Whether tissue has gone through a probe on its way to x from where it was linearised last, or begun: solvers
  /// step as far as they see fit, and on the other side nothing would push it back.
  bool passes(const Vector& x) const;
  double value(const Vector& x);
  void add_forces(const Vector& x, Vector& f);
  /// Finds the stiffness at x, which the calls below are about. It is never negative.
  void linearise(const Vector& x);
  void add_product(const Vector& dx, Vector& out) const;
  /// Calls visit(node, node, block, 3×3) for pairs of nodes of one face, each pair once, and for single ones; of a
  /// thread and of two pieces of tissue, which share no element, for each node alone.
  template <class Visit>
  void each_block(const Visit& visit) const;

  /// Whether no block joins nodes that share no element.
  bool within_elements() const;

  /// Whether what was assumed of a solution x does not hold of it: then it is assumed anew, and x is to be solved
  /// again.
  bool update_lagged(const Vector& x);
  /// Keeps a solution, and tells the contacts of it.
  void accept(const Vector& x);

 private:
  struct ActiveContact {
    std::size_t surface;
    ContactPoint point;
  };
  struct Friction {
    ActiveContact touch;
    double most;   ///< N
    Vec3 stretch;  ///< m, of the spring at the step's start
  };
  struct Block {
    ContactPoint point;
    Mat3 K;
  };
  void find(const Vector& x);
  bool meet(const Vector& x);
  double stiffness_of(const ContactPoint& point) const;
  double normal_stiffness(const ActiveContact& touch) const;
  Vec3 sliding(const Friction& friction, const Vector& x) const;
  Vec3 friction_force(const Friction& friction, const Vector& x) const;
  std::vector<Friction> friction_of_touches() const;

  Contacts& contacts_;
  std::vector<double> stiffness_;
  double bound_;
  std::vector<double> stiffer_;  ///< of each surface, times
  std::vector<Friction> friction_, accepted_;
  std::vector<ContactSurface> surfaces_, surfaces_before_;
  bool with_tissue_ = true;
  std::vector<ContactPair> pairs_;  ///< of tissue, in contact or as good as; ascending
  Vector x_before_, touches_at_, x_seen_;
  std::vector<ActiveContact> active_;  ///< where touches_at_ is
  std::vector<Block> blocks_;
  int revisions_ = 0;
};

template <class Visit>
void ContactPotential::each_block(const Visit& visit) const {
  for (const auto& [point, K] : blocks_)
    for (std::size_t a = 0; a < static_cast<std::size_t>(point.count); ++a)
      for (std::size_t b = 0; b <= a; ++b)
        if (const double weight = point.weights[a] * point.weights[b]; weight != 0 && (a == b || point.count == 3))
          visit(point.nodes[a], point.nodes[b], Mat3(weight * K));
}

}  // namespace heml
