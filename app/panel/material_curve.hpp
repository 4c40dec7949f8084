#pragma once
// The small curve under a material's parameters: nominal stress against stretch of a bar that is pulled and pressed.
#include <app/panel/chart.hpp>
#include <heml/materials/material.hpp>

namespace heml::panel {

class MaterialCurve {
 public:
  /// As wide as there is room; nothing for laws that are no continuum or take numbers from fields of a mesh. Computed
  /// anew only when the material is another than in the last call.
  void draw(const Material& material);

 private:
  void compute(const Material& material);

  Material shown_;
  Chart chart_;
  bool computed_ = false;
};

}  // namespace heml::panel
