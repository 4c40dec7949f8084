#include <fmt/format.h>

#include <app/panel/header.hpp>
#include <app/panel/icons.hpp>
#include <app/panel/undo_section.hpp>

namespace heml::panel {
namespace {

void draw_pace(Rows& rows, const Frame& frame) {
  const bool halted = !frame.halted.empty(), forwards = frame.fast_forward_target > 0;
  const bool paused = frame.paused && !forwards, late = !frame.pace.keeping_up && !paused;
  const double slowdown = frame.pace.slowdown;
  const ImU32 colour = halted ? colours::danger : late ? colours::warning : paused ? colours::muted : colours::accent;
  const std::string text = halted     ? "stopped"
                           : paused   ? "paused"
                           : late     ? fmt::format("{:.1f}× slower than real time", slowdown)
                           : forwards ? fmt::format("{:.3g}× faster than real time", 1 / slowdown)
                                      : "real time";
  const UseFont small(Font::small);
  rows.value({"Speed", "Whether simulated time keeps up with wall-clock time."}, text, colour, colour);
}

}  // namespace

void draw_header(Rows& rows, const std::string& title, const std::string& description, const Frame& frame,
                 const MeshOpenings& openings, std::vector<Action>& pressed) {
  const std::string time = fmt::format("{:.2f} s", frame.time);
  const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(time.c_str()).x - em(0.8f);
  {
    const UseFont large(Font::title);
    ImGui::TextUnformatted(elided(title, room).c_str());
  }
  rows.explain({"Title", description.empty() ? title : title + "\n\n" + description});
  ImGui::SameLine();
  text_at_right(time, colours::text);
  rows.explain(
      {"Time", fmt::format("Simulated time since the start or the last reset; tick {} of the engine.", frame.tick)});
  const float size = em(1.95f);
  const auto button = [&](const char* name, const char* hint, bool strong, Action action, const Rows::Icon& icon) {
    if (rows.icon_button({name, hint}, size, strong, icon)) pressed.push_back(action);
    ImGui::SameLine(0, em(0.3f));
  };
  if (frame.paused)
    button("Play", "Runs the simulation (Space).", true, Action::toggle_play, draw_play);
  else
    button("Pause", "Pauses the simulation (Space).", true, Action::toggle_play, draw_pause);
  button("Step", "One tick of the engine, then pause (. key).", false, Action::step, draw_step);
  button("Undo", undo_hint(frame, openings, -1).c_str(), false, Action::undo, draw_undo);
  button("Redo", undo_hint(frame, openings, 1).c_str(), false, Action::redo, draw_redo);
  button("Reset",
         "Back to the initial state at time 0; all that was set stays (R). Shift+R: all of the scene as it was opened, "
         "one step for undo.",
         false, Action::reset, draw_reset);
  button("Open", "Opens installed scenes, recent files, and files in folders (Ctrl+O).", false, Action::open,
         draw_folder);
  button("Help", "Mouse and keys (H).", false, Action::help, draw_question);
  ImGui::NewLine();
  draw_pace(rows, frame);
  ImGui::Separator();
}

}  // namespace heml::panel
