#pragma once
// Key bindings: one table for the window and the help page.
#include <app/panel/actions.hpp>
#include <span>
#include <string>

namespace heml::panel {

/// Printable keys are their ASCII character, letters in upper case; other keys have numbers above ASCII.
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
  key_enter,
  key_pad_1,
  key_pad_3,
  key_pad_5,
  key_pad_7
};

enum class Modifier { none, shift, control, control_shift };

struct KeyBinding {
  int key;
  Modifier modifier;
  Action action;
  const char* label;  ///< in the help page; empty: listed with the binding above
  const char* meaning;
};

std::span<const KeyBinding> key_bindings();

/// The action bound to a key, if any. Shift counts where a binding has it.
std::optional<Action> action_of(int key, bool control, bool shift = false);

/// The key of an action as people read it: "G", "Ctrl+S", "Space".
std::string key_name(Action action);

}  // namespace heml::panel
