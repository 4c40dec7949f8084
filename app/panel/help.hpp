#pragma once
// The help page: mouse and keys, and a search through them and through the rows of the panel.
#include <app/panel/rows.hpp>
#include <array>
#include <string>
#include <vector>

namespace heml::panel {

/// A key, or a row of the panel, and its meaning; below a title.
struct HelpEntry {
  std::string title, left, right;
  bool operator==(const HelpEntry&) const = default;
};

/// Entries that have all words, in the order of the page and the panel.
std::vector<HelpEntry> find_help(const std::string& words, const std::vector<Rows::Listed>& rows);

class Help {
 public:
  bool is_open() const { return open_; }
  void toggle();
  void close() { open_ = false; }

  /// Draws the page in the middle of the image, if it is open. A click beside it closes it. rows: those of the panel as
  /// drawn in this frame, which list themselves while the page is open.
  void draw(const Rows& rows, ImVec2 picture);

 private:
  void draw_search(float room);
  void draw_page(ImVec2 room);
  void draw_found(const Rows& rows, float width) const;

  bool open_ = false;
  std::array<char, 64> search_{};
  ImVec2 page_{0, 0};  ///< pixels, of the window with the whole page: it stays as large while one searches
};

}  // namespace heml::panel
