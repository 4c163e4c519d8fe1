#pragma once

#include <algorithm>
#include <cmath>

#include "sim/scene/scene.h"

namespace lather::mlsrk {

/// What a lattice behind a solid's surface is of a point's kernel, as if the surface were a plane.
///
/// Its first layer lies a spacing behind the points that stand on the surface, so that a lattice that stands
/// there is just full. Were they nearer (or were it the spline's integral), points on a wall would be
/// crowded; they push away those behind them, and a column of water climbs its wall in a jet.
///
/// Several surfaces share by products, as tensor-product splines do; in a corner a radial kernel's
/// share comes out some tenths of a per cent too large.
class LayersBehind {
 public:
  /// `spacing`: of the layers and in them, over the kernel's scale a.
  LayersBehind(double spacing, KernelShape shape, int dimension)
      : spacing_(spacing), radial_axes_(shape == KernelShape::kRadial ? dimension - 1 : 0) {
    double both_sides = 0;
    for (double xi = spacing; xi < 2; xi += spacing) both_sides += 2 * layer(xi);
    full_ = layer(0) + both_sides;
  }

  /// Over that of the full lattice; `distance`: over a, of the point before where points stand, negative
  /// behind it.
  [[nodiscard]] double share(double distance) const {
    double sum = 0;
    for (double xi = std::max(distance, -2.0) + spacing_; xi < 2; xi += spacing_) sum += layer(xi);
    return std::min(sum / full_, 1.0);
  }

 private:
  /// The kernels of a layer at a point that stands before one of its points, at the distance xi; of a
  /// tensor-product spline up to a factor, as along the layer it is the same for all.
  [[nodiscard]] double layer(double xi) const { return lattice(xi * xi, radial_axes_); }
  [[nodiscard]] double lattice(double squared, int axes) const {
    if (axes == 0) return spline(std::sqrt(squared));
    double sum = lattice(squared, axes - 1);
    for (double eta = spacing_; eta < 2; eta += spacing_) sum += 2 * lattice(squared + eta * eta, axes - 1);
    return sum;
  }
  static double spline(double xi) {
    const double q = std::max(2 - std::abs(xi), 0.0);
    const double p = std::max(1 - std::abs(xi), 0.0);
    return q * q * q / 6 - p * p * p * 2 / 3;
  }

  double spacing_;
  int radial_axes_;  ///< along the layer, over which a radial kernel has to be added up
  double full_;
};

}  // namespace lather::mlsrk
