#include <doctest/doctest.h>

#include <app/panel/keys.hpp>
#include <set>
#include <utility>

namespace heml::keys_test {

using namespace heml::panel;

TEST_CASE("keys mean what the help page says") {
  CHECK(action_of(' ', false) == Action::toggle_play);
  CHECK(action_of('.', false) == Action::step);
  CHECK(action_of('R', false) == Action::reset);
  CHECK(action_of('4', false) == Action::show_von_mises);
  CHECK(action_of(key_f12, false) == Action::screenshot);
  CHECK(action_of(key_delete, false) == Action::remove);
  CHECK(action_of('Q', true) == Action::quit);
  CHECK_FALSE(action_of('Q', false));
  CHECK_FALSE(action_of('R', true));
  CHECK_FALSE(action_of('Z', false));
  CHECK(action_of('Z', true) == Action::undo);
  CHECK(action_of('Z', true, true) == Action::redo);
  CHECK(action_of('Y', true) == Action::redo);
  CHECK(action_of('G', false, true) == Action::select_grasper);  // Shift counts where it is bound
  CHECK(action_of('R', false, true) == Action::reset_all);
  CHECK(action_of('S', true, true) == Action::save);
  CHECK(action_of('N', false, true) == Action::pin_selected);
  CHECK(action_of('N', true) == Action::unpin_selected);
}

TEST_CASE("keys have names that people read") {
  CHECK(key_name(Action::select_grasper) == "G");
  CHECK(key_name(Action::reset_all) == "Shift+R");
  CHECK(key_name(Action::save) == "Ctrl+S");
  CHECK(key_name(Action::redo) == "Ctrl+Shift+Z");
  CHECK(key_name(Action::toggle_play) == "Space");
}

TEST_CASE("the numpad turns to standard views as in other programs, with Ctrl to the opposite ones") {
  CHECK(action_of(key_pad_1, false) == Action::look_front);
  CHECK(action_of(key_pad_1, true) == Action::look_back);
  CHECK(action_of(key_pad_3, false, true) == Action::look_right);  // Num Lock may come with Shift
  CHECK(action_of(key_pad_3, true) == Action::look_left);
  CHECK(action_of(key_pad_7, false) == Action::look_top);
  CHECK(action_of(key_pad_7, true) == Action::look_bottom);
  CHECK(action_of(key_pad_5, false) == Action::orthographic);
  CHECK(action_of('1', false) == Action::show_tissue);
}

TEST_CASE("no key is bound twice, and every action has one") {
  std::set<std::pair<int, Modifier>> keys;
  std::set<Action> actions;
  for (const KeyBinding& binding : key_bindings()) {
    CHECK(keys.insert({binding.key, binding.modifier}).second);
    actions.insert(binding.action);
  }
  CHECK(actions.size() == static_cast<std::size_t>(Action::quit) + 1);
}

}  // namespace heml::keys_test
