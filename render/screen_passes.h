#pragma once

#include "render/gl_objects.h"
#include "render/render.h"
#include "render/shot.h"

namespace lather::render {

/// All textures that passes draw to, and the passes over them that need no geometry. The geometry buffer has
/// `samples` squared samples a pixel; the rest is of the picture's size.
class ScreenPasses {
 public:
  /// Throws std::runtime_error when the driver cannot draw to these sizes.
  ScreenPasses(const Gl& gl, const Output& output);

  void begin_shadow() const;    ///< clears; meshes and points follow
  void begin_geometry() const;  ///< clears; meshes and points follow
  void occlude(const Shot& shot) const;
  void composite(const Shot& shot, const Look& look) const;
  /// Top row first.
  [[nodiscard]] Image read() const;

  [[nodiscard]] int drawn_width() const { return geometry_.width(); }
  [[nodiscard]] int drawn_height() const { return geometry_.height(); }
  [[nodiscard]] int shadow_side() const { return shadow_.width(); }

 private:
  void start(const Program& program, const Shot& shot) const;
  void cover(const Framebuffer& target) const;

  const Gl& gl_;
  int width_, height_, samples_;
  Texture shadow_map_, albedo_map_, normal_map_, depth_map_;
  Texture open_map_, blurred_open_map_, picture_map_;
  Framebuffer shadow_, geometry_, open_, blurred_open_, picture_;
  Program occlusion_, blur_occlusion_, composite_;
  VertexArray no_vertices_;
};

}  // namespace lather::render
