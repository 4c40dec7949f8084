#pragma once
// Messages over the picture: what went wrong and stays, and what is said in passing.
#include <app/panel/area.hpp>
#include <app/panel/rows.hpp>
#include <optional>
#include <string>

namespace heml::panel {

struct Banner {
  std::string title, text;
  std::string button;  ///< what can be pressed; empty: nothing
  ImU32 colour = colours::warning;
};

class Notices {
 public:
  void say(std::string text);   ///< shown for some seconds
  void fail(std::string text);  ///< shown until it is closed
  bool close();                 ///< true when a failure was open

  /// Draws what there is and the banner of the moment, if any, within the free part of the picture; true when the
  /// banner's button was pressed. seconds: since the last frame.
  bool draw(Rows& rows, const Area& free, const std::optional<Banner>& banner, float seconds);

  bool animating() const { return !said_.empty(); }
  /// Whether a point was on a banner in the last frame.
  bool covers(float x, float y) const;

 private:
  bool draw_banner(Rows& rows, const char* id, const Area& free, const Banner& banner);
  void draw_said(const Area& free, float seconds);

  std::string failure_, said_;
  float said_for_ = 0;  ///< s
  std::vector<Area> places_;
};

}  // namespace heml::panel
