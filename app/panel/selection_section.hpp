#pragma once
// The panel's section "Selection": how a drag selects nodes, and what is done with those that are selected.
#include <app/panel/actions.hpp>
#include <app/panel/node_selection.hpp>
#include <app/panel/rows.hpp>
#include <heml/session/frame.hpp>
#include <utility>

namespace heml::panel {

class SelectionSection {
 public:
  enum class Drag { rectangle, lasso, paint };

  void draw(Rows& rows, const Frame& frame, PanelActions& out);

  NodeSelection& selection() { return selection_; }
  const NodeSelection& selection() const { return selection_; }
  NodeSelection& inside() { return inside_; }  ///< nodes below the surface that go with it into a region
  const Vec3& force() const { return force_; }  ///< N, to apply
  void set_force(const Vec3& force) { force_ = force; }
  /// Drops nodes that a mesh of so many nodes does not have.
  void keep_below(std::size_t mesh_nodes) {
    selection_.keep_below(mesh_nodes);
    inside_.keep_below(mesh_nodes);
  }
  void forget() {
    selection_.clear();
    inside_.clear();
  }
  PinTissue pin() const;                       ///< of what is selected
  Unpin unpin() const;
  /// The region whose material was asked for since the last call.
  std::optional<int> take_region() { return std::exchange(region_, std::nullopt); }
  Drag drag() const { return drag_; }
  bool through() const { return through_; }  ///< also what is behind other tissue

 private:
  void draw_supports(Rows& rows, const Conditions& conditions, PanelActions& out);
  void draw_loads(Rows& rows, const Conditions& conditions, PanelActions& out);
  void draw_pins(Rows& rows, const Frame& frame, PanelActions& out) const;
  void draw_region(Rows& rows, const Frame& frame, PanelActions& out);

  NodeSelection selection_, inside_;
  std::string name_ = "part 1";  // of the region to make
  std::optional<int> region_;
  Drag drag_ = Drag::rectangle;
  bool through_ = false;
  int fixed_axes_ = 0;  // of the choices in draw_supports()
  Vec3 force_ = Vec3(0, 0.1, 0);  // N, to apply
};

}  // namespace heml::panel
