#pragma once
// Icons of buttons, drawn round a centre with a half size, pixels.
#include <imgui.h>

namespace heml::panel {

void draw_play(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_pause(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_step(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_reset(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_undo(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_redo(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_folder(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_cross(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_question(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);

}  // namespace heml::panel
