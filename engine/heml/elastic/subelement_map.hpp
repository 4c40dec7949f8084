#pragma once
// Transforms the internal state of an element to that of a piece of it. With Dm the rest edges of the element as
// columns, those of the piece are Dm B. Under the same deformation the Gram matrix of the piece is Bᵀ G B. What is made
// of the gradients of the shape functions, the rows of (Dm B)⁻¹, transforms with B⁻¹: A, and tensions, which also scale
// with the volume.
#include <heml/math/symmetric3.hpp>
#include <heml/mesh/tet_mesh.hpp>

namespace heml {

template <class Real>
struct SubelementMap {
  Real B[3][3], inverse[3][3];
  Real volume;  ///< of the piece, relative to the element's

  /// whole, piece: rest positions (m) of the nodes of an element and of its piece, both of positive volume.
  SubelementMap(const std::array<Vec3, 4>& whole, const std::array<Vec3, 4>& piece) {
    const auto edges = [](const std::array<Vec3, 4>& X) {
      Mat3 D;
      D << X[1] - X[0], X[2] - X[0], X[3] - X[0];
      return D;
    };
    const bool same = whole == piece;  // to the bit
    const Mat3 D = edges(whole), P = edges(piece), one = Mat3::Identity();
    const Mat3 in_whole = same ? one : D.inverse() * P, back = same ? one : P.inverse() * D;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        B[i][j] = static_cast<Real>(in_whole(i, j));
        inverse[i][j] = static_cast<Real>(back(i, j));
      }
    volume = static_cast<Real>(in_whole.determinant());
  }

  void lengths(Real G[6]) const {
    const Real transposed[3][3] = {
        {B[0][0], B[1][0], B[2][0]}, {B[0][1], B[1][1], B[2][1]}, {B[0][2], B[1][2], B[2][2]}};
    replace(transposed, G, Real(1));
  }
  void metric(Real A[6]) const { replace(inverse, A, Real(1)); }
  void tensions(Real T[6]) const { replace(inverse, T, volume); }

 private:
  static void replace(const Real M[3][3], Real S[6], Real scale) {
    Real out[6];
    congruence3(M, S, out);
    for (int i = 0; i < 6; ++i) S[i] = scale * out[i];
  }
};

}  // namespace heml
