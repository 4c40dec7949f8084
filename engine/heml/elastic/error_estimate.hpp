#pragma once
// Discretisation error of linear tetrahedra, estimated after Zienkiewicz & Zhu (International Journal for Numerical
// Methods in Engineering 24, 1987), with fields recovered from patches (33, 1992). Stress and deformation gradient are
// constant per element and jump between elements. Linear fits to their values round each node, interpolated linearly,
// are closer to the continuous fields, so the difference estimates the error:
//
//        P  ┌───┐ P*  ╱            e_t² = ∫_t (P* − P) : (F* − F) dV,   J: the squared energy norm of the error
//       ────┘╱──└────╱             * at a node: value there of the fit to the elements of one material round it
//
// P (first Piola–Kirchhoff) and F are work conjugate, so no moduli are needed and every law is covered; for small
// strains of a uniform body this is the usual ∫ Δσ : C⁻¹ Δσ. Fits are made per material, since stress may jump at an
// interface. A node at the surface has elements on one side and often few of them: its patch grows by rings until a fit
// is determined twice over, and the fit extrapolates to it, where a mean would keep the value from inside the body.
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

struct ErrorEstimate {
  std::vector<double> of_element;  ///< #T, J, 0 or more: e_t²
  double squared = 0;              ///< J, their sum
  double stored = 0;  ///< J, elastic energy without active stress: half the squared energy norm of the deformation

  /// Relative error in the energy norm, 0 to 1: √(e² / (2 stored + e²)).
  double relative() const;
  /// Relative error of each element per volume (#T; the volume-weighted rms is relative()): largest where refinement
  /// gains most.
  std::vector<double> densities(const TetMesh& mesh) const;
};

/// e_t² (J) of every element. material_of, F and P (Pa): #T.
std::vector<double> recovery_errors(const TetMesh& mesh, const std::vector<int>& material_of,
                                    const std::vector<Mat3>& F, const std::vector<Mat3>& P);

/// Deformation gradient of every element at positions x (#V×3, m).
std::vector<Mat3> deformation_gradients(const TetMesh& mesh, const std::vector<Vec3>& x);

}  // namespace heml
