#pragma once
// Discretisation error of quadratic tetrahedra, estimated as that of linear ones (error_estimate.hpp), one degree
// higher: F and P of an element are linear through its four integration points; recovered fields at corners are
// quadratic fits to the values at the points of a patch, and at a middle of an edge the mean of the fits of its two
// ends (Zienkiewicz & Zhu 1992). The difference is quadratic in each element and is integrated exactly.
#include <heml/mesh/quadratic.hpp>

namespace heml {

/// e_t² (J) of every element. material_of: #T; F and P (Pa): 4 #T, at the integration points. Edges are taken as
/// straight.
std::vector<double> quadratic_recovery_errors(const TetMesh& mesh, const std::vector<int>& material_of,
                                              const std::vector<Mat3>& F, const std::vector<Mat3>& P);

}  // namespace heml
