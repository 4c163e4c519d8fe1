#include "render/gl.h"

#include <stdexcept>
#include <string>

namespace lather::render {

Gl load_gl(const std::function<GlProc(const char*)>& find) {
  Gl gl;
#define LATHER_GL_LOAD(type, name)                    \
  gl.name = reinterpret_cast<type>(find("gl" #name)); \
  if (gl.name == nullptr) throw std::runtime_error("the context lacks the function gl" #name);
  LATHER_GL_FUNCTIONS(LATHER_GL_LOAD)
#undef LATHER_GL_LOAD
  return gl;
}

}  // namespace lather::render
