#include "tests/unit/render/sample_frames.h"

#include <algorithm>
#include <cmath>

namespace lather::render {
namespace {

/// Distance to the axis of a rope that winds up a cone, less the rope's radius; negative inside.
double dollop_distance(const Vec3& p) {
  double best = 1e9;
  for (int i = 0; i <= 120; ++i) {
    const double s = i / 120.0;
    const double angle = 2 * EIGEN_PI * 3.6 * s;
    const double ring = 0.19 * (1 - 0.93 * s), rope = 0.075 * (1 - 0.6 * s);
    const Vec3 center(ring * std::cos(angle), 0.065 + 0.24 * s, ring * std::sin(angle));
    best = std::min(best, (p - center).norm() - rope);
  }
  return best;
}

void add_side(TriangleMesh& mesh, const Vec3& normal, const Vec3& u, const Vec3& v) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto as_float = [](const Vec3& a) {
    const Eigen::Vector3f f = a.cast<float>();
    return std::array<float, 3>{f.x(), f.y(), f.z()};
  };
  for (int i = 0; i < 4; ++i) {
    mesh.positions.push_back(as_float(normal + (i & 1 ? 1 : -1) * u + (i & 2 ? 1 : -1) * v));
    mesh.normals.push_back(as_float(normal.normalized()));
  }
  mesh.triangles.push_back({first, first + 1, first + 3});
  mesh.triangles.push_back({first, first + 3, first + 2});
}

}  // namespace

Frame empty_frame() {
  Frame frame;
  frame.domain = {Vec3(-0.5, 0, -0.5), Vec3(0.5, 0.6, 0.5)};
  frame.material_names = {"foam"};
  frame.point_radius = 0.01;
  return frame;
}

void add_point(Frame& frame, const Vec3& position, const Vec3& velocity) {
  FramePoints& points = frame.points;
  const Eigen::Vector3f p = position.cast<float>(), v = velocity.cast<float>();
  points.id.push_back(static_cast<std::uint32_t>(points.size()));
  points.position.push_back({p.x(), p.y(), p.z()});
  points.velocity.push_back({v.x(), v.y(), v.z()});
  points.material.push_back(0);
}

Frame dollop(int count) {
  Frame frame = empty_frame();
  const double volume = 0.0232;  // m^3, of the shape
  const double distance = std::cbrt(volume / count);
  frame.point_radius = distance / 2;
  std::uint32_t random = 12345;
  const auto jitter = [&] {
    random = random * 1664525U + 1013904223U;
    return (random / 4294967296.0 - 0.5) * 0.7 * distance;
  };
  for (double y = distance / 2; y < 0.36; y += distance)
    for (double x = -0.28; x < 0.28; x += distance)
      for (double z = -0.28; z < 0.28; z += distance) {
        const Vec3 p(x + jitter(), std::max(y + jitter(), 0.0), z + jitter());
        if (dollop_distance(p) < 0) add_point(frame, p, Vec3(p.y(), p.x(), 0));
      }
  return frame;
}

std::shared_ptr<const TriangleMesh> box_mesh(const Vec3& half_sides) {
  auto mesh = std::make_shared<TriangleMesh>();
  for (int axis = 0; axis < 3; ++axis)
    for (const int sign : {-1, 1}) {
      Vec3 normal = Vec3::Zero(), u = Vec3::Zero(), v = Vec3::Zero();
      normal[axis] = sign * half_sides[axis];
      u[(axis + 1) % 3] = half_sides[(axis + 1) % 3];
      v[(axis + 2) % 3] = sign * half_sides[(axis + 2) % 3];
      add_side(*mesh, normal, u, v);
    }
  return mesh;
}

Frame dollop_under_block(int count) {
  Frame frame = dollop(count);
  FrameObstacle block;
  block.name = "block";
  block.mesh = box_mesh({0.11, 0.03, 0.08});
  block.pose.rotation = Eigen::AngleAxisd(0.35, Vec3(0.2, 0.6, 0.4).normalized());
  block.pose.translation = {0.03, 0.36, 0.0};
  frame.obstacles.push_back(block);
  return frame;
}

Frame flat_frame(float x, float y, double point_radius) {
  Frame frame;
  frame.dimension = 2;
  frame.domain = {Vec3(0, 0, 0), Vec3(2, 1, 0)};
  frame.material_names = {"foam"};
  frame.point_radius = point_radius;
  add_point(frame, Vec3(x, y, 0));
  return frame;
}

}  // namespace lather::render
