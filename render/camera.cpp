#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/render.h"

namespace lather::render {
namespace {

constexpr double kMargin = 0.06;  // of half the picture, left free on each side by automatic cameras
constexpr double kNearOverFar = 0.01;
const Vec3 kAutomaticDirection(0.45, 0.36, 1.0);  // from the target to the eye

double radians(double degrees) {
  return degrees * EIGEN_PI / 180;
}

/// Rows: right, up, backward.
Mat3 axes_looking_from(const Vec3& backward_direction) {
  const Vec3 backward = backward_direction.normalized();
  const Vec3 reference = std::abs(backward.y()) > 0.999 ? Vec3(0, 0, -1) : Vec3(0, 1, 0);
  const Vec3 right = reference.cross(backward).normalized();
  Mat3 axes;
  axes << right.transpose(), backward.cross(right).transpose(), backward.transpose();
  return axes;
}

Mat4 rigid(const Mat3& rotation, const Vec3& eye) {
  Mat4 m = Mat4::Identity();
  m.topLeftCorner<3, 3>() = rotation;
  m.topRightCorner<3, 1>() = -rotation * eye;
  return m;
}

Mat4 perspective(double tan_x, double tan_y, double near, double far) {
  Mat4 m = Mat4::Zero();
  m(0, 0) = 1 / tan_x;
  m(1, 1) = 1 / tan_y;
  m(2, 2) = -(far + near) / (far - near);
  m(2, 3) = -2 * far * near / (far - near);
  m(3, 2) = -1;
  return m;
}

/// What an automatic camera frames: this frame's points and obstacles inside the domain, down to its floor,
/// and a part of the way from there to the domain's sides, because foam spreads and obstacles move.
Box3 automatic_bounds(const Look& look, const Frame& first) {
  const double room = 0.35;  // of the way to the domain's sides
  Box3 content = content_bounds(first, first.point_radius * look.point_scale);
  const Box3& domain = first.domain;
  content.min = content.min.cwiseMax(domain.min).cwiseMin(domain.max);
  content.max = content.max.cwiseMin(domain.max).cwiseMax(domain.min);
  if ((content.max.array() < content.min.array()).any()) return domain;
  content.min.y() = std::min(first.floor_height, content.min.y());
  for (const int axis : {0, 2}) {
    content.min[axis] += room * (domain.min[axis] - content.min[axis]);
    content.max[axis] += room * (domain.max[axis] - content.max[axis]);
  }
  return content;
}

}  // namespace

Vec3 View::to_camera(const Vec3& world) const {
  return (camera_from_world * world.homogeneous()).hnormalized();
}

Vec3 View::project(const Vec3& world) const {
  return (clip_from_camera * camera_from_world * world.homogeneous()).hnormalized();
}

Vec3 View::rotate(const Vec3& direction) const {
  return camera_from_world.topLeftCorner<3, 3>() * direction;
}

View perspective_view(const Look::Camera& camera, double aspect, const Box3& bounds) {
  View view;
  const Vec3 backward = camera.eye - camera.target;
  view.camera_from_world =
      rigid(axes_looking_from(backward.norm() > 0 ? backward : kAutomaticDirection), camera.eye);
  double far = 0;
  for (const Vec3& corner : corners(bounds)) far = std::max(far, -view.to_camera(corner).z());
  if (!(far > 0)) far = 1;  // all of it lies behind the camera
  far *= 1.02;
  const double tan_y = std::tan(radians(camera.field_of_view_deg) / 2);
  view.clip_from_camera = perspective(tan_y * aspect, tan_y, far * kNearOverFar, far);
  return view;
}

View flat_view(const Box3& domain, double aspect) {
  View view;
  view.orthographic = true;
  const Vec3 extent = domain.extent();
  const double half_y = 0.5 * (1 + kMargin) * std::max(extent.y(), extent.x() / aspect);
  // Points and obstacle slices lie within the domain's depth; in front of and behind it there is room to
  // spare.
  const double depth = std::max({extent.z(), extent.x(), extent.y()});
  const Vec3 center = domain.center();
  view.camera_from_world = rigid(Mat3::Identity(), center + Vec3(0, 0, 2 * depth));
  Mat4& m = view.clip_from_camera;
  m(0, 0) = 1 / (half_y * aspect);
  m(1, 1) = 1 / half_y;
  m(2, 2) = -2 / (4 * depth);
  m(2, 3) = -1;  // z in [-4 depth, 0]
  return view;
}

/// With the slopes s of the frustum's sides, a point (x, z) in the rotated frame is right of the left side
/// and left of the right one when  x - s_x (-z)… that is  ±x + s z <= ±e_x + s e_z. Each side is tight for
/// the largest left-hand side over all points; adding both gives e_z, subtracting them e_x. The axis that
/// needs more room decides e_z.
Look::Camera framing_camera(const std::vector<Vec3>& points, const Vec3& direction, double field_of_view_deg,
                            double aspect) {
  const Mat3 axes = axes_looking_from(direction);
  const double tan_y = std::tan(radians(field_of_view_deg) / 2) / (1 + kMargin);
  const Eigen::Vector2d slope(tan_y * aspect, tan_y);
  Eigen::Vector2d high = Eigen::Vector2d::Constant(-std::numeric_limits<double>::infinity());
  Eigen::Vector2d low = high;
  double mean_z = 0;
  for (const Vec3& point : points) {
    const Vec3 p = axes * point;
    high = high.cwiseMax(p.head<2>() + slope * p.z());
    low = low.cwiseMax(-p.head<2>() + slope * p.z());
    mean_z += p.z() / static_cast<double>(points.size());
  }
  Vec3 eye;
  eye.head<2>() = 0.5 * (high - low);
  eye.z() = (0.5 * (high + low)).cwiseQuotient(slope).maxCoeff();
  Look::Camera camera;
  camera.automatic = false;
  camera.field_of_view_deg = field_of_view_deg;
  camera.eye = axes.transpose() * eye;
  camera.target = axes.transpose() * Vec3(eye.x(), eye.y(), mean_z);
  return camera;
}

Look::Camera automatic_camera(const Look& look, const Output& output, const Frame& first) {
  const double aspect = static_cast<double>(output.width) / output.height;
  return framing_camera(corners(automatic_bounds(look, first)), kAutomaticDirection,
                        look.camera.field_of_view_deg, aspect);
}

std::vector<Vec3> corners(const Box3& box) {
  std::vector<Vec3> all;
  for (int i = 0; i < 8; ++i)
    all.emplace_back((i & 1 ? box.max : box.min).x(), (i & 2 ? box.max : box.min).y(),
                     (i & 4 ? box.max : box.min).z());
  return all;
}

Box3 empty_box() {
  const double infinity = std::numeric_limits<double>::infinity();
  return {Vec3::Constant(infinity), Vec3::Constant(-infinity)};
}

Box3 content_bounds(const Frame& frame, double point_radius) {
  Box3 box = empty_box();
  for (const auto& p : frame.points.position) box.include(Vec3(p[0], p[1], p[2]));
  box.min.array() -= point_radius;
  box.max.array() += point_radius;
  for (const FrameObstacle& obstacle : frame.obstacles) {
    if (!obstacle.mesh) continue;
    for (const auto& p : obstacle.mesh->positions)
      box.include(obstacle.pose.rotation * Vec3(p[0], p[1], p[2]) + obstacle.pose.translation);
  }
  return box;
}

}  // namespace lather::render
