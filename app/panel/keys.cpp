#include <app/panel/keys.hpp>

namespace heml::panel {
namespace {
constexpr KeyBinding bindings[] = {
    {'O', true, Action::open, "Ctrl+O", "open a scene, a recording, a mesh or a surface"},
    {key_up, false, Action::choose_previous, "Up, Down", "choose there what Enter opens"},
    {key_down, false, Action::choose_next, "", ""},
    {key_enter, false, Action::open_chosen, "", ""},
    {'S', true, Action::save, "Ctrl+S", "save the scene as it is set, as a file to open"},
    {' ', false, Action::toggle_play, "Space", "play or pause"},
    {'.', false, Action::step, ".", "one tick, then pause"},
    {key_left, false, Action::seek_earlier, "Left, Right", "show the previous, next frame"},
    {key_right, false, Action::seek_later, "", ""},
    {key_home, false, Action::seek_start, "Home, End", "show the start; back to the present"},
    {key_end, false, Action::seek_now, "", ""},
    {'B', false, Action::resume, "B", "resume from the shown time"},
    {'R', false, Action::reset, "R", "reset to the initial state"},
    {'F', false, Action::fit, "F", "fit the body into view"},
    {'1', false, Action::show_tissue, "1", "tissue"},
    {'2', false, Action::show_displacement, "2", "colours: displacement"},
    {'3', false, Action::show_stretch, "3", "colours: stretch"},
    {'4', false, Action::show_von_mises, "4", "colours: von Mises stress"},
    {'5', false, Action::show_volume_ratio, "5", "colours: volume ratio"},
    {'6', false, Action::show_error, "6", "colours: error of the mesh"},
    {'W', false, Action::wireframe, "W", "edges of the mesh"},
    {key_f5, false, Action::view_1, "F5 to F8", "go to a view that was kept"},
    {key_f6, false, Action::view_2, "", ""},
    {key_f7, false, Action::view_3, "", ""},
    {key_f8, false, Action::view_4, "", ""},
    {key_f5, true, Action::keep_view_1, "Ctrl+F5 to F8", "keep this view"},
    {key_f6, true, Action::keep_view_2, "", ""},
    {key_f7, true, Action::keep_view_3, "", ""},
    {key_f8, true, Action::keep_view_4, "", ""},
    {'V', false, Action::film, "V", "record PNG frames, and a video with ffmpeg; again: stop"},
    {'P', false, Action::screenshot, "P, F12", "save an image"},
    {key_f12, false, Action::screenshot, "", ""},
    {key_tab, false, Action::hide, "Tab", "hide or show the panel"},
    {'H', false, Action::help, "H, F1", "this page"},
    {key_f1, false, Action::help, "", ""},
    {key_escape, false, Action::release, "Esc", "let go; close messages; back to the present"},
    {key_delete, false, Action::remove, "Del", "remove the tissue under the ring"},
    {'G', false, Action::take_grasper, "G", "grasp with the left button"},
    {'C', false, Action::take_scalpel, "C", "cut with the left button"},
    {'N', false, Action::take_pin, "N", "pin, or take a pin out, with the left button"},
    {'O', false, Action::take_probe, "O", "push a probe with the left button"},
    {'S', false, Action::take_suture, "S", "suture: two clicks, one an end"},
    {'T', false, Action::toggle_table, "T", "a table under the body, or none"},
    {'Z', true, Action::undo, "Ctrl+Z", "take back the last cut or removal"},
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
