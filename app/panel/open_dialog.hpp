#pragma once
// The open dialog: scenes with thumbnails, recent files, and a folder.
//
//    ┌ Open ───── search text ───────────── × ┐
//    │ Scenes              Recent             │
//    │ ┌────┐ ┌────┐ ┌────┐ liver.json         │
//    │ └────┘ └────┘ └────┘ Files in ~/work    │
//    │ ┌────┐ ┌────┐        ..                 │     narrow images have one column
//    └────────────────────────────────────────┘
#include <app/panel/actions.hpp>
#include <app/panel/area.hpp>
#include <app/panel/open_choices.hpp>
#include <app/panel/rows.hpp>

namespace heml::panel {

class OpenDialog {
 public:
  void open();
  bool close();  ///< true if it was open
  bool is_open() const { return open_; }

  /// Moves the selection among the entries of the last draw() up (−1) or down (1); opens the selected entry.
  void select(int direction);
  void open_selected(PanelActions& out);

  void set_choices(OpenChoices choices);

  /// Draws over an image of a size (pixels) while open. A click sets out.open or out.list_folder.
  void draw(Rows& rows, ImVec2 picture, PanelActions& out);

 private:
  enum class Shape { cell, line };

  void draw_head(Rows& rows);
  void draw_scenes(Rows& rows, PanelActions& out);
  void draw_files(Rows& rows, PanelActions& out);
  void draw_group(Rows& rows, const std::string& heading, const std::vector<OpenChoice>& choices, Shape shape,
                  PanelActions& out);
  bool draw_cell(Rows& rows, const OpenChoice& choice, float width, bool selected);
  bool draw_line(Rows& rows, const OpenChoice& choice, bool selected);
  bool matches(const OpenChoice& choice) const;
  void activate(const OpenChoice& choice, PanelActions& out);

  OpenChoices choices_;
  bool open_ = false, just_opened_ = false;
  char search_[256] = {};                 ///< search text
  int selected_ = -1;                     ///< index of the selection in shown_; −1: none
  bool selection_moved_ = false;          ///< the selection moved by a key: scroll to it
  std::vector<const OpenChoice*> shown_;  ///< entries drawn in this frame
};

}  // namespace heml::panel
