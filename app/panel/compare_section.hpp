#pragma once
// The panel's section "Compare": adds and removes comparison runs and shows how far each is from the body.
#include <app/panel/actions.hpp>
#include <app/panel/rows.hpp>
#include <heml/session/frame.hpp>

namespace heml::panel {

/// A variant as people read it: "ogden+tr_bdf2" is "Ogden, TR-BDF2".
std::string variant_title(const std::string& variant);

class CompareSection {
 public:
  void draw(Rows& rows, const Frame& frame, PanelActions& out);

 private:
  int law_ = 0, method_ = 0;  ///< choices for the next comparison run; 0: the body's own
};

}  // namespace heml::panel
