#pragma once
// The small chart under a material's parameters: nominal stress against stretch in uniaxial tension and compression.
#include <app/panel/chart.hpp>
#include <heml/materials/material.hpp>

namespace heml::panel {

class MaterialCurve {
 public:
  /// Draws the chart over the available width; nothing for laws that are no continuum or have parameters from mesh
  /// fields. Recomputes the curve only if the material differs from that of the last call.
  void draw(const Material& material);

 private:
  void compute(const Material& material);

  Material shown_;
  Chart chart_;
  bool computed_ = false;
};

}  // namespace heml::panel
