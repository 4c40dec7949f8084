#pragma once
// The panel's section "Regions": which regions of the mesh are drawn. Others are neither drawn nor met by the mouse.
#include <app/panel/rows.hpp>
#include <map>
#include <string>
#include <vector>

namespace heml::panel {

/// Of a region, by names of those that have one.
std::string region_name(int region, const std::map<int, std::string>& names);

class RegionSection {
 public:
  /// hidden: regions, ascending; those that the mesh has not are forgotten.
  RegionSection(std::vector<int> regions, std::map<int, std::string> names, const std::vector<int>& hidden);

  /// Those that there are now: hidden ones stay hidden.
  void take(std::vector<int> regions, std::map<int, std::string> names);

  bool has_choice() const { return regions_.size() > 1; }  ///< otherwise there is nothing to draw
  void draw(Rows& rows);
  const std::vector<int>& hidden() const { return hidden_; }  ///< ascending; never all

  void toggle(int region);     ///< leaves the last one that is shown
  void show_only(int region);  ///< all, where it is the only one already
  void show_all() { hidden_.clear(); }

 private:
  bool is_shown(int region) const;
  void draw_region(Rows& rows, int region);

  std::vector<int> regions_, hidden_;  // ascending
  std::map<int, std::string> names_;
};

}  // namespace heml::panel
