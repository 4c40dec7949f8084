#pragma once
// Drawings on buttons: centre and half size in pixels.
#include <imgui.h>

namespace heml::panel {

void draw_play(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_pause(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_step(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_reset(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_folder(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_cross(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_question(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);

}  // namespace heml::panel
