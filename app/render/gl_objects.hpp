#pragma once
// RAII wrappers of OpenGL names, and a shader program with its uniforms. Constructors and destructors need a current
// context.
#include <glad/gl.h>

#include <app/render/image.hpp>
#include <heml/math/types.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace heml::render {

using Mat4f = Eigen::Matrix4f;
using Vec2f = Eigen::Vector2f;
using Vec4f = Eigen::Vector4f;

/// Owns one OpenGL name; Traits::make and Traits::drop create and delete it.
template <class Traits>
class GlHandle {
 public:
  GlHandle() : name_(Traits::make()) {}
  ~GlHandle() {
    if (name_) Traits::drop(name_);
  }
  GlHandle(GlHandle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlHandle& operator=(GlHandle&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  operator GLuint() const { return name_; }

 private:
  GLuint name_;
};

// clang-format off
struct BufferTraits {
  static GLuint make() { GLuint name; glGenBuffers(1, &name); return name; }
  static void drop(GLuint name) { glDeleteBuffers(1, &name); }
};
struct VertexArrayTraits {
  static GLuint make() { GLuint name; glGenVertexArrays(1, &name); return name; }
  static void drop(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct TextureTraits {
  static GLuint make() { GLuint name; glGenTextures(1, &name); return name; }
  static void drop(GLuint name) { glDeleteTextures(1, &name); }
};
struct RenderbufferTraits {
  static GLuint make() { GLuint name; glGenRenderbuffers(1, &name); return name; }
  static void drop(GLuint name) { glDeleteRenderbuffers(1, &name); }
};
struct FramebufferTraits {
  static GLuint make() { GLuint name; glGenFramebuffers(1, &name); return name; }
  static void drop(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct ProgramTraits {
  static GLuint make() { return glCreateProgram(); }
  static void drop(GLuint name) { glDeleteProgram(name); }
};
// clang-format on

using Buffer = GlHandle<BufferTraits>;
using VertexArray = GlHandle<VertexArrayTraits>;
using Texture = GlHandle<TextureTraits>;
using Renderbuffer = GlHandle<RenderbufferTraits>;
using Framebuffer = GlHandle<FramebufferTraits>;

/// A linked pair of shaders from embedded files (resources.hpp), each preceded by "common.glsl".
class Program {
 public:
  /// defines: macros defined in both shaders. Throws std::logic_error with the compiler's log if they do not build.
  Program(const char* vertex, const char* fragment, const std::vector<const char*>& defines = {});

  void use() const { glUseProgram(name_); }

  // Set uniforms; the program must be in use. Ignores names that the compiler dropped as unused.
  void set(const char* name, int value) const { glUniform1i(place(name), value); }
  void set(const char* name, float value) const { glUniform1f(place(name), value); }
  void set(const char* name, const Vec2f& value) const { glUniform2fv(place(name), 1, value.data()); }
  void set(const char* name, const Vec3f& value) const { glUniform3fv(place(name), 1, value.data()); }
  void set(const char* name, const Vec4f& value) const { glUniform4fv(place(name), 1, value.data()); }
  void set(const char* name, const Mat4f& value) const { glUniformMatrix4fv(place(name), 1, GL_FALSE, value.data()); }

 private:
  GLint place(const char* name) const { return glGetUniformLocation(name_, name); }
  GlHandle<ProgramTraits> name_;
};

/// Replaces the contents of a buffer. usage: GL_STATIC_DRAW or GL_STREAM_DRAW.
template <class Value>
void upload(GLenum target, const Buffer& buffer, std::span<const Value> values, GLenum usage) {
  glBindBuffer(target, buffer);
  glBufferData(target, static_cast<GLsizeiptr>(values.size_bytes()), values.data(), usage);
}

/// One attribute of the bound vertex array, read from the bound array buffer. Bytes are normalised to 0..1.
void vertex_attribute(GLuint index, int components, GLenum type, std::size_t stride, std::size_t offset);

/// Allocates storage for a texture, with linear filtering and clamped edges.
void allocate_texture(const Texture& texture, GLint internal_format, GLenum format, GLenum type, Size size);

/// An off-screen framebuffer with colour and depth.
class RenderTarget {
 public:
  /// Throws std::runtime_error if the driver refuses the size.
  explicit RenderTarget(Size size);
  void bind() const { glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_); }
  void stretch_to_screen(int left, int bottom, Size size) const;  ///< into a part of framebuffer 0, then bound
  Size size() const { return size_; }

 private:
  Size size_;
  Framebuffer framebuffer_;
  Renderbuffer colour_, depth_;
};

}  // namespace heml::render
