#pragma once

#include <memory>
#include <string>

#include "render/gl.h"
#include "render/render.h"

namespace lather::render {

/// An off-screen GL 3.3 core context of the thread that made it. It has no surface of its own worth drawing
/// to: the passes draw into framebuffer objects.
class Context {
 public:
  virtual ~Context() = default;
  /// Binds it to this thread. Call before any GL call when another context may have been current.
  virtual void make_current() = 0;

  [[nodiscard]] const Gl& gl() const { return gl_; }

  /// "osmesa 22.3.6 (llvmpipe (LLVM 15.0.6, 256 bits))"
  [[nodiscard]] const std::string& description() const { return description_; }

 protected:
  /// Fills gl() and description(); the context must be current.
  void load(const std::string& kind, const std::function<GlProc(const char*)>& find);

 private:
  Gl gl_;
  std::string description_;
};

/// Both throw std::runtime_error with the step that failed.
[[nodiscard]] std::unique_ptr<Context> make_osmesa_context();
[[nodiscard]] std::unique_ptr<Context> make_egl_context();

/// Tries the backends that `backend` names in turn; throws std::runtime_error with all failures. `threads` as
/// in Renderer::create.
[[nodiscard]] std::unique_ptr<Context> make_context(Backend backend, int threads);

}  // namespace lather::render
