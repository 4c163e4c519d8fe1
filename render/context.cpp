#include "render/context.h"

#include <cstdlib>
#include <stdexcept>

namespace lather::render {
namespace {

/// "3.3 (Core Profile) Mesa 22.3.6" -> "22.3.6"; another vendor's version stays as it is.
std::string short_version(const std::string& version) {
  const std::string mesa = "Mesa ";
  const auto at = version.find(mesa);
  return at == std::string::npos ? version : version.substr(at + mesa.size());
}

std::string gl_string(const Gl& gl, GLenum name) {
  const GLubyte* text = gl.GetString(name);
  return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

}  // namespace

void Context::load(const std::string& kind, const std::function<GlProc(const char*)>& find) {
  gl_ = load_gl(find);
  description_ =
      kind + " " + short_version(gl_string(gl_, GL_VERSION)) + " (" + gl_string(gl_, GL_RENDERER) + ")";
}

std::unique_ptr<Context> make_context(Backend backend, int threads) {
  // Mesa's shader cache lies in $HOME, shared by all jobs of the machine; ours compiles in milliseconds
  // without it.
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
  if (threads > 0) setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
  std::string failures;
  const auto attempt = [&failures](const char* name, auto make) -> std::unique_ptr<Context> {
    try {
      return make();
    } catch (const std::exception& e) {
      failures += std::string(failures.empty() ? "" : "; ") + name + ": " + e.what();
      return nullptr;
    }
  };
  std::unique_ptr<Context> context;
  if (backend != Backend::kEgl) context = attempt("osmesa", make_osmesa_context);
  if (!context && backend != Backend::kOsmesa) context = attempt("egl", make_egl_context);
  if (!context)
    throw std::runtime_error("No render backend works (" + failures +
                             "). On Debian, install libosmesa6, or libegl1 with libgl1-mesa-dri.");
  return context;
}

}  // namespace lather::render
