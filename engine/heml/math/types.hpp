#pragma once
// Small fixed-size vectors and matrices. Double unless a name says otherwise; SI units.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace heml {

template <class Real>
using Vector3 = Eigen::Matrix<Real, 3, 1>;
template <class Real>
using Matrix3 = Eigen::Matrix<Real, 3, 3>;

using Vec3 = Vector3<double>;
using Mat3 = Matrix3<double>;
using Vec3f = Vector3<float>;

/// Cofactor matrix ∂(det F)/∂F, from cross products of the columns of F; defined for singular F too.
template <class Real>
Matrix3<Real> cofactor(const Matrix3<Real>& F) {
  Matrix3<Real> result;
  result.col(0) = F.col(1).cross(F.col(2));
  result.col(1) = F.col(2).cross(F.col(0));
  result.col(2) = F.col(0).cross(F.col(1));
  return result;
}

}  // namespace heml
