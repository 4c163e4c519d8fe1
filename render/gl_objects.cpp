#include "render/gl_objects.h"

#include <stdexcept>

namespace lather::render {
namespace {

GLuint compile(const Gl& gl, const char* label, GLenum stage, const std::string& source) {
  const GLuint shader = gl.CreateShader(stage);
  const char* text = source.c_str();
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  GLint done = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (done == GL_TRUE) return shader;
  std::string log(4096, '\0');
  GLsizei length = 0;
  gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  gl.DeleteShader(shader);
  log.resize(static_cast<std::size_t>(length));
  throw std::runtime_error(std::string("The driver refuses the shader of the pass '") + label + "': " + log);
}

}  // namespace

Program::Program(const Gl& gl, const char* label, const std::string& vertex, const std::string& fragment)
    : gl_(gl) {
  const GLuint v = compile(gl, label, GL_VERTEX_SHADER, vertex);
  const GLuint f = compile(gl, label, GL_FRAGMENT_SHADER, fragment);
  id_ = gl.CreateProgram();
  gl.AttachShader(id_, v);
  gl.AttachShader(id_, f);
  gl.LinkProgram(id_);
  gl.DeleteShader(v);
  gl.DeleteShader(f);
  GLint done = 0;
  gl.GetProgramiv(id_, GL_LINK_STATUS, &done);
  if (done == GL_TRUE) return;
  std::string log(4096, '\0');
  GLsizei length = 0;
  gl.GetProgramInfoLog(id_, static_cast<GLsizei>(log.size()), &length, log.data());
  gl.DeleteProgram(id_);
  log.resize(static_cast<std::size_t>(length));
  throw std::runtime_error(std::string("The driver cannot link the pass '") + label + "': " + log);
}

Program::~Program() {
  gl_.DeleteProgram(id_);
}

void Program::set(const char* name, double x, double y) const {
  gl_.Uniform2f(at(name), static_cast<float>(x), static_cast<float>(y));
}

void Program::set(const char* name, const Vec3& v) const {
  const Eigen::Vector3f f = v.cast<float>();
  gl_.Uniform3f(at(name), f.x(), f.y(), f.z());
}

void Program::set(const char* name, const Eigen::Vector4d& v) const {
  const Eigen::Vector4f f = v.cast<float>();
  gl_.Uniform4f(at(name), f.x(), f.y(), f.z(), f.w());
}

void Program::set(const char* name, const Mat4& m) const {
  const Eigen::Matrix4f f = m.cast<float>();
  gl_.UniformMatrix4fv(at(name), 1, GL_FALSE, f.data());
}

void Program::set_texture(const char* name, int unit, GLuint texture) const {
  gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  gl_.BindTexture(GL_TEXTURE_2D, texture);
  set(name, unit);
}

Texture::Texture(const Gl& gl, int width, int height, const TextureFormat& format) : gl_(gl) {
  gl.GenTextures(1, &id_);
  gl.BindTexture(GL_TEXTURE_2D, id_);
  gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format.internal_format), width, height, 0, format.format,
                format.type, nullptr);
  const GLint filter = format.shadow ? GL_LINEAR : GL_NEAREST;
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  if (format.shadow) {
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  }
}

Framebuffer::Framebuffer(const Gl& gl, int width, int height, const std::vector<const Texture*>& colors,
                         const Texture* depth)
    : gl_(gl), width_(width), height_(height) {
  gl.GenFramebuffers(1, &id_);
  gl.BindFramebuffer(GL_FRAMEBUFFER, id_);
  std::vector<GLenum> attachments;
  for (const Texture* color : colors) {
    attachments.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachments.size()));
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, attachments.back(), GL_TEXTURE_2D, color->id(), 0);
  }
  if (depth != nullptr)
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth->id(), 0);
  if (attachments.empty()) attachments.push_back(GL_NONE);
  gl.DrawBuffers(static_cast<GLsizei>(attachments.size()), attachments.data());
  gl.ReadBuffer(attachments.front());
  const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status == GL_FRAMEBUFFER_COMPLETE) return;
  gl.DeleteFramebuffers(1, &id_);
  throw std::runtime_error("The driver cannot draw to a framebuffer of " + std::to_string(width) + " x " +
                           std::to_string(height) + " (status " + std::to_string(status) + ")");
}

void Framebuffer::bind() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, id_);
  gl_.Viewport(0, 0, width_, height_);
}

}  // namespace lather::render
