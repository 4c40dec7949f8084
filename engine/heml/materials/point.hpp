#pragma once
// A law with its type erased, as a function of the deformation gradient F: for `heml probe`, the test bench, curves in
// the panel, and checks. Without rate effects and plasticity. The force loop uses tensions instead (elastic/).
#include <heml/materials/material.hpp>
#include <memory>

namespace heml {

/// Thread-safe.
class MaterialPoint {
 public:
  virtual ~MaterialPoint() = default;
  virtual bool valid(const Mat3& F) const = 0;        ///< whether W and its derivatives are defined and finite
  virtual double energy(const Mat3& F) const = 0;     ///< W, J/m³
  virtual Mat3 first_piola(const Mat3& F) const = 0;  ///< P = ∂W/∂F, Pa
  virtual Mat3 first_piola_differential(const Mat3& F, const Mat3& dF) const = 0;  ///< ∂P/∂F : dF, Pa
};

/// Requires that material_problem() returns nothing and that the law is a continuum (LawInfo::is_continuum).
std::unique_ptr<MaterialPoint> make_material_point(const Material& material, bool continuation);

}  // namespace heml
