#pragma once
// Law, parameters and density of each region.
#include <app/panel/actions.hpp>
#include <app/panel/rows.hpp>
#include <string>
#include <vector>

namespace heml::panel {

class MaterialSection {
 public:
  explicit MaterialSection(std::vector<RegionMaterial> materials) : materials_(std::move(materials)) {}

  /// Adds one SetMaterial when the user changed something that material_problem() has nothing against.
  void draw(Rows& rows, PanelActions& out);

  /// Shows what was set elsewhere.
  void follow(const SetMaterial& command);

 private:
  void draw_region(Rows& rows);
  bool draw_law(Rows& rows, Material& material);
  bool draw_parameters(Rows& rows, Material& material, const LawInfo& law);
  bool draw_engineering(Rows& rows, Material& material);

  std::vector<RegionMaterial> materials_;
  int chosen_ = 0;           ///< index into materials_
  bool engineering_ = true;  ///< Young's modulus and Poisson's ratio instead of λ and μ
  std::string problem_;      ///< with what was last asked for
};

}  // namespace heml::panel
