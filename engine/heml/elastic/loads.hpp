#pragma once
// External forces, ramped in time: dead loads, which are constant vectors, and pressure, which follows the deformed
// surface. On faces of quadratic tetrahedra they are integrals over six shape functions.
#include <array>
#include <heml/math/ramp.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

template <class Real>
struct DeadLoad {
  std::vector<int> nodes;    ///< inner numbers, ascending
  std::vector<Real> forces;  ///< 3 a node, N
  Ramp ramp = {};
};

/// An integration point of a six-node face with corners 0, 1, 2 and the middles of 01, 12, 20 as 3, 4, 5.
struct FacePoint {
  double weight;            ///< of 1 in all
  std::array<double, 6> N;  ///< shape functions
  std::array<std::array<double, 6>, 3>
      slope;  ///< ∂N/∂λ_i: weights of the nodes in virtual corner i (mesh/quadratic.hpp)
};

/// Dunavant (1985), degree 4: exact for pressure on straight and curved faces.
inline constexpr std::array<FacePoint, 6> face_points = [] {
  std::array<FacePoint, 6> points{};
  for (std::size_t k = 0; k < 6; ++k) {
    const double near = k < 3 ? 0.10810301816807022736 : 0.81684757298045851308;
    const double far = k < 3 ? 0.44594849091596488632 : 0.09157621350977074346;
    FacePoint& point = points[k];
    point.weight = k < 3 ? 0.22338158967801146570 : 0.10995174365532186764;
    const double lambda[3] = {k % 3 == 0 ? near : far, k % 3 == 1 ? near : far, k % 3 == 2 ? near : far};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      point.N[i] = lambda[i] * (2 * lambda[i] - 1);
      point.N[3 + i] = 4 * lambda[i] * lambda[j];
      point.slope[i][i] = 4 * lambda[i] - 1;
      point.slope[i][3 + i] = 4 * lambda[j];
      point.slope[j][3 + i] = 4 * lambda[i];
    }
  }
  return points;
}();

/// The virtual corners of a face at a point; x(k): position of its node k.
template <class Position>
std::array<Vec3, 3> virtual_face(const FacePoint& point, const Position& x) {
  std::array<Vec3, 3> y{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 6; ++k)
      if (point.slope[i][k] != 0) y[i] += point.slope[i][k] * x(k);
  return y;
}

template <class Real>
struct Pressure {
  std::vector<Triangle> faces;                        ///< inner numbers, outward
  std::vector<std::array<int, 6>> quadratic_faces{};  ///< instead, of quadratic tetrahedra
  Real pascal = 0;                                    ///< Pa, positive pushes inward
  Ramp ramp = {};
};

/// Adds the forces (N) at a time (s) and positions x (3 #V, m) to f (3 #V), in the order of nodes or faces.
template <class Real>
void add_load(const DeadLoad<Real>& load, double time, Real* f) {
  const Real part = static_cast<Real>(load.ramp(time));
  for (std::size_t k = 0; k < load.nodes.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i)
      f[3 * static_cast<std::size_t>(load.nodes[k]) + i] += part * load.forces[3 * k + i];
}

template <class Real>
void add_load(const Pressure<Real>& load, double time, const Real* x, Real* f) {
  // A third of −p A n on each node of a face, A n = ½ (x1−x0)×(x2−x0).
  const Real part = -load.pascal * static_cast<Real>(load.ramp(time)) / 6;
  for (const Triangle& face : load.faces) {
    Eigen::Map<const Vector3<Real>> a(x + 3 * face[0]), b(x + 3 * face[1]), c(x + 3 * face[2]);
    const Vector3<Real> push = part * (b - a).cross(c - a);
    for (const int n : face) Eigen::Map<Vector3<Real>>(f + 3 * n) += push;
  }
  for (const std::array<int, 6>& nodes : load.quadratic_faces)
    for (const FacePoint& point : face_points) {
      const auto y = virtual_face(point, [&](std::size_t k) {
        return Vec3(Eigen::Map<const Vector3<Real>>(x + 3 * nodes[k]).template cast<double>());
      });
      // part is a third of what a whole face takes
      const Vec3 push = 3 * static_cast<double>(part) * point.weight * (y[1] - y[0]).cross(y[2] - y[0]);
      for (std::size_t k = 0; k < 6; ++k)
        Eigen::Map<Vector3<Real>>(f + 3 * nodes[k]) += (point.N[k] * push).template cast<Real>();
    }
}

}  // namespace heml
