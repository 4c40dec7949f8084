#include <algorithm>
#include <app/panel/keys.hpp>

namespace heml::panel {
namespace {
using enum Modifier;

constexpr KeyBinding bindings[] = {
    {'O', control, Action::open, "Ctrl+O", "open a scene, a recording, a mesh or a surface"},
    {key_up, none, Action::select_previous, "Up, Down", "select in the open dialog; Enter opens"},
    {key_down, none, Action::select_next, "", ""},
    {key_enter, none, Action::open_selected, "", ""},
    {'S', control, Action::save, "Ctrl+S", "save the scene with the current settings"},
    {' ', none, Action::toggle_play, "Space", "play or pause"},
    {'.', none, Action::step, ".", "step by one tick"},
    {key_left, none, Action::seek_previous, "Left, Right", "show the previous, next frame"},
    {key_right, none, Action::seek_next, "", ""},
    {key_home, none, Action::seek_start, "Home, End", "show the start; back to live"},
    {key_end, none, Action::seek_live, "", ""},
    {'B', none, Action::resume, "B", "resume from the shown time"},
    {'R', none, Action::reset, "R", "reset to the initial state; all that was set stays"},
    {'R', Modifier::shift, Action::reset_all, "Shift+R", "reset all of the scene, as it was opened"},
    {'F', none, Action::fit, "F", "fit the body into view"},
    {'1', none, Action::show_tissue, "1", "tissue"},
    {'2', none, Action::show_displacement, "2", "colours: displacement"},
    {'3', none, Action::show_stretch, "3", "colours: stretch"},
    {'4', none, Action::show_von_mises, "4", "colours: von Mises stress"},
    {'5', none, Action::show_volume_ratio, "5", "colours: volume ratio"},
    {'6', none, Action::show_error, "6", "colours: mesh error"},
    {'W', none, Action::wireframe, "W", "wireframe"},
    {'K', none, Action::section, "K", "section plane: cut the drawn body open, or whole again"},
    {key_f5, none, Action::view_1, "F5 to F8", "restore a saved view"},
    {key_f6, none, Action::view_2, "", ""},
    {key_f7, none, Action::view_3, "", ""},
    {key_f8, none, Action::view_4, "", ""},
    {key_f5, control, Action::save_view_1, "Ctrl+F5 to F8", "save this view"},
    {key_f6, control, Action::save_view_2, "", ""},
    {key_f7, control, Action::save_view_3, "", ""},
    {key_f8, control, Action::save_view_4, "", ""},
    {key_pad_1, none, Action::look_front, "Numpad 1, 3, 7", "look from the front, right, top"},
    {key_pad_3, none, Action::look_right, "", ""},
    {key_pad_7, none, Action::look_top, "", ""},
    {key_pad_1, control, Action::look_back, "Ctrl+numpad 1, 3, 7", "look from the back, left, bottom"},
    {key_pad_3, control, Action::look_left, "", ""},
    {key_pad_7, control, Action::look_bottom, "", ""},
    {key_pad_5, none, Action::orthographic, "Numpad 5", "orthographic, or with perspective"},
    {'V', none, Action::record_video, "V", "start or stop recording PNG frames and a video"},
    {'P', none, Action::screenshot, "P, F12", "save an image"},
    {key_f12, none, Action::screenshot, "", ""},
    {key_tab, none, Action::hide, "Tab", "hide or show the panel"},
    {'H', none, Action::help, "H, F1", "this page"},
    {key_f1, none, Action::help, "", ""},
    {key_escape, none, Action::release, "Esc", "release the tool; close messages; back to live"},
    {key_delete, none, Action::remove, "Del", "remove the tissue under the ring, or the clamp"},
    {'L', none, Action::leave_clamp, "L", "while pulling: leave the grasp there as a clamp"},
    {'G', none, Action::select_grasper, "G", "grasper"},
    {'C', none, Action::select_scalpel, "C", "scalpel"},
    {'I', none, Action::select_scissors, "I", "scissors: click to snip, drag to snip on"},
    {'D', none, Action::select_cautery, "D", "cautery (diathermy): draw on the tissue to burn it"},
    {'N', none, Action::select_pin, "N", "pin (on a pin: remove it)"},
    {'O', none, Action::select_probe, "O", "probe"},
    {'S', none, Action::select_suture, "S", "suture: click both ends"},
    {'X', none, Action::select_remover, "X", "remover: click the tissue to remove"},
    {'M', none, Action::select_measure, "M", "measure: click one to three points"},
    {'E', none, Action::select_nodes, "E", "select nodes to fix or load: click, drag; Shift adds, Ctrl takes away"},
    {'N', Modifier::shift, Action::pin_selected, "Shift+N", "pin the selected nodes"},
    {'N', control, Action::unpin_selected, "Ctrl+N", "pins let go of the selected nodes"},
    {'T', none, Action::toggle_table, "T", "add or remove a table under the body"},
    {'Z', control, Action::undo, "Ctrl+Z", "undo the last action"},
    {'Z', control_shift, Action::redo, "Ctrl+Shift+Z", "redo; Ctrl+Y does too"},
    {'Y', control, Action::redo, "", ""},
    {'Q', control, Action::quit, "Ctrl+Q", "quit"},
};
}  // namespace

std::span<const KeyBinding> key_bindings() { return bindings; }

std::optional<Action> action_of(int key, bool control, bool shift) {
  const auto is_bound = [&](Modifier modifier) {
    return std::any_of(std::begin(bindings), std::end(bindings),
                       [&](const KeyBinding& b) { return b.key == key && b.modifier == modifier; });
  };
  const Modifier with_shift = control ? control_shift : Modifier::shift;
  const Modifier held = shift && is_bound(with_shift) ? with_shift : control ? Modifier::control : none;
  for (const KeyBinding& binding : bindings)
    if (binding.key == key && binding.modifier == held) return binding.action;
  return std::nullopt;
}

std::string key_name(Action action) {
  for (const KeyBinding& binding : bindings) {
    if (binding.action != action) continue;
    const bool is_letter = binding.key > ' ' && binding.key < key_escape;
    if (!is_letter) return binding.label;
    const char* modifier = binding.modifier == none              ? ""
                           : binding.modifier == Modifier::shift ? "Shift+"
                           : binding.modifier == control         ? "Ctrl+"
                                                                 : "Ctrl+Shift+";
    return modifier + std::string(1, static_cast<char>(binding.key));
  }
  return "";
}

}  // namespace heml::panel
