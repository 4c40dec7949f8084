#pragma once
// OpenGL in memory by Mesa's software renderer; needs neither display nor graphics card.
#include <app/render/context.hpp>
#include <memory>

namespace heml::render {

class OsMesaContext final : public GraphicsContext {
 public:
  /// A context of a fixed size, current on the calling thread.
  /// Throws std::runtime_error if libOSMesa is not installed or offers no OpenGL 3.3 core context.
  explicit OsMesaContext(Size size);
  ~OsMesaContext() override;

  void make_current() override;
  /// The calling thread draws nowhere; another one may make it current.
  void release();
  Size size() const override;
  void present() override {}
  GLADloadfunc loader() const override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heml::render
