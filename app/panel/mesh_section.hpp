#pragma once
// The panel's section "This mesh": what was guessed of a bare mesh. Another choice opens the mesh again with it.
#include <app/panel/actions.hpp>
#include <app/panel/rows.hpp>
#include <heml/scenario/scene.hpp>

namespace heml::panel {

class MeshSection {
 public:
  explicit MeshSection(const Scene& scene) : chosen_(scene.chosen), is_scan_(!scene.mesh.labels.empty()) {}

  bool is_shown() const { return chosen_.has_value(); }
  void draw(Rows& rows, PanelActions& out) const;

 private:
  std::string reason(const char* about) const;

  std::optional<BareMeshChoices> chosen_;
  bool is_scan_;  ///< its header names the unit
};

}  // namespace heml::panel
