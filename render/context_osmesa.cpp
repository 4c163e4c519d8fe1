#include <dlfcn.h>

#include <array>
#include <stdexcept>

#include "render/context.h"

namespace lather::render {
namespace {

// From <GL/osmesa.h>, which few machines have: the library is loaded at run time because Mesa 25.1 removed
// it.
using OsmesaContext = struct osmesa_context*;
constexpr int kFormat = 0x22, kDepthBits = 0x30, kStencilBits = 0x31, kProfile = 0x33, kCoreProfile = 0x34;
constexpr int kContextMajorVersion = 0x36, kContextMinorVersion = 0x37;
constexpr const char* kLibrary = "libOSMesa.so.8";

struct Osmesa {
  OsmesaContext (*create)(const int* attributes, OsmesaContext share) = nullptr;
  void (*destroy)(OsmesaContext) = nullptr;
  GLboolean (*make_current)(OsmesaContext, void* buffer, GLenum type, GLsizei width,
                            GLsizei height) = nullptr;
  GlProc (*get_proc_address)(const char* name) = nullptr;
};

template <class Function>
void find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (function == nullptr) throw std::runtime_error(std::string(kLibrary) + " has no " + name);
}

/// The library stays loaded: Mesa's threads and thread-local data do not survive unloading.
Osmesa open_osmesa() {
  void* library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error(dlerror());
  Osmesa osmesa;
  find(library, "OSMesaCreateContextAttribs", osmesa.create);
  find(library, "OSMesaDestroyContext", osmesa.destroy);
  find(library, "OSMesaMakeCurrent", osmesa.make_current);
  find(library, "OSMesaGetProcAddress", osmesa.get_proc_address);
  return osmesa;
}

class OsmesaBackend final : public Context {
 public:
  OsmesaBackend() : osmesa_(open_osmesa()) {
    const std::array<int, 13> attributes = {
        kFormat,  GL_RGBA,      kDepthBits,           0, kStencilBits,         0,
        kProfile, kCoreProfile, kContextMajorVersion, 3, kContextMinorVersion, 3,
        0};
    context_ = osmesa_.create(attributes.data(), nullptr);
    if (context_ == nullptr) throw std::runtime_error("no OpenGL 3.3 core context could be made");
    try {
      make_current();
      load("osmesa", osmesa_.get_proc_address);
    } catch (...) {
      release();
      throw;
    }
  }
  ~OsmesaBackend() override { release(); }
  OsmesaBackend(const OsmesaBackend&) = delete;
  OsmesaBackend& operator=(const OsmesaBackend&) = delete;

  void make_current() override {
    if (osmesa_.make_current(context_, buffer_.data(), GL_UNSIGNED_BYTE, kSide, kSide) == GL_FALSE)
      throw std::runtime_error("OSMesaMakeCurrent failed");
  }

 private:
  void release() {
    osmesa_.make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
    osmesa_.destroy(context_);
  }

  static constexpr int kSide = 16;  // px; never drawn to, but OSMesa wants a buffer
  Osmesa osmesa_;
  OsmesaContext context_ = nullptr;
  std::array<std::uint8_t, std::size_t{4} * kSide * kSide> buffer_{};
};

}  // namespace

std::unique_ptr<Context> make_osmesa_context() {
  return std::make_unique<OsmesaBackend>();
}

}  // namespace lather::render

#ifdef __SANITIZE_ADDRESS__
// OSMesa loses about a hundred bytes a context, even when that is unbound and destroyed; our own leaks still
// count.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOSMesa.so\n";
}
#endif
