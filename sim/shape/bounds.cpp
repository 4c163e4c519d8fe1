#include <algorithm>
#include <cmath>

#include "sim/shape/mesh_solid.h"
#include "sim/shape/shape.h"
#include "sim/shape/unbounded.h"

namespace lather {
namespace {

Box3 around_origin(const Vec3& half) {
  return {-half, half};
}

Box3 intersection(const Box3& a, const Box3& b) {
  Box3 out{a.min.cwiseMax(b.min), a.max.cwiseMin(b.max)};
  out.max = out.max.cwiseMax(out.min);
  return out;
}

struct Bounds {
  const Box3& world;

  Box3 operator()(const SphereShape& s) const { return around_origin(Vec3::Constant(s.radius)); }
  Box3 operator()(const BoxShape& s) const { return around_origin(0.5 * s.size); }
  Box3 operator()(const CylinderShape& s) const {
    return around_origin({s.radius, 0.5 * s.height, s.radius});
  }
  Box3 operator()(const CapsuleShape& s) const {
    return around_origin({s.radius, 0.5 * s.height + s.radius, s.radius});
  }
  Box3 operator()(const ConeShape& s) const {
    const double r = std::max(s.radius, s.top_radius);
    return around_origin({r, 0.5 * s.height, r});
  }
  Box3 operator()(const TorusShape& s) const {
    const double r = s.ring_radius + s.tube_radius;
    return around_origin({r, s.tube_radius, r});
  }
  Box3 operator()(const EllipsoidShape& s) const { return around_origin(s.radii); }

  // The half space n.x <= 0 reaches furthest along an axis where all other coordinates help most.
  Box3 operator()(const PlaneShape& s) const {
    Box3 out = world;
    for (int i = 0; i < 3; ++i) {
      const double n = s.normal[i];
      if (n == 0) continue;
      double others = 0;
      for (int j = 0; j < 3; ++j) {
        if (j != i) others += std::min(s.normal[j] * world.min[j], s.normal[j] * world.max[j]);
      }
      const double limit = -others / n;
      if (n > 0) out.max[i] = std::clamp(limit, world.min[i], world.max[i]);
      if (n < 0) out.min[i] = std::clamp(limit, world.min[i], world.max[i]);
    }
    return out;
  }
  Box3 operator()(const RevolutionShape& s) const {
    double r = 0;
    Box3 out{Vec3(0, s.profile.front().y(), 0), Vec3(0, s.profile.front().y(), 0)};
    for (const Eigen::Vector2d& p : s.profile) {
      r = std::max(r, p.x());
      out.include({0, p.y(), 0});
    }
    out.min -= Vec3(r, 0, r);
    out.max += Vec3(r, 0, r);
    return out;
  }
  Box3 operator()(const MeshShape& s) const { return s.solid->bounds(); }
  // Every smooth joint can push the surface out by a quarter of the smoothing.
  Box3 operator()(const UnionShape& s) const {
    Box3 out = bounds(*s.of.front(), world);
    for (const ShapePtr& part : s.of) {
      const Box3 b = bounds(*part, world);
      out.include(b.min);
      out.include(b.max);
    }
    const double swell = 0.25 * s.smoothing * static_cast<double>(s.of.size() - 1);
    out.min.array() -= swell;
    out.max.array() += swell;
    return out;
  }
  Box3 operator()(const IntersectionShape& s) const {
    Box3 out = bounds(*s.of.front(), world);
    for (const ShapePtr& part : s.of) out = intersection(out, bounds(*part, world));
    return out;
  }
  Box3 operator()(const DifferenceShape& s) const { return bounds(*s.of.front(), world); }
  Box3 operator()(const PlacedShape& s) const {
    const Box3 local_world = transformed(world, s.rotation.transpose() / s.scale,
                                         -(s.rotation.transpose() * s.translate) / s.scale);
    const Box3 out = transformed(bounds(*s.shape, local_world), s.scale * s.rotation, s.translate);
    return is_unbounded(*s.shape) ? intersection(out, world) : out;
  }
};

}  // namespace

bool is_unbounded(const Shape& shape) {
  const auto any = [](const std::vector<ShapePtr>& of) {
    return std::any_of(of.begin(), of.end(), [](const ShapePtr& s) { return is_unbounded(*s); });
  };
  if (std::holds_alternative<PlaneShape>(shape.kind)) return true;
  if (const auto* s = std::get_if<PlacedShape>(&shape.kind)) return is_unbounded(*s->shape);
  if (const auto* s = std::get_if<UnionShape>(&shape.kind)) return any(s->of);
  if (const auto* s = std::get_if<DifferenceShape>(&shape.kind)) return is_unbounded(*s->of.front());
  if (const auto* s = std::get_if<IntersectionShape>(&shape.kind)) {
    return std::all_of(s->of.begin(), s->of.end(), [](const ShapePtr& part) { return is_unbounded(*part); });
  }
  return false;
}

Box3 transformed(const Box3& box, const Mat3& linear, const Vec3& translation) {
  const Vec3 center = linear * box.center() + translation;
  const Vec3 half = 0.5 * (linear.cwiseAbs() * box.extent());
  return {center - half, center + half};
}

Box3 bounds(const Shape& shape, const Box3& world) {
  return std::visit(Bounds{world}, shape.kind);
}

}  // namespace lather
