#pragma once
// Messages over the image: failures, which stay until closed, and notices, which fade out.
#include <app/panel/area.hpp>
#include <app/panel/rows.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace heml::panel {

struct Banner {
  std::string title, text;
  std::string button;  ///< its label; empty: no button
  ImU32 colour = colours::warning;
  std::string close = {};           ///< label of a second button, which dismisses it; empty: none
  std::optional<Area> beside = {};  ///< it stands in the bottom right corner of this area, off the body
};

enum class BannerPress { none, button, close };

class Notices {
 public:
  /// A notice, shown for some seconds. folder: that its button opens; empty: no button.
  void notify(std::string text, std::filesystem::path folder = {});
  void show_error(std::string title, std::string text);  ///< a failure, shown until closed
  bool close();                                          ///< closes the failure; true if one was open

  /// Draws failure, banner and notice within the free area, over the panel where that is too narrow. Returns which of
  /// the banner's buttons was pressed. seconds: since the last frame.
  BannerPress draw(Rows& rows, const Area& free, const std::optional<Banner>& banner, float seconds);

  /// The folder whose button was pressed in the last draw(), once.
  std::optional<std::filesystem::path> take_folder() { return std::exchange(opened_, std::nullopt); }
  /// Height of the banner that stood beside the body in the last frame, pixels; 0: none did.
  float height_beside() const { return height_beside_; }

  bool animating() const { return !notice_.empty(); }
  /// Whether a point was on a banner in the last frame.
  bool covers(float x, float y) const;

 private:
  BannerPress draw_banner(Rows& rows, const char* id, const Area& free, const Banner& banner);
  void draw_notice(Rows& rows, const Area& free, float seconds);
  static bool draw_wide_button(Rows& rows, const std::string& label, float room);

  std::string failure_title_, failure_, notice_;
  float notice_age_ = 0;  ///< s
  float height_beside_ = 0;
  std::filesystem::path folder_;
  std::optional<std::filesystem::path> opened_;
  std::vector<Area> rects_;
};

}  // namespace heml::panel
