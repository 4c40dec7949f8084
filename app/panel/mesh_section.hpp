#pragma once
// The panel's first section of a bare mesh: what was guessed and found wrong, and what keeps it.
//
//    ┌ This mesh ──────────────────── ⌄ ┐
//    │ Unit       [centimetres       v] │   another choice opens the mesh again with it; ↶ goes back to the guess
//    │ Length     [15.2 cm         ] ↶  │
//    │ Up, Supports, Tissue, Tetrahedra │
//    │ ● 4 holes                closed  │   mended
//    │ ● 634 slivers     kept, 0.41°    │   not mended
//    │ [Keep as scene]  [Close]         │
//    └──────────────────────────────────┘
#include <app/panel/actions.hpp>
#include <app/panel/mesh_openings.hpp>
#include <app/panel/rows.hpp>
#include <heml/scenario/scene.hpp>

namespace heml::panel {

class MeshSection {
 public:
  explicit MeshSection(const Scene& scene)
      : chosen_(scene.chosen), is_scan_(!scene.mesh.labels.empty()), opened_(scene.materials) {}

  bool is_shown() const { return chosen_.has_value(); }
  bool is_open() const { return open_; }
  void set_open(bool open) { open_ = open; }

  /// The openings of this mesh, for undo.
  void set_openings(MeshOpenings openings) { openings_ = std::move(openings); }
  const MeshOpenings& openings() const { return openings_; }

  /// A scene was written: its file is told.
  void set_kept(std::filesystem::path file) { kept_ = std::move(file); }

  /// materials: of the body now. texts: all that was found and chosen on opening.
  void draw(Rows& rows, const std::vector<RegionMaterial>& materials, const std::vector<std::string>& texts,
            PanelActions& out);

 private:
  /// A filled surface tells its own number of tetrahedra only where none was chosen.
  int own_tets() const { return openings_.own_tets().value_or(chosen_->read_tets); }
  std::string reason(const char* about) const;
  bool draw_size(Rows& rows, BareMeshOptions& options) const;
  bool draw_tissue(Rows& rows, const std::vector<RegionMaterial>& materials, BareMeshOptions& options) const;
  bool draw_fineness(Rows& rows, BareMeshOptions& options) const;
  void draw_findings(Rows& rows) const;
  void draw_end(Rows& rows, const std::vector<std::string>& texts, PanelActions& out);

  std::optional<BareMeshChoices> chosen_;
  bool is_scan_;  ///< its header names the unit
  std::vector<RegionMaterial> opened_;
  bool open_ = true;
  MeshOpenings openings_;
  std::filesystem::path kept_;  ///< empty: not kept yet
};

}  // namespace heml::panel
