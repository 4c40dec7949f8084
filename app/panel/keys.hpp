#pragma once
// The keyboard: one table that both the window and the help page read.
#include <app/panel/actions.hpp>
#include <span>

namespace heml::panel {

/// Printable keys are their own character, letters in upper case; the rest have numbers past ASCII.
enum Key : int {
  key_escape = 256,
  key_tab,
  key_f1,
  key_f5,
  key_f6,
  key_f7,
  key_f8,
  key_f12,
  key_delete,
  key_left,
  key_right,
  key_home,
  key_end,
  key_up,
  key_down,
  key_enter
};

struct KeyBinding {
  int key;
  bool control;  ///< with Ctrl held
  Action action;
  const char* label;  ///< as the help page writes the key; empty: another key of the line above
  const char* meaning;
};

std::span<const KeyBinding> key_bindings();

/// What a key means; nothing for keys without meaning.
std::optional<Action> action_of(int key, bool control);

}  // namespace heml::panel
