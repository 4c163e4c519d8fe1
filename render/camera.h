#pragma once

#include <vector>

#include "sim/frame.h"
#include "sim/scene/look.h"

/// Where a picture is seen from: pure mathematics, no GL. Camera space: x right, y up, looking along -z.
namespace lather::render {

using Mat4 = Eigen::Matrix4d;

struct View {
  Mat4 camera_from_world = Mat4::Identity();
  Mat4 clip_from_camera = Mat4::Identity();  ///< OpenGL's clip space; symmetric about the axis
  bool orthographic = false;

  [[nodiscard]] Vec3 to_camera(const Vec3& world) const;
  /// Normalised device coordinates, each in [-1, 1] when in view; y up.
  [[nodiscard]] Vec3 project(const Vec3& world) const;
  /// The direction in camera space of a direction in the world.
  [[nodiscard]] Vec3 rotate(const Vec3& direction) const;
};

/// A perspective view. `aspect` is width over height; near and far planes enclose `bounds`.
[[nodiscard]] View perspective_view(const Look::Camera& camera, double aspect, const Box3& bounds);

/// For 2D scenes: parallel to z, x right, y up, the whole of `domain` in view with a margin.
[[nodiscard]] View flat_view(const Box3& domain, double aspect);

/// Seen along `-direction` (from the target to the eye, y up) with the vertical `field_of_view_deg`, the
/// nearest camera that has all `points` in view with a margin of 6 % of the picture's half sides.
[[nodiscard]] Look::Camera framing_camera(const std::vector<Vec3>& points, const Vec3& direction,
                                          double field_of_view_deg, double aspect);

[[nodiscard]] std::vector<Vec3> corners(const Box3& box);

/// A box that contains nothing; include() makes it one.
[[nodiscard]] Box3 empty_box();

/// Points, obstacles and the bodies of all of them (points have a radius).
[[nodiscard]] Box3 content_bounds(const Frame& frame, double point_radius);

}  // namespace lather::render
