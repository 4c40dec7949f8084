#pragma once
// A question in the middle of the image, above everything else, until it is answered by mouse or keys.
//
//    ┌──────────────────────────────────────┐
//    │ Save what was done?                  │
//    │ A recording has all of it …          │     Left, Right or Tab select, Enter answers, Esc is the last answer
//    │ [ Save ]  [ Discard ]  [ Cancel ]    │
//    └──────────────────────────────────────┘
#include <app/panel/actions.hpp>
#include <app/panel/rows.hpp>
#include <optional>
#include <string>
#include <vector>

namespace heml::panel {

class Question {
 public:
  /// answers: labels of the buttons; the first is selected, the last is that of Esc.
  void ask(std::string title, std::string text, std::vector<std::string> answers);
  bool is_open() const { return !answers_.empty(); }

  /// What a key does while the question is open.
  void press(Action action);
  /// Draws it over an image of a size (pixels) while open. Returns the index of an answer, once.
  std::optional<std::size_t> draw(Rows& rows, ImVec2 picture);

 private:
  std::string title_, text_;
  std::vector<std::string> answers_;
  std::size_t selected_ = 0;
  std::optional<std::size_t> chosen_;
};

}  // namespace heml::panel
