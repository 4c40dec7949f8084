#include <app/panel/keys.hpp>

namespace heml::panel {
namespace {
constexpr KeyBinding bindings[] = {
    {'O', true, Action::open, "Ctrl+O", "open a scene, a recording, a mesh or a surface"},
    {key_up, false, Action::select_previous, "Up, Down", "select in the open dialog; Enter opens"},
    {key_down, false, Action::select_next, "", ""},
    {key_enter, false, Action::open_selected, "", ""},
    {'S', true, Action::save, "Ctrl+S", "save the scene with the current settings"},
    {' ', false, Action::toggle_play, "Space", "play or pause"},
    {'.', false, Action::step, ".", "step by one tick"},
    {key_left, false, Action::seek_previous, "Left, Right", "show the previous, next frame"},
    {key_right, false, Action::seek_next, "", ""},
    {key_home, false, Action::seek_start, "Home, End", "show the start; back to live"},
    {key_end, false, Action::seek_live, "", ""},
    {'B', false, Action::resume, "B", "resume from the shown time"},
    {'R', false, Action::reset, "R", "reset to the initial state"},
    {'F', false, Action::fit, "F", "fit the body into view"},
    {'1', false, Action::show_tissue, "1", "tissue"},
    {'2', false, Action::show_displacement, "2", "colours: displacement"},
    {'3', false, Action::show_stretch, "3", "colours: stretch"},
    {'4', false, Action::show_von_mises, "4", "colours: von Mises stress"},
    {'5', false, Action::show_volume_ratio, "5", "colours: volume ratio"},
    {'6', false, Action::show_error, "6", "colours: discretisation error"},
    {'W', false, Action::wireframe, "W", "wireframe"},
    {key_f5, false, Action::view_1, "F5 to F8", "restore a saved view"},
    {key_f6, false, Action::view_2, "", ""},
    {key_f7, false, Action::view_3, "", ""},
    {key_f8, false, Action::view_4, "", ""},
    {key_f5, true, Action::save_view_1, "Ctrl+F5 to F8", "save this view"},
    {key_f6, true, Action::save_view_2, "", ""},
    {key_f7, true, Action::save_view_3, "", ""},
    {key_f8, true, Action::save_view_4, "", ""},
    {'V', false, Action::record_video, "V", "start or stop recording PNG frames and a video"},
    {'P', false, Action::screenshot, "P, F12", "save an image"},
    {key_f12, false, Action::screenshot, "", ""},
    {key_tab, false, Action::hide, "Tab", "hide or show the panel"},
    {'H', false, Action::help, "H, F1", "this page"},
    {key_f1, false, Action::help, "", ""},
    {key_escape, false, Action::release, "Esc", "release the tool; close messages; back to live"},
    {key_delete, false, Action::remove, "Del", "remove the tissue under the ring"},
    {'G', false, Action::select_grasper, "G", "grasper"},
    {'C', false, Action::select_scalpel, "C", "scalpel"},
    {'N', false, Action::select_pin, "N", "pin (on a pin: remove it)"},
    {'O', false, Action::select_probe, "O", "probe"},
    {'S', false, Action::select_suture, "S", "suture: click both ends"},
    {'T', false, Action::toggle_table, "T", "add or remove a table under the body"},
    {'Z', true, Action::undo, "Ctrl+Z", "undo the last cut or removal"},
    {'Q', true, Action::quit, "Ctrl+Q", "quit"},
};
}  // namespace

std::span<const KeyBinding> key_bindings() { return bindings; }

std::optional<Action> action_of(int key, bool control) {
  for (const KeyBinding& binding : bindings)
    if (binding.key == key && binding.control == control) return binding.action;
  return std::nullopt;
}

}  // namespace heml::panel
