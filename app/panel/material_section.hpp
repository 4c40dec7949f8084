#pragma once
// Tissue, law, parameters and density of each region, and what they make: stiffness at rest and a curve.
#include <app/panel/actions.hpp>
#include <app/panel/material_curve.hpp>
#include <app/panel/rows.hpp>
#include <string>
#include <vector>

namespace heml::panel {

class MaterialSection {
 public:
  explicit MaterialSection(std::vector<RegionMaterial> materials) : materials_(std::move(materials)) {}

  /// Adds one SetMaterial when the user changed something that material_problem() has nothing against. stretched: share
  /// of the surface that is stretched further than its tissue was measured (stretch_monitor.hpp).
  void draw(Rows& rows, double stretched, PanelActions& out);

  /// Shows what was set elsewhere.
  void sync(const SetMaterial& command);

  const std::vector<RegionMaterial>& materials() const { return materials_; }
  int changes() const { return changes_; }  ///< counts them

 private:
  void draw_region(Rows& rows);
  bool draw_law(Rows& rows, Material& material);
  bool draw_numbers(Rows& rows, Material& material, const LawInfo& law);
  void draw_outcome(Rows& rows, const Material& material, double stretched);

  std::vector<RegionMaterial> materials_;
  MaterialCurve curve_;
  int chosen_ = 0;           ///< index into materials_
  int changes_ = 0;          ///< of materials_
  bool engineering_ = true;  ///< Young's modulus and Poisson's ratio instead of λ and μ
  std::string problem_;      ///< with what was last asked for
};

}  // namespace heml::panel
