#pragma once
// Strong ellipticity of a law at a deformation (Legendre–Hadamard): its acoustic tensor Q(N)a = (∂P/∂F : a⊗N) N is
// positive definite for every direction N at rest. Where it is not, waves along some N do not travel but grow, shape
// between nodes is arbitrarily rough at no cost, and the boundary value problem has no solution that a finer mesh would
// approach.
#include <functional>
#include <heml/math/types.hpp>

namespace heml {

/// dP of a change dF of the deformation gradient, Pa.
using Tangent = std::function<Mat3(const Mat3& dF)>;

/// The lowest eigenvalue of the symmetric part of Q(N) over all directions N, Pa: negative where ellipticity is lost.
double min_acoustic_eigenvalue(const Tangent& tangent);

/// Along an edge with spring constant k (N/m) and rest length |edge|, in a volume V (m³): the tangent of ½k(|F edge| −
/// |edge|)²/V at F, for the sum over the edges of an element of springs.
Mat3 spring_tangent(double k, const Vec3& edge, double volume, const Mat3& F, const Mat3& dF);

}  // namespace heml
