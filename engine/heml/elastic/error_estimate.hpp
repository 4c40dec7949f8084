#pragma once
// How far linear tetrahedra are from the body they stand for, after Zienkiewicz & Zhu (International Journal for
// Numerical Methods in Engineering 24, 1987). Stress and deformation jump from element to element; in the body they do
// not, and their means at nodes, linear in between, are nearer to it than what they are means of. What is between the
// two is about the error:
//
//        P  ┌───┐ P*  ╱            e_t² = ∫_t (P* − P) : (F* − F) dV,   J: the squared energy norm of the error
//       ────┘╱──└────╱             * at a node: mean over the elements of one material there, weighted by volume
//
// P (first Piola–Kirchhoff) and F work on one another, so no moduli are asked for and every law will do; for small
// strains of a uniform body this is the textbook's ∫ Δσ : C⁻¹ Δσ. Means do not cross from material to material, where
// stress may jump. On the surface they are one-sided, and less near.
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

struct ErrorEstimate {
  std::vector<double> of_element;  ///< #T, J, 0 or more: e_t²
  double squared = 0;              ///< J, their sum
  double stored = 0;               ///< J, elastic energy: half the squared energy norm of the deformation

  /// Of the energy norm, 0 to 1: √(e² / (2 stored + e²)).
  double relative() const;
  /// What each element has of that (#T, its volume-weighted rms is relative()): where a finer mesh would gain most.
  std::vector<double> densities(const TetMesh& mesh) const;
};

/// e_t² of every element. material_of, F and P (Pa): #T.
std::vector<double> recovery_errors(const TetMesh& mesh, const std::vector<int>& material_of,
                                    const std::vector<Mat3>& F, const std::vector<Mat3>& P);

/// Deformation gradient of every element at positions x (#V×3, m).
std::vector<Mat3> deformation_gradients(const TetMesh& mesh, const std::vector<Vec3>& x);

}  // namespace heml
