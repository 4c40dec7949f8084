#include "app/render/gl_objects.hpp"

#include <app/render/resources.hpp>
#include <array>
#include <stdexcept>

namespace heml::render {
namespace {

void check_log(GLuint object, const char* name, bool program) {
  GLint good = 0;
  std::array<char, 2048> log{};
  if (program) {
    glGetProgramiv(object, GL_LINK_STATUS, &good);
    if (!good) glGetProgramInfoLog(object, static_cast<GLsizei>(log.size()), nullptr, log.data());
  } else {
    glGetShaderiv(object, GL_COMPILE_STATUS, &good);
    if (!good) glGetShaderInfoLog(object, static_cast<GLsizei>(log.size()), nullptr, log.data());
  }
  if (!good) throw std::logic_error(std::string("shader ") + name + ": " + log.data());
}

GLuint compile(GLenum stage, const char* name, const std::vector<const char*>& defines) {
  std::string source = "#version 330 core\n";
  for (const char* define : defines) source += std::string("#define ") + define + "\n";
  source += resource("common.glsl");
  source += "#line 1\n";
  source += resource(name);
  const GLuint shader = glCreateShader(stage);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  check_log(shader, name, false);
  return shader;
}

}  // namespace

Program::Program(const char* vertex, const char* fragment, const std::vector<const char*>& defines) {
  const std::array<GLuint, 2> shaders = {compile(GL_VERTEX_SHADER, vertex, defines),
                                         compile(GL_FRAGMENT_SHADER, fragment, defines)};
  for (const GLuint shader : shaders) glAttachShader(name_, shader);
  glLinkProgram(name_);
  for (const GLuint shader : shaders) glDeleteShader(shader);
  check_log(name_, fragment, true);
}

void vertex_attribute(GLuint index, int components, GLenum type, std::size_t stride, std::size_t offset) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, components, type, type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE,
                        static_cast<GLsizei>(stride), reinterpret_cast<const void*>(offset));
}

void allocate_texture(const Texture& texture, GLint internal_format, GLenum format, GLenum type, Size size) {
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexImage2D(GL_TEXTURE_2D, 0, internal_format, size.width, size.height, 0, format, type, nullptr);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
}

RenderTarget::RenderTarget(Size size) : size_(size) {
  bind();
  const auto attach = [&](const Renderbuffer& buffer, GLenum format, GLenum point) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffer);
    glRenderbufferStorage(GL_RENDERBUFFER, format, size.width, size.height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, point, GL_RENDERBUFFER, buffer);
  };
  attach(colour_, GL_RGBA8, GL_COLOR_ATTACHMENT0);
  attach(depth_, GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("the graphics driver refuses to draw a picture of this size");
}

void RenderTarget::stretch_to_screen(int left, int bottom, Size size) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBlitFramebuffer(0, 0, size_.width, size_.height, left, bottom, left + size.width, bottom + size.height,
                    GL_COLOR_BUFFER_BIT, GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace heml::render
