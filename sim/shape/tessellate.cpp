#include <algorithm>
#include <cmath>

#include "sim/shape/mesh_builder.h"
#include "sim/shape/mesh_solid.h"
#include "sim/shape/shape.h"
#include "sim/shape/unbounded.h"

namespace lather {
namespace {

using tessellation::lathe;
using tessellation::ProfileStrip;
using Vec2 = Eigen::Vector2d;

/// A circular arc from angle `from` to `to` (radians from the +r axis), both ends included.
void append_arc(ProfileStrip& strip, const Vec2& center, double radius, double from, double to,
                double detail) {
  const double length = std::abs(to - from) * radius;
  const int steps = std::clamp(static_cast<int>(std::ceil(length / detail)), 6, 256);
  for (int i = 0; i <= steps; ++i) {
    const double angle = from + (to - from) * i / steps;
    const Vec2 n(std::cos(angle), std::sin(angle));
    Vec2 p = center + radius * n;
    if (p.x() < 1e-12 * radius) p.x() = 0;  // the pole, exactly
    strip.push_back({p, n});
  }
}

/// A straight stretch; the solid lies on its left, so the normal points to the right.
ProfileStrip straight(const Vec2& from, const Vec2& to) {
  const Vec2 along = (to - from).normalized();
  const Vec2 n(along.y(), -along.x());
  return {{from, n}, {to, n}};
}

/// Both caps and the side of a frustum.
std::vector<ProfileStrip> frustum_profile(double radius, double top_radius, double height) {
  const double half = 0.5 * height;
  return {straight({0, -half}, {radius, -half}), straight({radius, -half}, {top_radius, half}),
          straight({top_radius, half}, {0, half})};
}

double signed_area(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2& a = polygon[i];
    const Vec2& b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

TriangleMesh placed(TriangleMesh mesh, const PlacedShape& s) {
  const auto turned = [&](const std::array<float, 3>& v, double scale, const Vec3& shift) {
    const Vec3 moved = s.rotation * (scale * Vec3(v[0], v[1], v[2])) + shift;
    return std::array<float, 3>{static_cast<float>(moved.x()), static_cast<float>(moved.y()),
                                static_cast<float>(moved.z())};
  };
  for (auto& p : mesh.positions) p = turned(p, s.scale, s.translate);
  for (auto& n : mesh.normals) n = turned(n, 1, Vec3::Zero());
  return mesh;
}

struct Tessellate {
  const Shape& shape;
  const Box3& world;
  double detail;

  TriangleMesh operator()(const SphereShape& s) const {
    ProfileStrip strip;
    append_arc(strip, {0, 0}, s.radius, -M_PI_2, M_PI_2, detail);
    return lathe({strip}, detail);
  }
  TriangleMesh operator()(const BoxShape& s) const { return tessellation::rounded_box(s, detail); }
  TriangleMesh operator()(const CylinderShape& s) const {
    if (s.rounding <= 0) return lathe(frustum_profile(s.radius, s.radius, s.height), detail);
    const Vec2 corner(s.radius - s.rounding, 0.5 * s.height - s.rounding);
    ProfileStrip strip = {{{0, -0.5 * s.height}, {0, -1}}};
    append_arc(strip, {corner.x(), -corner.y()}, s.rounding, -M_PI_2, 0, detail);
    append_arc(strip, corner, s.rounding, 0, M_PI_2, detail);
    strip.push_back({{0, 0.5 * s.height}, {0, 1}});
    return lathe({strip}, detail);
  }
  TriangleMesh operator()(const CapsuleShape& s) const {
    ProfileStrip strip;
    append_arc(strip, {0, -0.5 * s.height}, s.radius, -M_PI_2, 0, detail);
    append_arc(strip, {0, 0.5 * s.height}, s.radius, 0, M_PI_2, detail);
    return lathe({strip}, detail);
  }
  TriangleMesh operator()(const ConeShape& s) const {
    return lathe(frustum_profile(s.radius, s.top_radius, s.height), detail);
  }
  TriangleMesh operator()(const TorusShape& s) const {
    ProfileStrip strip;
    append_arc(strip, {s.ring_radius, 0}, s.tube_radius, -M_PI, M_PI, detail);
    strip.back() = strip.front();  // closed bit for bit
    return lathe({strip}, detail);
  }
  // A sphere stretched along the axes; normals stretch the other way.
  TriangleMesh operator()(const EllipsoidShape& s) const {
    TriangleMesh mesh = (*this)(SphereShape{s.radii.maxCoeff()});
    const Vec3 stretch = s.radii / s.radii.maxCoeff();
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      Vec3 n;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<Eigen::Index>(axis);
        mesh.positions[i][axis] = static_cast<float>(mesh.positions[i][axis] * stretch[a]);
        n[a] = mesh.normals[i][axis] / stretch[a];
      }
      n.normalize();
      mesh.normals[i] = {static_cast<float>(n.x()), static_cast<float>(n.y()), static_cast<float>(n.z())};
    }
    return mesh;
  }
  TriangleMesh operator()(const PlaneShape& s) const {
    return tessellation::plane_polygon(Vec3::Zero(), s.normal, world);
  }
  TriangleMesh operator()(const RevolutionShape& s) const {
    std::vector<Vec2> polygon = s.profile;
    if (signed_area(polygon) < 0) std::reverse(polygon.begin(), polygon.end());
    std::vector<ProfileStrip> strips;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2& a = polygon[i];
      const Vec2& b = polygon[(i + 1) % polygon.size()];
      if ((a.x() > 0 || b.x() > 0) && a != b) strips.push_back(straight(a, b));
    }
    return lathe(strips, detail);
  }
  TriangleMesh operator()(const MeshShape& s) const { return s.solid->surface(); }
  TriangleMesh operator()(const PlacedShape& s) const {
    if (const auto* plane = std::get_if<PlaneShape>(&s.shape->kind)) {
      return tessellation::plane_polygon(s.translate, s.rotation * plane->normal, world);
    }
    if (is_unbounded(*s.shape)) return tessellation::from_distance(shape, world, detail);
    return placed(tessellate(*s.shape, world, detail / s.scale), s);
  }
  template <class Combination>
  TriangleMesh operator()(const Combination&) const {
    return tessellation::from_distance(shape, world, detail);
  }
};

/// A 2D scene's world is flat; give it the depth of a quarter of its longer side, so that planes can be seen.
Box3 with_depth(Box3 world) {
  const double depth = 0.25 * world.extent().maxCoeff();
  for (int i = 0; i < 3; ++i) {
    if (world.extent()[i] > 0) continue;
    world.min[i] -= 0.5 * depth;
    world.max[i] += 0.5 * depth;
  }
  return world;
}

}  // namespace

TriangleMesh tessellate(const Shape& shape, const Box3& world, double detail) {
  const Box3 solid = with_depth(world);
  return std::visit(Tessellate{shape, solid, detail}, shape.kind);
}

}  // namespace lather
