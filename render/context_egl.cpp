#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "render/context.h"

namespace lather::render {
namespace {

constexpr const char* kLibrary = "libEGL.so.1";

/// Loaded at run time, so that the program starts where EGL is missing. Stays loaded, see context_osmesa.cpp.
struct Egl {
  decltype(&eglGetProcAddress) get_proc_address = nullptr;
  decltype(&eglInitialize) initialize = nullptr;
  decltype(&eglBindAPI) bind_api = nullptr;
  decltype(&eglChooseConfig) choose_config = nullptr;
  decltype(&eglCreateContext) create_context = nullptr;
  decltype(&eglDestroyContext) destroy_context = nullptr;
  decltype(&eglMakeCurrent) make_current = nullptr;
  decltype(&eglGetError) get_error = nullptr;
  PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display = nullptr;
  PFNEGLQUERYDEVICESEXTPROC query_devices = nullptr;  // may be missing
};

template <class Function>
void find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (function == nullptr) throw std::runtime_error(std::string(kLibrary) + " has no " + name);
}

Egl open_egl() {
  void* library = dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error(dlerror());
  Egl egl;
  find(library, "eglGetProcAddress", egl.get_proc_address);
  find(library, "eglInitialize", egl.initialize);
  find(library, "eglBindAPI", egl.bind_api);
  find(library, "eglChooseConfig", egl.choose_config);
  find(library, "eglCreateContext", egl.create_context);
  find(library, "eglDestroyContext", egl.destroy_context);
  find(library, "eglMakeCurrent", egl.make_current);
  find(library, "eglGetError", egl.get_error);
  egl.get_platform_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(egl.get_proc_address("eglGetPlatformDisplayEXT"));
  egl.query_devices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.get_proc_address("eglQueryDevicesEXT"));
  if (egl.get_platform_display == nullptr) throw std::runtime_error("EGL_EXT_platform_base is missing");
  return egl;
}

std::string error_text(const Egl& egl) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "EGL error 0x%04x", static_cast<unsigned>(egl.get_error()));
  return text.data();
}

/// Candidates in order: no surface at all (Mesa), then every device (other vendors). The default display is
/// no candidate: it wants a screen.
std::vector<EGLDisplay> displays(const Egl& egl) {
  std::vector<EGLDisplay> all;
  const auto add = [&](EGLenum platform, void* native) {
    EGLDisplay display = egl.get_platform_display(platform, native, nullptr);
    if (display != EGL_NO_DISPLAY) all.push_back(display);
  };
  add(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY);
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (egl.query_devices != nullptr &&
      egl.query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_TRUE)
    for (EGLint i = 0; i < count; ++i) add(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)]);
  return all;
}

EGLContext create_context(const Egl& egl, EGLDisplay display) {
  if (egl.initialize(display, nullptr, nullptr) != EGL_TRUE) return EGL_NO_CONTEXT;
  if (egl.bind_api(EGL_OPENGL_API) != EGL_TRUE) return EGL_NO_CONTEXT;
  const std::array<EGLint, 5> wanted = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (egl.choose_config(display, wanted.data(), &config, 1, &count) != EGL_TRUE || count < 1)
    return EGL_NO_CONTEXT;
  const std::array<EGLint, 7> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                            3,
                                            EGL_CONTEXT_MINOR_VERSION,
                                            3,
                                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                            EGL_NONE};
  return egl.create_context(display, config, EGL_NO_CONTEXT, attributes.data());
}

class EglBackend final : public Context {
 public:
  EglBackend() : egl_(open_egl()) {
    for (EGLDisplay display : displays(egl_)) {
      display_ = display;
      context_ = create_context(egl_, display);
      if (context_ != EGL_NO_CONTEXT) break;
    }
    if (context_ == EGL_NO_CONTEXT)
      throw std::runtime_error("no surfaceless or device display gives an OpenGL 3.3 core context (" +
                               error_text(egl_) + ")");
    try {
      make_current();
      load("egl", [this](const char* name) { return egl_.get_proc_address(name); });
    } catch (...) {
      release();
      throw;
    }
  }
  ~EglBackend() override { release(); }
  EglBackend(const EglBackend&) = delete;
  EglBackend& operator=(const EglBackend&) = delete;

  void make_current() override {
    // Unbound first: EGL takes binding the same context again as nothing to do, though OSMesa may have
    // replaced it.
    unbind();
    if (egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE)
      throw std::runtime_error("eglMakeCurrent failed (" + error_text(egl_) + ")");
  }

 private:
  void unbind() { egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

  /// The display is not terminated: every context of the process on the same platform shares it.
  void release() {
    unbind();
    egl_.destroy_context(display_, context_);
  }

  Egl egl_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Context> make_egl_context() {
  return std::make_unique<EglBackend>();
}

}  // namespace lather::render
