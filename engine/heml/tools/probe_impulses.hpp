#pragma once
// A probe in explicit steps. Its contact points lie in faces, on edges or at nodes of the tissue (features); a point on
// an edge is one point, whichever face it was found in. Points share nodes, so impulses are found in rounds
// (contact_rows.hpp). They start with the points of the last steps, where they were on their features, and end when no
// face is inside the probe:
//
//   remembered points ──► rounds ──► faces inside the probe at the step's end? ──► their points join, rounds again
//
// A smooth probe on flat faces touches along lines, of which the nearest point is anywhere. With a point on every
// feature that touched lately, the load stays where it was instead of jumping from step to step.
#include <heml/tools/contact_rows.hpp>
#include <heml/tools/contacts.hpp>

namespace heml {

template <class Real>
class ProbeImpulses {
 public:
  /// The time within a step at which the probe is checked.
  struct Check {
    ContactSurface then, now;  ///< at the step's start and at the check
    double duration;           ///< s, between them
    std::size_t surface;       ///< of the contacts
    bool is_whole;             ///< the check ends the step, and is its only one
    const std::vector<Real>& inverse_mass;
    const ContactBoundary& boundary;
    const Real* before;  ///< #V×3, m, at the step's start
  };
  /// Forgets the last step's points. Call it before the first check of a step, and without a probe.
  void clear(std::size_t node_count);
  /// Changes v (#V×3, m/s) so that tissue moving with it is outside the probe at the check. May be called again after
  /// other contacts have changed v.
  void stop(const Check& check, const std::vector<AnchoredPoint>& known, Real* v);
  /// Adds the points that got an impulse to `touched`, with anchors updated for positions x (#V×3, m).
  void remember_first_half(const ContactSurface& now, std::size_t surface, const Real* x,
                           const std::vector<AnchoredPoint>& known, std::vector<AnchoredPoint>& touched) const;

  /// Keeps the points that got an impulse and requires that they do not move into the probe, from positions x on.
  void begin_second_half(const ContactSurface& now, const std::vector<Real>& inverse_mass, const Real* x,
                         const std::vector<AnchoredPoint>& known, Real* v);
  void solve(Real* v);
  void remember_second_half(std::vector<AnchoredPoint>& known) const;

  bool empty() const { return touches_.empty(); }
  const std::vector<int>& nodes() const { return rows_.nodes(); }
  /// Calls visit(point, impulse) for each point with an impulse (N s).
  template <class Visit>
  void each_impulse(const Visit& visit) const {
    for (std::size_t i = 0; i < touches_.size(); ++i) {
      const auto& row = rows_.rows()[i];
      const Vec3 impulse = (row.normal_impulse * row.normal + row.friction_impulse).template head<3>();
      if (row.normal_impulse > 0) visit(touches_[i].point, impulse);
    }
  }

 private:
  struct Touch {
    ContactPoint point;
    std::size_t surface;
    Vec3 velocity;  ///< m/s, of the probe
  };
  template <class Moved>
  const std::vector<Triangle>& faces_near(const Check& check, const Moved& moved);
  void start(const Check& check, const std::vector<AnchoredPoint>& known, Real* v);
  bool add_points(const Check& check, const std::vector<AnchoredPoint>& known, Real* v);
  void add(const Check& check, const ContactPoint& point, double closing, const std::vector<AnchoredPoint>& known,
           Real* v);
  void set_motion(const Touch& touch, double friction, const Vec3& drift, typename ContactRows<Real>::Row& row) const;

  ContactRows<Real> rows_;  ///< of each touch
  std::vector<Touch> touches_;
  bool has_started_ = false;
  /// Of the last search for near faces in this step.
  struct Search {
    Vec3 tip, other;             ///< m, of the probe
    std::vector<Vec3> nodes;     ///< m, of the boundary; none: no search yet
    std::vector<Triangle> near;  ///< faces
  };
  Search search_;
};

}  // namespace heml
