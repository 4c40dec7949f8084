#pragma once
// Materials of a FEBio file as laws of heml. Each conversion is exact: the same energy for the same deformation, by
// FEBio's Theory Manual and the energies in its sources.
//
//   FEBio                  W                                                  heml
//   neo-Hookean            μ/2 (I1−3) − μ ln J + λ/2 (ln J)²                  neo_hookean, from E and v
//   isotropic elastic      λ/2 tr(E)² + μ E:E                                 stvk, from E and v
//   incomp neo-Hookean     G/2 (Ī1−3) + U                                     neo_hookean_iso, K1 = G/2
//   Mooney-Rivlin          c1 (Ī1−3) + c2 (Ī2−3) + U                          mooney_rivlin
//   Veronda-Westmann       c1 (exp(c2 (Ī1−3)) − 1) − c1 c2/2 (Ī2−3) + U       veronda_westmann
//   Yeoh                   Σ ci (Ī1−3)^i + U, up to three terms               yeoh
//   Ogden                  Σ ci/mi² (λ̄1^mi + λ̄2^mi + λ̄3^mi − 3) + U           ogden, μi = ci/mi, αi = mi
//   Gent                   −G Jm/2 ln(1 − (Ī1−3)/Jm) + U                      gent
//   coupled Mooney-Rivlin  c1 (I1−3) + c2 (I2−3) − 2 (c1+2 c2) ln J + k/2 (ln J)²         energy
//   Ogden unconstrained    Σ ci/mi² (λ1^mi + λ2^mi + λ3^mi − 3 − mi ln J) + cp/2 (J−1)²   energy
//   Holmes-Mow             H/4β (exp(β ((2μ−λ) (I1−3) + λ (I2−3))/H)/J^2β − 1), H = λ+2μ  energy, β > 0
//
// U by pressure_model: k/2 (ln J)² (default), k/4 (J² − 1 − 2 ln J) (NIKE3D, Abaqus (GOH)), k/2 (J−1)² (Abaqus): the
// volume terms logarithmic, simo_taylor and quadratic.
#include <heml/materials/material.hpp>
#include <heml/scenario/feb_findings.hpp>
#include <optional>

namespace heml {

/// The law of a <material>. None: it is refused in `findings`.
std::optional<Material> feb_material(const XmlElement& material, const FebUnits& units, FebFindings& findings);

/// A number that neither a map nor a formula gives. None: it is refused in `findings`.
std::optional<double> feb_number(const XmlElement& value, FebFindings& findings);

}  // namespace heml
