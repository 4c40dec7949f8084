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
void draw_eye(ImDrawList& list, ImVec2 centre, float half, ImU32 colour, bool open);

// Tools, and what is done to the picture and the scene.
void draw_forceps(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_scalpel(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_scissors(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_electrode(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_pin(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_probe(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_needle(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_eraser(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_ruler(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_marquee(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_table(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_frame(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_camera(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_film(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);
void draw_tray(ImDrawList& list, ImVec2 centre, float half, ImU32 colour);

}  // namespace heml::panel
