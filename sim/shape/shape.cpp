#include "sim/shape/shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/shape/mesh_solid.h"
#include "sim/shape/placement.h"
#include "sim/shape/primitives.h"

namespace lather {
namespace {

/// The smaller of two distances, rounded off where they differ by less than `width`. Both slopes enter with
/// weights that are positive and sum to one, so the result stays 1-Lipschitz.
double smooth_min(double a, double b, double width) {
  const double overlap = std::max(width - std::abs(a - b), 0.0);
  return std::min(a, b) - 0.25 * overlap * overlap / width;
}

/// Never more than the distance; -infinity where that would cost as much as the distance itself.
struct LeastDistance {
  const Vec3& x;

  template <class Kind>
  double operator()(const Kind& /*s*/) const {
    return -std::numeric_limits<double>::infinity();
  }
  double operator()(const EllipsoidShape& s) const { return primitive::least_distance(s, x); }
  double operator()(const PlacedShape& s) const {
    const Vec3 local = s.rotation.transpose() * (x - s.translate) / s.scale;
    return s.scale * std::visit(LeastDistance{local}, s.shape->kind);
  }
};

struct Distance {
  const Vec3& x;

  template <class Primitive>
  double operator()(const Primitive& s) const {
    return primitive::distance(s, x);
  }
  double operator()(const MeshShape& s) const { return s.solid->distance(x); }
  double operator()(const UnionShape& s) const {
    double d = distance(*s.of.front(), x);
    for (std::size_t i = 1; i < s.of.size(); ++i) {
      // What is further away by the smoothing's width changes nothing, to the last bit.
      if (std::visit(LeastDistance{x}, s.of[i]->kind) > d + s.smoothing) continue;
      const double other = distance(*s.of[i], x);
      d = s.smoothing > 0 ? smooth_min(d, other, s.smoothing) : std::min(d, other);
    }
    return d;
  }
  double operator()(const IntersectionShape& s) const {
    double d = distance(*s.of.front(), x);
    for (std::size_t i = 1; i < s.of.size(); ++i) d = std::max(d, distance(*s.of[i], x));
    return d;
  }
  double operator()(const DifferenceShape& s) const {
    double d = distance(*s.of.front(), x);
    for (std::size_t i = 1; i < s.of.size(); ++i) d = std::max(d, -distance(*s.of[i], x));
    return d;
  }
  double operator()(const PlacedShape& s) const {
    const Vec3 local = s.rotation.transpose() * (x - s.translate);
    if (s.scale == 1) return distance(*s.shape, local);
    return s.scale * distance(*s.shape, local / s.scale);
  }
};

}  // namespace

PlacedShape::PlacedShape(ShapePtr placed, const Vec3& by, const Vec3& turned_deg, double scaled)
    : shape(std::move(placed)),
      translate(by),
      rotate_deg(turned_deg),
      rotation(rotation_of(turned_deg)),
      scale(scaled) {}

double distance(const Shape& shape, const Vec3& x) {
  return std::visit(Distance{x}, shape.kind);
}

Vec3 normal(const Shape& shape, const Vec3& x, double h) {
  Vec3 gradient;
  for (int i = 0; i < 3; ++i) {
    const Vec3 step = h * Vec3::Unit(i);
    gradient[i] = distance(shape, x + step) - distance(shape, x - step);
  }
  const double length = gradient.norm();
  return length > 1e-6 * h ? Vec3(gradient / length) : Vec3::UnitY();
}

}  // namespace lather
