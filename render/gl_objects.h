#pragma once

#include <string>
#include <vector>

#include "render/camera.h"
#include "render/gl.h"

/// GL objects that free themselves. Their context must be current when they are made, used and destroyed.
namespace lather::render {

class Program {
 public:
  /// Throws std::runtime_error with the compiler's log, which names `label`.
  Program(const Gl& gl, const char* label, const std::string& vertex, const std::string& fragment);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const { gl_.UseProgram(id_); }
  void set(const char* name, int value) const { gl_.Uniform1i(at(name), value); }
  void set(const char* name, double value) const { gl_.Uniform1f(at(name), static_cast<float>(value)); }
  void set(const char* name, double x, double y) const;
  void set(const char* name, const Vec3& v) const;
  void set(const char* name, const Eigen::Vector4d& v) const;
  void set(const char* name, const Mat4& m) const;
  /// Binds the texture to the unit and the sampler to it.
  void set_texture(const char* name, int unit, GLuint texture) const;

 private:
  [[nodiscard]] GLint at(const char* name) const { return gl_.GetUniformLocation(id_, name); }
  const Gl& gl_;
  GLuint id_ = 0;
};

struct TextureFormat {
  GLenum internal_format;
  GLenum format;
  GLenum type;
  bool shadow = false;  ///< compared and filtered when sampled
};

class Texture {
 public:
  Texture(const Gl& gl, int width, int height, const TextureFormat& format);
  ~Texture() { gl_.DeleteTextures(1, &id_); }
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;
  [[nodiscard]] GLuint id() const { return id_; }

 private:
  const Gl& gl_;
  GLuint id_ = 0;
};

class Framebuffer {
 public:
  /// `depth` may be null. Throws std::runtime_error when the driver cannot draw to this combination.
  Framebuffer(const Gl& gl, int width, int height, const std::vector<const Texture*>& colors,
              const Texture* depth);
  ~Framebuffer() { gl_.DeleteFramebuffers(1, &id_); }
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;
  /// Draws go here, over the whole of it.
  void bind() const;
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  const Gl& gl_;
  GLuint id_ = 0;
  int width_, height_;
};

class Buffer {
 public:
  explicit Buffer(const Gl& gl) : gl_(gl) { gl_.GenBuffers(1, &id_); }
  ~Buffer() { gl_.DeleteBuffers(1, &id_); }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  template <class T>
  void upload(GLenum target, const std::vector<T>& data) const {
    gl_.BindBuffer(target, id_);
    gl_.BufferData(target, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), GL_STREAM_DRAW);
  }

 private:
  const Gl& gl_;
  GLuint id_ = 0;
};

class VertexArray {
 public:
  explicit VertexArray(const Gl& gl) : gl_(gl) { gl_.GenVertexArrays(1, &id_); }
  ~VertexArray() { gl_.DeleteVertexArrays(1, &id_); }
  VertexArray(const VertexArray&) = delete;
  VertexArray& operator=(const VertexArray&) = delete;
  void bind() const { gl_.BindVertexArray(id_); }

 private:
  const Gl& gl_;
  GLuint id_ = 0;
};

}  // namespace lather::render
