#pragma once

#include <algorithm>
#include <cmath>

namespace lather::mlsrk {

/// What a lattice behind a solid's surface is of a point's kernel, as if the surface were a plane.
///
/// Its first layer lies a spacing behind the points that stand on the surface, so that a lattice that stands
/// there is just full. Were they nearer (or were it the spline's integral), points on a wall would be
/// crowded; they push away those behind them, and a column of water climbs its wall in a jet.
class LayersBehind {
 public:
  /// `spacing`: of the layers, over the kernel's scale a.
  explicit LayersBehind(double spacing) : spacing_(spacing) {
    double both_sides = 0;
    for (double xi = spacing; xi < 2; xi += spacing) both_sides += 2 * spline(xi);
    full_ = spline(0) + both_sides;
  }

  /// Over that of the full lattice; `distance`: over a, of the point before where points stand, negative
  /// behind it.
  [[nodiscard]] double share(double distance) const {
    double sum = 0;
    for (double xi = std::max(distance, -2.0) + spacing_; xi < 2; xi += spacing_) sum += spline(xi);
    return std::min(sum / full_, 1.0);
  }

 private:
  static double spline(double xi) {
    const double q = std::max(2 - std::abs(xi), 0.0);
    const double p = std::max(1 - std::abs(xi), 0.0);
    return q * q * q / 6 - p * p * p * 2 / 3;
  }

  double spacing_;
  double full_;
};

}  // namespace lather::mlsrk
