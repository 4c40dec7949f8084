#pragma once
// What to open: scenes with pictures, what was opened last, and folders.
//
//    ┌ Open ───── what to look for ──────── × ┐
//    │ Scenes              Recent             │
//    │ ┌────┐ ┌────┐ ┌────┐ liver.json         │
//    │ └────┘ └────┘ └────┘ Files in ~/work    │
//    │ ┌────┐ ┌────┐        ..                 │     a narrow picture has one column
//    └────────────────────────────────────────┘
#include <app/panel/actions.hpp>
#include <app/panel/area.hpp>
#include <app/panel/open_choices.hpp>
#include <app/panel/rows.hpp>

namespace heml::panel {

class OpenDialog {
 public:
  void open();
  bool close();  ///< true when it was open
  bool is_open() const { return open_; }

  /// What is marked of what the last draw() showed: goes up (−1) or down (1), and is opened.
  void choose(int direction);
  void open_chosen(PanelActions& out);

  /// What it shows from now on.
  void set_choices(OpenChoices choices) { choices_ = std::move(choices); }

  /// Over all of a picture of a size (pixels), while it is open. A press tells what to open or to look into.
  void draw(Rows& rows, ImVec2 picture, PanelActions& out);

 private:
  enum class Shape { cell, line };

  void draw_head(Rows& rows);
  void draw_scenes(Rows& rows, PanelActions& out);
  void draw_files(Rows& rows, PanelActions& out);
  void draw_group(Rows& rows, const std::string& heading, const std::vector<OpenChoice>& choices, Shape shape,
                  PanelActions& out);
  bool draw_cell(Rows& rows, const OpenChoice& choice, float width, bool marked);
  bool draw_line(Rows& rows, const OpenChoice& choice, bool marked);
  bool matches(const OpenChoice& choice) const;
  void activate(const OpenChoice& choice, PanelActions& out);

  OpenChoices choices_;
  bool open_ = false, just_opened_ = false;
  char wanted_[256] = {};                 ///< what is looked for
  int marked_ = -1;                       ///< place in shown_ that open_chosen() takes; −1: none
  bool moved_ = false;                    ///< the mark, by a key
  std::vector<const OpenChoice*> shown_;  ///< in this frame
};

}  // namespace heml::panel
