#pragma once
// Contact in implicit steps and statics: an energy that solvers minimise together with the others.
//
//   normal       k/2 gap² where gap < 0. k starts as the node's m ω², ω the body's highest frequency, and is raised
//                until no point of a solution penetrates by more than a bound (exterior penalty with continuation:
//                J. Nocedal, S. Wright, Numerical Optimization, 2006, 17.1). It is defined at any penetration, so a
//                tool may be placed inside tissue and the solver finds the way out.
//   tangential   Coulomb friction as a spring from the point of sticking, which slips where its force would exceed μ N
//                (P. Wriggers, Computational Contact Mechanics, 2006, 5.2): a Huber function, smooth and convex. Its
//                stiffness is that of the nodes, or less where a light contact would slip at once. Where it slips,
//                Newton's method is given the stiffness of a primal-dual method (update_duals()). N is lagged: where
//                the new solution's N differs, the problem is solved again (update_lagged()). Springs persist from
//                step to step, so sticking contacts do not creep.
//
// The set of self-contact pairs (self_contact.hpp) is constant during a solve, so that the energy has no jumps. It
// holds the pairs that touch when the step begins; pairs that cross in a solution are added and the problem is solved
// again, so nothing tunnels, however large the step.
#include <heml/dynamics/objective.hpp>
#include <heml/tools/contacts.hpp>
#include <heml/tools/face_slide.hpp>
#include <heml/tools/pair_slide.hpp>

namespace heml {

/// What the contact energy remembers of the steps so far, and of the solve under way.
class ContactPotentialMemory {
 protected:
  struct ActiveContact {
    std::size_t surface;
    ContactPoint point;
    int side = 0;  ///< ContactPair::side
  };
  struct Friction {
    ActiveContact touch;
    double max_force;  ///< N
    Vec3 stretch;      ///< m, of the spring at the step's start
    Vec3 dual;         ///< N, what the linear model makes of the spring's force, at most max_force; for linearise()
    Vec3 slid;         ///< m, at the last linearise()
  };
  struct Block {
    ContactPoint point;
    Mat3 K;
  };

  std::vector<double> stiffness_;         ///< #V, N/m
  std::vector<double> stiffness_factor_;  ///< factor on the penalty stiffness, per surface
  std::vector<Friction> friction_, accepted_;
  std::vector<ContactSurface> surfaces_, surfaces_before_;
  bool with_tissue_ = true;
  std::vector<ContactPair> pairs_;  ///< of self-contact, constant during a solve; ascending
  std::vector<ContactPair> bearing_;  ///< those that bore a load when the last step ended; ascending
  Vector x_before_, touches_at_, x_seen_;
  std::vector<ActiveContact> active_;  ///< at positions touches_at_
  std::vector<Block> blocks_;
  std::vector<std::array<int, 4>> seen_;  ///< nodes of the faces and pairs in contact at the last linearise()
  std::vector<RankOneTerm> slides_;
  int revisions_ = 0;
  double step_taken_ = 0;  ///< since the last linearise(), of Newton's
};

class ContactPotential : private ContactPotentialMemory {
 public:
  /// contacts must outlive this object. bound: m, accepted penetration. set_stiffness() must be called first: #V, N/m,
  /// penalty stiffness per node, 0 at constrained nodes.
  ContactPotential(Contacts& contacts, double bound) : contacts_(contacts), bound_(bound) {}
  void set_stiffness(std::vector<double> stiffness) { stiffness_ = std::move(stiffness); }

  bool empty() const { return contacts_.empty(); }

  /// Starts a step or load increment at x (#V×3, m) and time (s). Sliding is measured from x. Assumptions of a failed
  /// attempt are discarded.
  void begin(const Vector& x, double time);
  /// Adds the pairs that touch on the way to x, where the tissue would be without contact. What is not expected, and
  /// crosses in a solution, update_lagged() finds.
  void expect(const Vector& x);
  /// Discards all contact state; call it when surfaces were added or removed.
  void reset();
  /// Switches self-contact off for good.
  void disable_self_contact() { with_tissue_ = false; }
  /// Moves the surfaces to a time (s) and resets friction to its state at the step's start.
  void set_time(double time);

  /// Whether tissue passes through a probe between the last point of linearise() or begin() and x. Such a solver step
  /// must be shortened, since on the probe's far side the contact energy would not push tissue back.
  bool crosses_probe(const Vector& x) const;
  double value(const Vector& x);
  void add_forces(const Vector& x, Vector& f);
  /// Evaluates the stiffness at x for the calls below. What is indefinite of it, the geometric stiffness of faces at a
  /// probe (face_slide.hpp) and of pairs (pair_slide.hpp), is there in full where the faces and pairs in contact are
  /// those of the last call, unless the stiffness shall be `positive`; else the positive part of faces.
  void linearise(const Vector& x, bool positive = false);
  /// Since linearise(), this part of the step that its stiffness suggests was taken.
  void step_taken(double part) { step_taken_ = part; }
  void add_product(const Vector& dx, Vector& out) const;
  /// Calls visit(a, b, 3×3 block in N/m, of a's rows and b's columns) for diagonal blocks (a == b) and for pairs, each
  /// pair once a contact.
  template <class Visit>
  void each_block(const Visit& visit) const;

  /// Adds the pairs of nodes of threads and self-contact, which need not share an element.
  void add_coupled_pairs(std::vector<std::array<int, 2>>& pairs) const;
  /// Adds the stiffness as a sum of rank-one terms.
  void add_rank_one_terms(std::vector<RankOneTerm>& terms) const;
  /// Updates the lagged quantities from a solution x: contact pairs, penalty stiffness and friction bounds. Returns
  /// true if any changed, so that the problem has to be solved again; at most 16 times per solve.
  bool update_lagged(const Vector& x);
  /// Takes x as the solution of the step: stores its friction state and fills the contacts' reports.
  void accept(const Vector& x);

  const ContactPotentialMemory& memory() const { return *this; }
  void restore(const ContactPotentialMemory& memory) { ContactPotentialMemory::operator=(memory); }

 private:
  void find(const Vector& x);
  bool add_touching_pairs(const Vector& x);
  bool is_settled();
  double stiffness_of(const ContactPoint& point) const;
  double normal_stiffness(const ActiveContact& touch) const;
  double friction_stiffness(const Friction& friction) const;
  Vec3 sliding(const Friction& friction, const Vector& x) const;
  Vec3 friction_force(const Friction& friction, const Vector& x) const;
  std::vector<Friction> friction_of_touches() const;
  void update_duals(const Vector& x);

  Contacts& contacts_;
  double bound_;
};

template <class Visit>
void ContactPotential::each_block(const Visit& visit) const {
  for (const auto& [point, K] : blocks_)
    for (std::size_t a = 0; a < static_cast<std::size_t>(point.count); ++a)
      for (std::size_t b = 0; b <= a; ++b)
        if (const double weight = point.weights[a] * point.weights[b]; weight != 0)
          visit(point.nodes[a], point.nodes[b], Mat3(weight * K));
  for (const RankOneTerm& slide : slides_)
    for (std::size_t a = 0; a < static_cast<std::size_t>(slide.count); ++a)
      for (std::size_t b = 0; b <= a; ++b)
        visit(slide.nodes[a], slide.nodes[b], Mat3(slide.sign * slide.g[a] * slide.g[b].transpose()));
}

}  // namespace heml
