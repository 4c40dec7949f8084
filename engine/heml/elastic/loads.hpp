#pragma once
// External forces, ramped in time: dead loads, which are constant vectors, and pressure, which follows the deformed
// surface.
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

/// Fraction of a load at a time (s): time / ramp_time, clamped to [0, 1]; 1 if ramp_time is 0.
inline double ramp(double time, double ramp_time) {
  return ramp_time > 0 && time < ramp_time ? (time > 0 ? time / ramp_time : 0.0) : 1.0;
}

template <class Real>
struct DeadLoad {
  std::vector<int> nodes;    ///< inner numbers, ascending
  std::vector<Real> forces;  ///< 3 a node, N
  double ramp_time = 0;      ///< s
};

template <class Real>
struct Pressure {
  std::vector<Triangle> faces;  ///< inner numbers, outward
  Real pascal = 0;              ///< Pa, positive pushes inward
  double ramp_time = 0;         ///< s
};

/// Adds the forces (N) at a time (s) and positions x (3 #V, m) to f (3 #V), in the order of nodes or faces.
template <class Real>
void add_load(const DeadLoad<Real>& load, double time, Real* f) {
  const Real part = static_cast<Real>(ramp(time, load.ramp_time));
  for (std::size_t k = 0; k < load.nodes.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i)
      f[3 * static_cast<std::size_t>(load.nodes[k]) + i] += part * load.forces[3 * k + i];
}

template <class Real>
void add_load(const Pressure<Real>& load, double time, const Real* x, Real* f) {
  // A third of −p A n on each node of a face, A n = ½ (x1−x0)×(x2−x0).
  const Real part = -load.pascal * static_cast<Real>(ramp(time, load.ramp_time)) / 6;
  for (const Triangle& face : load.faces) {
    Eigen::Map<const Vector3<Real>> a(x + 3 * face[0]), b(x + 3 * face[1]), c(x + 3 * face[2]);
    const Vector3<Real> push = part * (b - a).cross(c - a);
    for (const int n : face) Eigen::Map<Vector3<Real>>(f + 3 * n) += push;
  }
}

}  // namespace heml
