#include <imgui.h>

#include <algorithm>
#include <app/panel/interface.hpp>
#include <app/panel/theme.hpp>
#include <cstdint>

namespace heml::panel {
namespace {

/// Uploads the theme's fonts into the texture that the renderer created.
void upload_fonts(ImTextureID texture) {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  unsigned char* pixels = nullptr;
  int width = 0, height = 0;
  fonts.GetTexDataAsRGBA32(&pixels, &width, &height);
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(reinterpret_cast<std::uintptr_t>(texture)));
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
  fonts.SetTexID(texture);  // rebuilding the fonts cleared it
  fonts.ClearTexData();
}

}  // namespace

Interface::Interface(float scale, Theme theme) : renderer_(scale) {
  ImGui::GetIO().ConfigWindowsMoveFromTitleBarOnly = true;
  set_look(scale, theme);
}

float Interface::suitable_scale(render::Size size) {
  const float ratio = std::min(static_cast<float>(size.width) / 1280, static_cast<float>(size.height) / 720);
  return std::clamp(ratio, 0.72f, 1.0f);
}

void Interface::set_look(float scale, Theme theme) {
  if (scale == scale_ && theme == theme_ && !has_new_letters()) return;
  scale_ = scale;
  theme_ = theme;
  const ImTextureID texture = ImGui::GetIO().Fonts->TexID;
  apply_theme(scale, theme);
  upload_fonts(texture);
}

}  // namespace heml::panel
