#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/shape/primitives.h"

/// Exact distance from an ellipsoid (D. Eberly, "Distance from a Point to an Ellipse, an Ellipsoid, or a
/// Hyperellipsoid", 2013). In the first octant, with half axes e and point y, the nearest point is
///   x_i = e_i^2 y_i / (t + e_i^2),  where t is the largest root of  F(t) = sum_i (e_i y_i / (t + e_i^2))^2
///   - 1.
/// F is convex and falls for t > -e_min^2, so Newton started where F >= 0 walks up to the root and never
/// beyond it. The unknown here is s = t + e_min^2, which keeps its digits for points close to the middle
/// plane.
namespace lather::primitive {
namespace {

struct Sorted {
  std::array<double, 3> e;  ///< half axes over the smallest, falling; e[2] = 1
  std::array<double, 3> y;  ///< the point likewise, >= 0
  double unit;              ///< the smallest half axis, m
};

Sorted sorted(const EllipsoidShape& s, const Vec3& x) {
  std::array<std::pair<double, double>, 3> axes;
  for (int i = 0; i < 3; ++i) axes[static_cast<std::size_t>(i)] = {s.radii[i], std::abs(x[i])};
  std::sort(axes.begin(), axes.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  Sorted out{};
  out.unit = axes[2].first;
  for (std::size_t i = 0; i < 3; ++i) {
    out.e[i] = axes[i].first / out.unit;
    out.y[i] = axes[i].second / out.unit;
  }
  return out;
}

/// The point lies on the plane through the two larger axes: the nearest point may leave that plane. Returns
/// the squared distance, or a negative number where the nearest point stays in the plane.
double squared_distance_off_plane(const Sorted& p) {
  double distance2 = 0;
  double rest = 1;
  for (std::size_t i = 0; i < 2; ++i) {
    const double gap = p.e[i] * p.e[i] - 1;
    if (p.y[i] == 0) continue;
    const double x = p.e[i] * p.e[i] * p.y[i] / gap;
    rest -= x * x / (p.e[i] * p.e[i]);
    distance2 += (x - p.y[i]) * (x - p.y[i]);
  }
  return rest >= 0 ? distance2 + rest : -1;
}

double squared_distance_by_newton(const Sorted& p) {
  const std::array<double, 3> gap = {p.e[0] * p.e[0] - 1, p.e[1] * p.e[1] - 1, 0};
  double s = 0;
  for (std::size_t i = 0; i < 3; ++i) s = std::max(s, p.e[i] * p.y[i] - gap[i]);
  for (int iteration = 0; iteration < 100; ++iteration) {
    double F = -1;
    double slope = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (p.y[i] == 0) continue;
      const double over = 1 / (s + gap[i]);
      const double term = p.e[i] * p.y[i] * over;
      F += term * term;
      slope -= 2 * term * term * over;
    }
    const double next = s - F / slope;
    if (!(next > s)) break;
    s = next;
  }
  double distance2 = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (p.y[i] == 0) continue;
    const double away = p.y[i] * (s - 1) / (s + gap[i]);
    distance2 += away * away;
  }
  return distance2;
}

}  // namespace

double distance(const EllipsoidShape& s, const Vec3& x) {
  const bool inside = x.cwiseQuotient(s.radii).squaredNorm() < 1;
  const Sorted p = sorted(s, x);
  double distance2 = p.y[2] == 0 ? squared_distance_off_plane(p) : -1;
  if (distance2 < 0) distance2 = squared_distance_by_newton(p);
  const double magnitude = p.unit * std::sqrt(distance2);
  return inside ? -magnitude : magnitude;
}

double least_distance(const EllipsoidShape& s, const Vec3& x) {
  // |x / radii| is 1 on the surface and grows by at most 1 over the smallest half axis.
  const double over = x.cwiseQuotient(s.radii).norm() - 1;
  return over > 0 ? over * s.radii.minCoeff() : -std::numeric_limits<double>::infinity();
}

}  // namespace lather::primitive
