#pragma once
// The panel's section "Material": tissue, law, parameters and density of each region; small-strain modulus and stress
// curve.
#include <app/panel/actions.hpp>
#include <app/panel/material_curve.hpp>
#include <app/panel/rows.hpp>
#include <map>
#include <string>
#include <vector>

namespace heml::panel {

class MaterialSection {
 public:
  /// names: of regions that have one. regions: of the mesh.
  explicit MaterialSection(std::vector<RegionMaterial> materials, std::map<int, std::string> names = {},
                           std::vector<int> regions = {})
      : materials_(std::move(materials)), names_(std::move(names)), regions_(std::move(regions)) {}

  /// Adds one SetMaterial if the user changed the material, one SetActiveStress if its contraction, and
  /// material_problem() has no objection. stretched: share of surface nodes stretched beyond the measured range of
  /// their tissue (stretch_monitor.hpp).
  void draw(Rows& rows, double stretched, PanelActions& out);

  /// Updates the shown material after a command from elsewhere (a script).
  void sync(const SetMaterial& command);
  void sync(const SetActiveStress& command);
  /// Entries that there are now, of regions and their names. Those of fields keep what the scene says of them; the
  /// newest one is shown.
  void take(const std::vector<RegionMaterial>& materials, const std::map<int, std::string>& names,
            std::vector<int> regions);
  void show(int region);  ///< the entry of a region, if it has one

  const std::vector<RegionMaterial>& materials() const { return materials_; }
  int changes() const { return changes_; }  ///< of materials(), counted

 private:
  void draw_region(Rows& rows);
  std::string name_of(const RegionMaterial& entry) const;
  bool draw_law(Rows& rows, Material& material);
  bool draw_numbers(Rows& rows, Material& material, const LawInfo& law);
  void draw_contraction(Rows& rows, RegionMaterial& entry, PanelActions& out);
  void draw_outcome(Rows& rows, const Material& material, double stretched);

  std::vector<RegionMaterial> materials_;
  std::map<int, std::string> names_;  ///< by region
  std::vector<int> regions_;          ///< of the mesh
  MaterialCurve curve_;
  int chosen_ = 0;           ///< index into materials_
  int changes_ = 0;          ///< of materials_, counted
  bool engineering_ = true;  ///< Young's modulus and Poisson's ratio instead of λ and μ
  std::string problem_;      ///< why the last edit was refused; empty: it was not
};

}  // namespace heml::panel
