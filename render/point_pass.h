#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/gl_objects.h"
#include "render/point_normals.h"
#include "render/rgba.h"
#include "render/shot.h"

namespace lather::render {

/// Points as sphere impostors with correct depth.
class PointPass {
 public:
  explicit PointPass(const Gl& gl);
  /// Colours and normals are one a point.
  void upload(const std::vector<std::array<float, 3>>& positions, const std::vector<Rgba>& colors,
              const std::vector<PackedNormal>& normals);
  void draw(const Shot& shot, int width, int height) const;
  void draw_shadow(const Shot& shot, int side) const;

 private:
  /// As point sprites, or as two triangles each when a sprite may be larger than the driver draws.
  void draw_points(bool quads) const;

  const Gl& gl_;
  Program points_, shadow_;
  VertexArray vertices_;
  Buffer positions_, colors_, normals_;
  GLsizei count_ = 0;
  Box3 bounds_;
  double largest_sprite_ = 1;  // px
};

}  // namespace lather::render
