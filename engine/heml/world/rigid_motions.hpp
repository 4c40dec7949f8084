#pragma once
// How the parts of a body that nothing holds move as a whole. Nothing inside a body changes that motion, so what
// corrects the energy of a step must not touch it: else a body in free flight is slowed, and motion depends on the
// frame of reference.
#include <heml/dynamics/objective.hpp>
#include <heml/mesh/quadratic.hpp>

namespace heml {

class RigidMotions {
 public:
  /// Parts share no node. mass: 3 #V, kg, 0 where a coordinate is held. A part with a held coordinate has no motion
  /// here. midedges: of quadratic elements, else empty.
  RigidMotions(const TetMesh& mesh, const MidEdges& midedges, Vector mass);

  bool empty() const { return parts_.empty(); }
  /// Velocity of each part's rigid motion with the linear and angular momentum that it has at x, v. 3 #V, m/s; 0
  /// elsewhere.
  Vector velocity(const Vector& x, const Vector& v) const;
  /// `from` with each part turned and displaced as a whole to where it is nearest to `to` (W. Kabsch, Acta
  /// Crystallographica A 32, 1976, 922–923). 3 #V, m; `from` elsewhere.
  Vector moved(const Vector& from, const Vector& to) const;
  /// `from` with each part displaced by its mean displacement to `to`, but for what goes along the sum of its forces
  /// (3 #V, N): so a body that meets another slides on along it.
  Vector slid(const Vector& from, const Vector& to, const Vector& forces) const;
  /// Work of gravity (m/s²) on the way of these parts, J. heavy: #V, kg, masses that it acts on.
  template <class Real>
  double weight_work(const std::vector<Real>& heavy, const Vec3& gravity, const Vector& from, const Vector& to) const {
    double sum = 0;
    for (const std::vector<int>& part : parts_)
      for (const int n : part)
        sum += static_cast<double>(heavy[static_cast<std::size_t>(n)]) *
               gravity.dot(Vec3(to.segment<3>(3 * n) - from.segment<3>(3 * n)));
    return sum;
  }

 private:
  Vec3 centre(const std::vector<int>& part, const Vector& x) const;

  Vector mass_;
  std::vector<std::vector<int>> parts_;  ///< nodes of each, ascending
};

}  // namespace heml
