#include "app/render/osmesa_context.hpp"

#include <GL/osmesa.h>
#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace heml::render {
namespace {

// libOSMesa, loaded at run time: if linked, its OpenGL symbols would clash with those of a window's libGL. Never
// closed, since Mesa keeps threads of its own between contexts.
struct Library {
  decltype(&OSMesaCreateContextAttribs) create;
  decltype(&OSMesaDestroyContext) destroy;
  decltype(&OSMesaMakeCurrent) make_current;
  GLADloadfunc get_proc_address;

  Library() {
    void* handle = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
    if (!handle) throw std::runtime_error("drawing without a display needs libOSMesa.so.8 (Debian: libosmesa6)");
    find(handle, "OSMesaCreateContextAttribs", create);
    find(handle, "OSMesaDestroyContext", destroy);
    find(handle, "OSMesaMakeCurrent", make_current);
    find(handle, "OSMesaGetProcAddress", get_proc_address);
  }

 private:
  template <class Function>
  static void find(void* handle, const char* name, Function& function) {
    function = reinterpret_cast<Function>(dlsym(handle, name));
    if (!function) throw std::runtime_error(std::string("libOSMesa.so.8 lacks ") + name);
  }
};

const Library& library() {
  static const Library loaded;
  return loaded;
}

}  // namespace

class OsMesaContext::Impl {
 public:
  explicit Impl(Size wanted) : size(wanted), pixels(std::size_t{4} * wanted.width * wanted.height) {
    const int attributes[] = {OSMESA_FORMAT,
                              OSMESA_RGBA,
                              OSMESA_DEPTH_BITS,
                              24,
                              OSMESA_PROFILE,
                              OSMESA_CORE_PROFILE,
                              OSMESA_CONTEXT_MAJOR_VERSION,
                              3,
                              OSMESA_CONTEXT_MINOR_VERSION,
                              3,
                              0};
    context = library().create(attributes, nullptr);
    if (!context) throw std::runtime_error("libOSMesa gives no OpenGL 3.3 core context");
  }
  ~Impl() { library().destroy(context); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  Size size;
  std::vector<std::uint8_t> pixels;  // framebuffer 0
  OSMesaContext context = nullptr;
};

OsMesaContext::OsMesaContext(Size size) : impl_(std::make_unique<Impl>(size)) {
  make_current();
  load_functions();
}

OsMesaContext::~OsMesaContext() = default;

void OsMesaContext::make_current() {
  if (!library().make_current(impl_->context, impl_->pixels.data(), GL_UNSIGNED_BYTE, impl_->size.width,
                              impl_->size.height))
    throw std::runtime_error("libOSMesa cannot draw into an image of this size");
}

void OsMesaContext::release() { library().make_current(nullptr, nullptr, 0, 0, 0); }

Size OsMesaContext::size() const { return impl_->size; }

GLADloadfunc OsMesaContext::loader() const { return library().get_proc_address; }

}  // namespace heml::render
