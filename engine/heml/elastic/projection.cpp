#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <heml/elastic/clamp.hpp>
#include <heml/elastic/projection.hpp>

namespace heml {
namespace {

constexpr double flat = 0.05;  // |J| below which no tensions express a pressure
constexpr int stress_row[6] = {0, 1, 2, 0, 0, 1}, stress_column[6] = {0, 1, 2, 1, 2, 2};

using Mat9 = Eigen::Matrix<double, 9, 9>;

/// Positive part of a symmetric matrix. A Cholesky factorisation finds at a tenth of the cost that K is positive.
template <class Matrix>
Matrix positive_part(const Matrix& K) {
  if (K.llt().info() == Eigen::Success) return K;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(K);
  const auto& Q = eigen.eigenvectors();
  return Q * eigen.eigenvalues().cwiseMax(0).asDiagonal() * Q.transpose();
}

template <class Real>
Mat9 full(const Real K[edge_entries]) {
  Mat9 matrix;
  for (int r = 0; r < 9; ++r)
    for (int c = 0; c < 9; ++c) matrix(r, c) = static_cast<double>(K[edge_entry(r, c)]);
  return matrix;
}

template <class Real>
void store(const Mat9& matrix, Real K[edge_entries]) {
  for (int r = 0, at = 0; r < 9; ++r)
    for (int c = 0; c <= r; ++c) K[at++] = static_cast<Real>(matrix(r, c));
}

/// The symmetric matrix of 11 22 33 12 13 23.
template <class Real>
Eigen::Matrix3d square(const Real six[6]) {
  Eigen::Matrix3d matrix;
  for (int k = 0; k < 6; ++k)
    matrix(stress_row[k], stress_column[k]) = matrix(stress_column[k], stress_row[k]) = static_cast<double>(six[k]);
  return matrix;
}

Mat9 times_identity(const Eigen::Matrix3d& T) {
  Mat9 matrix = Mat9::Zero();
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) matrix.block<3, 3>(3 * a, 3 * b).diagonal().setConstant(T(a, b));
  return matrix;
}

}  // namespace

template <class Real>
void clamp_element(Real K[edge_entries]) {
  const Mat9 matrix = full(K);
  if (matrix.allFinite()) store(positive_part(matrix), K);
}

template <class Real>
void clamp_tension(const Tensions<Real>& t, const ElementKinematics<Real>& kinematics, const RestShape<Real>& rest,
                   Real K[edge_entries]) {
  const double J = static_cast<double>(kinematics.at.J), V = static_cast<double>(rest.volume);
  const Mat9 matrix = full(K);
  if (!(std::abs(J) > flat) || !matrix.allFinite()) return clamp_element(K);
  Eigen::Matrix3d T = square(t.T);  // ∂J/∂G = J/2 G⁻¹, and G⁻¹ is made of the cross products of edges
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int i = 0; i < 3; ++i)
        T(a, b) += static_cast<double>(t.wJ) / (36 * V * J) *
                   static_cast<double>(kinematics.cross[a][i] * kinematics.cross[b][i]);
  const Eigen::Matrix3d L = square(rest.A).llt().matrixL(), inverse = L.inverse();
  const Eigen::Matrix3d S = inverse * T * inverse.transpose();
  const Eigen::Matrix3d positive = L * positive_part(S) * L.transpose();
  store(Mat9(times_identity(positive) + positive_part(Mat9(matrix - times_identity(T)))), K);
}

template void clamp_element(float[edge_entries]);
template void clamp_element(double[edge_entries]);
template void clamp_tension(const Tensions<float>&, const ElementKinematics<float>&, const RestShape<float>&,
                            float[edge_entries]);
template void clamp_tension(const Tensions<double>&, const ElementKinematics<double>&, const RestShape<double>&,
                            double[edge_entries]);

}  // namespace heml
