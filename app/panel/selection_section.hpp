#pragma once
// The panel's section "Selection": how a drag selects nodes, and what is done with those that are selected.
#include <app/panel/actions.hpp>
#include <app/panel/node_selection.hpp>
#include <app/panel/rows.hpp>
#include <heml/session/frame.hpp>

namespace heml::panel {

class SelectionSection {
 public:
  enum class Drag { rectangle, lasso, paint };

  void draw(Rows& rows, const Frame& frame, PanelActions& out);

  NodeSelection& selection() { return selection_; }
  const NodeSelection& selection() const { return selection_; }
  Drag drag() const { return drag_; }
  bool through() const { return through_; }  ///< also what is behind other tissue

 private:
  void draw_supports(Rows& rows, const Conditions& conditions, PanelActions& out);
  void draw_loads(Rows& rows, const Conditions& conditions, PanelActions& out);

  NodeSelection selection_;
  Drag drag_ = Drag::rectangle;
  bool through_ = false;
  Vec3 force_ = Vec3(0, 0.1, 0);  // N, to apply
};

}  // namespace heml::panel
