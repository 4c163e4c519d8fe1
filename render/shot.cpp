#include "render/shot.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace lather::render {
namespace {

bool finite(const std::array<float, 3>& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

/// A three-point rig that goes with the camera's heading, so that every camera sees lit surfaces: the key
/// over the left shoulder, a weak fill from the right, a rim from behind.
Lights lights_for(const View& view) {
  const Mat3 world_from_camera = view.camera_from_world.topLeftCorner<3, 3>().transpose();
  Vec3 toward = world_from_camera.col(2);
  toward.y() = 0;
  if (toward.norm() < 1e-6) toward = world_from_camera.col(1) * -1;  // straight down or up
  toward.y() = 0;
  toward.normalize();
  const Vec3 up(0, 1, 0);
  const Vec3 right = up.cross(toward);
  Lights lights;
  lights.key = (1.15 * up - 1.1 * right + 0.2 * toward).normalized();
  lights.fill = (0.25 * up + 0.9 * right + 0.5 * toward).normalized();
  lights.rim = (0.7 * up + 0.35 * right - toward).normalized();
  return lights;
}

/// The smallest power of 1.1 not below `length`: the shadow map keeps its scale from frame to frame while
/// foam spreads.
double rounded_up(double length) {
  return std::pow(1.1, std::ceil(std::log(length) / std::log(1.1)));
}

void place_shadow(Shot& shot) {
  const double radius = rounded_up(std::max(0.5 * shot.content.extent().norm(), 1e-9));
  shot.shadow_side = 2 * radius;
  const Vec3 backward = shot.lights.key;
  const Vec3 right = Vec3(0, 1, 0).cross(backward).normalized();
  Mat4 light_from_world = Mat4::Identity();
  light_from_world.topLeftCorner<3, 3>() << right.transpose(), backward.cross(right).transpose(),
      backward.transpose();
  light_from_world.topRightCorner<3, 1>() = -light_from_world.topLeftCorner<3, 3>() * shot.content.center();
  // Three times the depth: the floor that receives the shadow lies beyond the content.
  const Eigen::Vector4d scale(1 / radius, 1 / radius, -1 / (3 * radius), 1);
  shot.shadow_clip_from_world = scale.asDiagonal() * light_from_world;
}

}  // namespace

void check_finite(const Frame& frame) {
  const auto refuse = [&](const std::string& what) {
    throw std::runtime_error("Frame " + std::to_string(frame.index) + " is not drawn: " + what +
                             " is not finite.");
  };
  const FramePoints& points = frame.points;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!finite(points.position[i])) refuse("the position of point " + std::to_string(i));
  if (!std::isfinite(frame.point_radius)) refuse("the radius of the points");
  if (!frame.domain.min.allFinite() || !frame.domain.max.allFinite()) refuse("the domain");
  for (const FrameSkin& skin : frame.skins)
    for (const auto& p : skin.mesh->positions)
      if (!finite(p)) refuse("a vertex of a skin");
  for (const FrameObstacle& obstacle : frame.obstacles) {
    if (!obstacle.pose.translation.allFinite() || !obstacle.pose.rotation.coeffs().allFinite())
      refuse("the pose of obstacle '" + obstacle.name + "'");
    if (!obstacle.mesh) continue;
    for (const auto& p : obstacle.mesh->positions)
      if (!finite(p)) refuse("a vertex of obstacle '" + obstacle.name + "'");
  }
}

Shot make_shot(const Frame& frame, const Look& look, const Look::Camera& camera, double aspect) {
  Shot shot;
  shot.flat = frame.dimension == 2;
  shot.point_radius = frame.point_radius * look.point_scale;
  shot.content = content_bounds(frame, shot.point_radius);
  if (!(shot.content.max.array() >= shot.content.min.array()).all()) shot.content = frame.domain;

  const Vec3 middle = frame.domain.center();
  shot.floor_center = {middle.x(), frame.floor_height, middle.z()};
  shot.floor_fade = 2.2 * std::max({frame.domain.extent().x(), frame.domain.extent().z(), 1e-9});
  Box3 seen = shot.content;
  seen.include(frame.domain.min);
  seen.include(frame.domain.max);
  if (look.floor && !shot.flat) {
    const Vec3 reach(shot.floor_fade, 0, shot.floor_fade);
    seen.include(shot.floor_center - reach);
    seen.include(shot.floor_center + reach);
  }
  shot.view = shot.flat ? flat_view(frame.domain, aspect) : perspective_view(camera, aspect, seen);
  shot.ground = look.floor && (shot.flat || camera.eye.y() > shot.floor_center.y());
  shot.lights = lights_for(shot.view);
  // Flat scenes face the camera: lit from there, or all of them would lie in half light.
  if (shot.flat) shot.lights.key = Vec3(-0.35, 0.5, 1).normalized();
  shot.shadows = look.shadows && !shot.flat;
  place_shadow(shot);
  return shot;
}

}  // namespace lather::render
