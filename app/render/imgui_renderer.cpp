#include "app/render/imgui_renderer.hpp"

#include <imgui.h>

#include <algorithm>
#include <app/render/resources.hpp>
#include <cstddef>
#include <cstdint>

namespace heml::render {
namespace {

// Dark translucent windows; controls in the green of the drape.
void set_style(float scale) {
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 8;
  style.FrameRounding = style.GrabRounding = style.PopupRounding = style.ScrollbarRounding = 4;
  style.WindowBorderSize = style.FrameBorderSize = 0;
  style.WindowPadding = {14, 12};
  style.FramePadding = {8, 4};
  style.ItemSpacing = {8, 7};
  const auto set = [&](ImGuiCol which, float r, float g, float b, float a) { style.Colors[which] = {r, g, b, a}; };
  set(ImGuiCol_Text, 0.90f, 0.93f, 0.94f, 1);
  set(ImGuiCol_TextDisabled, 0.52f, 0.58f, 0.61f, 1);
  set(ImGuiCol_WindowBg, 0.055f, 0.075f, 0.088f, 0.86f);
  set(ImGuiCol_PopupBg, 0.065f, 0.085f, 0.10f, 0.96f);
  set(ImGuiCol_TitleBg, 0.055f, 0.075f, 0.088f, 0.86f);
  set(ImGuiCol_TitleBgActive, 0.07f, 0.11f, 0.125f, 0.92f);
  set(ImGuiCol_FrameBg, 0.13f, 0.17f, 0.19f, 0.85f);
  set(ImGuiCol_FrameBgHovered, 0.17f, 0.25f, 0.28f, 0.9f);
  set(ImGuiCol_FrameBgActive, 0.19f, 0.32f, 0.35f, 1);
  set(ImGuiCol_Button, 0.14f, 0.31f, 0.34f, 0.9f);
  set(ImGuiCol_ButtonHovered, 0.19f, 0.43f, 0.47f, 1);
  set(ImGuiCol_ButtonActive, 0.23f, 0.54f, 0.58f, 1);
  set(ImGuiCol_Header, 0.14f, 0.27f, 0.30f, 0.8f);
  set(ImGuiCol_HeaderHovered, 0.18f, 0.38f, 0.42f, 0.9f);
  set(ImGuiCol_HeaderActive, 0.21f, 0.46f, 0.50f, 1);
  set(ImGuiCol_CheckMark, 0.42f, 0.84f, 0.85f, 1);
  set(ImGuiCol_SliderGrab, 0.34f, 0.68f, 0.70f, 1);
  set(ImGuiCol_SliderGrabActive, 0.46f, 0.86f, 0.88f, 1);
  set(ImGuiCol_PlotLines, 0.42f, 0.84f, 0.85f, 1);
  set(ImGuiCol_PlotHistogram, 0.93f, 0.62f, 0.30f, 1);
  set(ImGuiCol_Separator, 0.30f, 0.38f, 0.41f, 0.5f);
  style.ScaleAllSizes(scale);
}

}  // namespace

ImguiRenderer::ImguiRenderer(float scale) : context_(ImGui::CreateContext()) {
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // writes no imgui.ini
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  set_style(scale);
  make_font(scale);

  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  vertex_attribute(0, 2, GL_FLOAT, sizeof(ImDrawVert), offsetof(ImDrawVert, pos));
  vertex_attribute(1, 2, GL_FLOAT, sizeof(ImDrawVert), offsetof(ImDrawVert, uv));
  vertex_attribute(2, 4, GL_UNSIGNED_BYTE, sizeof(ImDrawVert), offsetof(ImDrawVert, col));
}

ImguiRenderer::~ImguiRenderer() { ImGui::DestroyContext(context_); }

void ImguiRenderer::make_font(float scale) {
  const std::string_view bytes = resource("Roboto-Medium.ttf");
  ImGuiIO& io = ImGui::GetIO();
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  static const ImWchar glyphs[] = {0x20, 0xff, 0x370, 0x3ff, 0x2010, 0x2027, 0x2070, 0x209f, 0x2200, 0x22ff, 0};
  io.Fonts->AddFontFromMemoryTTF(const_cast<char*>(bytes.data()), static_cast<int>(bytes.size()), 16 * scale, &config,
                                 glyphs);
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
  allocate_texture(font_, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, {width, height});
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
  io.Fonts->SetTexID(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(font_)));
  io.Fonts->ClearTexData();
}

void ImguiRenderer::begin_frame(Size size, float seconds) {
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(size.width), static_cast<float>(size.height)};
  io.DisplayFramebufferScale = {1, 1};
  io.DeltaTime = std::max(seconds, 1e-5f);
  ImGui::NewFrame();
}

namespace {

void fade(ImDrawList& list, float opacity) {
  for (ImDrawVert& vertex : list.VtxBuffer) {
    const auto alpha = static_cast<float>(vertex.col >> IM_COL32_A_SHIFT & 0xffu);
    vertex.col = (vertex.col & ~IM_COL32_A_MASK) | static_cast<ImU32>(alpha * opacity) << IM_COL32_A_SHIFT;
  }
}

}  // namespace

void ImguiRenderer::end_frame(float opacity) {
  const ImDrawList* marks = ImGui::GetBackgroundDrawList();
  ImGui::Render();
  const ImDrawData& data = *ImGui::GetDrawData();
  const ImVec2 origin = data.DisplayPos, size = data.DisplaySize;
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, static_cast<GLsizei>(size.x), static_cast<GLsizei>(size.y));
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glEnable(GL_SCISSOR_TEST);
  glActiveTexture(GL_TEXTURE0);
  program_.use();
  program_.set("frame", Vec4f(origin.x, origin.y, size.x, size.y));
  program_.set("picture", 0);
  glBindVertexArray(array_);
  for (int i = 0; i < data.CmdListsCount; ++i) {
    ImDrawList& list = *data.CmdLists[i];
    if (opacity < 1 && &list != marks) fade(list, opacity);
    upload(GL_ARRAY_BUFFER, vertices_, std::span<const ImDrawVert>(list.VtxBuffer.Data, list.VtxBuffer.Size),
           GL_STREAM_DRAW);
    upload(GL_ELEMENT_ARRAY_BUFFER, indices_, std::span<const ImDrawIdx>(list.IdxBuffer.Data, list.IdxBuffer.Size),
           GL_STREAM_DRAW);
    for (const ImDrawCmd& command : list.CmdBuffer) {
      if (command.UserCallback) {
        command.UserCallback(&list, &command);
        continue;
      }
      const ImVec4 clip = command.ClipRect;
      if (clip.z <= clip.x || clip.w <= clip.y) continue;
      glScissor(static_cast<GLint>(clip.x - origin.x), static_cast<GLint>(size.y - (clip.w - origin.y)),
                static_cast<GLsizei>(clip.z - clip.x), static_cast<GLsizei>(clip.w - clip.y));
      glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(reinterpret_cast<std::uintptr_t>(command.GetTexID())));
      glDrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount),
                               sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT,
                               reinterpret_cast<const void*>(command.IdxOffset * sizeof(ImDrawIdx)),
                               static_cast<GLint>(command.VtxOffset));
    }
  }
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
}

}  // namespace heml::render
