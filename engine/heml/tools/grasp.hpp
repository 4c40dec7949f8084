#pragma once
// Grasp: a patch of nodes tied to a tool by critically damped springs, like tissue held by forceps.
//
// Node i of the patch gets k_i = w_i ω² m_i and c_i = 2 √w_i ω m_i, with w falling smoothly to 0 at the rim and ω a
// fraction of the body's highest frequency: stiff to a user, yet never what limits the stable step. When the tool is
// further than `reach` from the patch, the springs' force stays constant: the grip slips.
#include <heml/math/types.hpp>
#include <span>
#include <vector>

namespace heml {

/// Which grasp a spring is.
struct GraspId {
  int hand = 0;
  long serial = 0;  ///< of all grasps of a world, from 1
};

template <class Real>
class GraspSpring {
 public:
  /// Grasps `center` and those of `nodes` (internal numbers, ascending) within `radius` (m) of it at rest, except
  /// constrained ones (inverse_mass 0). rest, x: #V×3, m. inverse_mass: #V, 1/kg. omega: 1/s. reach: m.
  GraspSpring(GraspId id, int center, Real radius, std::span<const int> nodes, const std::vector<Vec3>& rest,
              const Real* x, const std::vector<Real>& inverse_mass, Real omega, double reach);

  const GraspId& id() const { return id_; }
  void hand_over(int hand) { id_.hand = hand; }
  bool empty() const { return nodes_.empty(); }
  Real omega() const { return omega_; }
  int center() const { return center_; }
  Real radius() const { return radius_; }  ///< m

  void move(const Vec3& target) { target_ = target; }
  const Vec3& target() const { return target_; }

  /// Adapts stiffness and damping to changed masses at constant frequency. A node without mass gets a spring of zero
  /// stiffness.
  void update_masses(const std::vector<Real>& inverse_mass);

  /// Adds the springs' forces to f (3 #V, N).
  void add_forces(const Real* x, const Real* v, Real* f) const;

  /// Energy of the springs, J; minus its gradient is their force without damping.
  double energy(const Real* x) const;
  /// Calls visit(node, stiffness N/m, damping N s/m) for every node of the patch. The stiffness is exact within reach,
  /// an upper bound beyond.
  template <class Visit>
  void each_stiffness(const Visit& visit) const {
    for (std::size_t k = 0; k < nodes_.size(); ++k) visit(nodes_[k], stiffness_[k], damping_[k]);
  }

  /// Mean position of the patch, weighted by stiffness, m.
  Vec3 grip(const Real* x) const;
  /// The greatest speed that the springs can give the grip, m/s: force over damping, ω d/2 at a distance d of the
  /// target.
  double speed_at_most(const Real* x) const;
  /// Force of the tool on the tissue, N.
  Vec3 force(const Real* x, const Real* v) const;

 private:
  Vec3 clamped_target(const Real* x) const;  // the target, clamped to `reach` from the grip
  Vector3<Real> node_force(std::size_t k, const Vec3& target, const Real* x, const Real* v) const;

  GraspId id_;
  int center_;
  Real radius_, omega_;
  double reach_;  ///< m
  Vec3 target_;   ///< m
  std::vector<int> nodes_;
  std::vector<Vec3> offset_;               ///< m, of each node from the tool when grasped
  std::vector<Real> weight_;               ///< w
  std::vector<Real> stiffness_, damping_;  ///< N/m, N s/m
};

}  // namespace heml
