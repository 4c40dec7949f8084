#pragma once
// A law at a material point, seen from a deformation gradient, with its type erased: for `heml probe`, the test bench,
// curves in the panel, and checks. The engine itself works in tension form (elastic/). Rate effects and plasticity are
// not part of it.
#include <heml/materials/material.hpp>
#include <memory>

namespace heml {

/// Any number of threads.
class MaterialPoint {
 public:
  virtual ~MaterialPoint() = default;
  virtual bool valid(const Mat3& F) const = 0;        ///< whether W is defined and finite there
  virtual double energy(const Mat3& F) const = 0;     ///< W, J/m³
  virtual Mat3 first_piola(const Mat3& F) const = 0;  ///< P = ∂W/∂F, Pa
  virtual Mat3 first_piola_differential(const Mat3& F, const Mat3& dF) const = 0;  ///< ∂P/∂F : dF, Pa
};

/// The material must be one that material_problem() has nothing against, of a law that is a continuum.
std::unique_ptr<MaterialPoint> make_material_point(const Material& material, bool continuation);

}  // namespace heml
