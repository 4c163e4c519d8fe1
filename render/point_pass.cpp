#include "render/point_pass.h"

#include <algorithm>
#include <cmath>

#include "render/shaders.h"

namespace lather::render {
namespace {

void set_projection(const Program& program, const View& view) {
  const Mat4& m = view.clip_from_camera;
  program.set("projection", Eigen::Vector4d(m(0, 0), m(1, 1), m(2, 2), m(2, 3)));
  program.set("orthographic", view.orthographic ? 1 : 0);
}

/// An upper bound of the diameter in px of any point in view; see `half_size` in the shader.
double largest_sprite(const Shot& shot, const Box3& bounds, int height) {
  const double px_per_slope = 0.5 * height * shot.view.clip_from_camera(1, 1);
  if (shot.view.orthographic) return 2 * (shot.point_radius * px_per_slope + 1);
  const Mat4& m = shot.view.clip_from_camera;
  double nearest = 1e300;
  for (const Vec3& corner : corners(bounds)) nearest = std::min(nearest, -shot.view.to_camera(corner).z());
  nearest = std::max(nearest, m(2, 3) / (m(2, 2) - 1));  // no nearer than the near plane
  const double slope = std::hypot(1.0, 1 / m(0, 0), 1 / m(1, 1));
  const double gap = std::max(nearest - shot.point_radius, 0.1 * nearest);
  return 2 * (shot.point_radius * px_per_slope * slope / gap + 1);
}

}  // namespace

PointPass::PointPass(const Gl& gl)
    : gl_(gl),
      points_(gl, "points", shaders::points().vertex, shaders::points().fragment),
      shadow_(gl, "point shadow", shaders::point_shadow().vertex, shaders::point_shadow().fragment),
      vertices_(gl),
      positions_(gl),
      colors_(gl),
      normals_(gl) {
  std::array<GLfloat, 2> range{};
  gl.GetFloatv(GL_POINT_SIZE_RANGE, range.data());
  largest_sprite_ = range[1];
}

void PointPass::upload(const std::vector<std::array<float, 3>>& positions, const std::vector<Rgba>& colors,
                       const std::vector<PackedNormal>& normals) {
  count_ = static_cast<GLsizei>(positions.size());
  bounds_ = empty_box();
  for (const auto& p : positions) bounds_.include(Vec3(p[0], p[1], p[2]));
  vertices_.bind();
  positions_.upload(GL_ARRAY_BUFFER, positions);
  gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  gl_.EnableVertexAttribArray(0);
  colors_.upload(GL_ARRAY_BUFFER, colors);
  gl_.VertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, 0, nullptr);
  gl_.EnableVertexAttribArray(1);
  normals_.upload(GL_ARRAY_BUFFER, normals);
  gl_.VertexAttribPointer(2, 4, GL_BYTE, GL_TRUE, 0, nullptr);
  gl_.EnableVertexAttribArray(2);
}

void PointPass::draw_points(bool quads) const {
  vertices_.bind();
  for (const GLuint attribute : {0U, 1U, 2U}) gl_.VertexAttribDivisor(attribute, quads ? 1 : 0);
  if (quads)
    gl_.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count_);
  else
    gl_.DrawArrays(GL_POINTS, 0, count_);
}

void PointPass::draw(const Shot& shot, int width, int height) const {
  if (count_ == 0) return;
  const bool quads = largest_sprite(shot, bounds_, height) > largest_sprite_;
  points_.use();
  set_projection(points_, shot.view);
  points_.set("camera_from_world", shot.view.camera_from_world);
  points_.set("size", width, height);
  points_.set("radius", shot.point_radius);
  points_.set("quads", quads ? 1 : 0);
  draw_points(quads);
}

void PointPass::draw_shadow(const Shot& shot, int side) const {
  if (count_ == 0) return;
  // Half the side of the square that has the area of the sphere's disc.
  const double half_side = 0.5 * std::sqrt(EIGEN_PI) * shot.point_radius;
  const double half_size = std::max(half_side / shot.shadow_side * side, 0.75);
  const bool quads = 2 * half_size > largest_sprite_;
  shadow_.use();
  shadow_.set("clip_from_world", shot.shadow_clip_from_world);
  shadow_.set("half_size", half_size);
  shadow_.set("size", side, side);
  shadow_.set("quads", quads ? 1 : 0);
  draw_points(quads);
}

}  // namespace lather::render
