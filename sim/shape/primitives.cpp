#include "sim/shape/primitives.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lather::primitive {
namespace {

using Vec2 = Eigen::Vector2d;

/// Distance from the y axis.
double ring(const Vec3& x) {
  return std::hypot(x.x(), x.z());
}

/// Signed distance of a point from a box of any dimension, given q = |x| - half size.
template <class V>
double box_distance(const V& q) {
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

/// From `p` to the nearest point of the segment `a` `b`.
Vec2 to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return a + t * ab - p;
}

/// Does the ray from `p` away from the axis cross the edge? An even number of crossings means outside.
bool crosses(const Vec2& p, const Vec2& a, const Vec2& b) {
  if ((a.y() > p.y()) == (b.y() > p.y())) return false;
  return p.x() < a.x() + (p.y() - a.y()) * (b.x() - a.x()) / (b.y() - a.y());
}

}  // namespace

double distance(const SphereShape& s, const Vec3& x) {
  return x.norm() - s.radius;
}

double distance(const BoxShape& s, const Vec3& x) {
  const Vec3 q = x.cwiseAbs() - 0.5 * s.size + Vec3::Constant(s.rounding);
  return box_distance(q) - s.rounding;
}

double distance(const CylinderShape& s, const Vec3& x) {
  const Vec2 q(ring(x) - s.radius + s.rounding, std::abs(x.y()) - 0.5 * s.height + s.rounding);
  return box_distance(q) - s.rounding;
}

double distance(const CapsuleShape& s, const Vec3& x) {
  const double along = std::max(std::abs(x.y()) - 0.5 * s.height, 0.0);
  return std::hypot(ring(x), along) - s.radius;
}

double distance(const ConeShape& s, const Vec3& x) {
  const double half = 0.5 * s.height;
  const Vec2 p(ring(x), x.y());
  const Vec2 side = to_segment(p, {s.radius, -half}, {s.top_radius, half});
  const double cap_radius = p.y() < 0 ? s.radius : s.top_radius;
  const Vec2 cap(std::max(p.x() - cap_radius, 0.0), std::abs(p.y()) - half);
  const bool inside = std::abs(p.y()) < half && side.x() > 0;
  const double magnitude = std::sqrt(std::min(side.squaredNorm(), cap.squaredNorm()));
  return inside ? -magnitude : magnitude;
}

double distance(const TorusShape& s, const Vec3& x) {
  return std::hypot(ring(x) - s.ring_radius, x.y()) - s.tube_radius;
}

double distance(const PlaneShape& s, const Vec3& x) {
  return s.normal.dot(x) / s.normal.norm();
}

// The nearest point of a surface of revolution lies in the half plane of the axis and x, so the distance is
// the polygon's there. An edge that lies on the axis bounds the polygon but is no part of the surface.
double distance(const RevolutionShape& s, const Vec3& x) {
  const Vec2 p(ring(x), x.y());
  double nearest2 = std::numeric_limits<double>::infinity();
  bool inside = false;
  const std::size_t n = s.profile.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2& a = s.profile[i];
    const Vec2& b = s.profile[i + 1 < n ? i + 1 : 0];
    if (crosses(p, a, b)) inside = !inside;
    if (a.x() > 0 || b.x() > 0) nearest2 = std::min(nearest2, to_segment(p, a, b).squaredNorm());
  }
  const double magnitude = std::sqrt(nearest2);
  return inside ? -magnitude : magnitude;
}

}  // namespace lather::primitive
