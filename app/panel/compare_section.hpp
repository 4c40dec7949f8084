#pragma once
// What is beside the body: the same tissue under other laws and methods, and how far each is from it.
#include <app/panel/actions.hpp>
#include <app/panel/rows.hpp>
#include <heml/session/frame.hpp>

namespace heml::panel {

class CompareSection {
 public:
  void draw(Rows& rows, const Frame& frame, PanelActions& out);

 private:
  int law_ = 0, method_ = 0;  ///< chosen for the next one; 0: as it is
};

}  // namespace heml::panel
