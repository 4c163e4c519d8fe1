#include "tests/scenes/coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace lather::testing_support {
namespace {

constexpr int kUp = 1;  // the axis along which the tank is open

/// Cubic spline; its scale does not matter here.
double spline(double q) {
  q = std::abs(q);
  if (q >= 2) return 0;
  return q < 1 ? 2.0 / 3 - q * q * (1 - q / 2) : (2 - q) * (2 - q) * (2 - q) / 6;
}

/// Cells along one axis of the tank.
struct Axis {
  double low;
  double high;
  double cell;
  int count;
  bool wall_at_high;

  /// Splines of support 2 a around x and its mirror images at the cells that they reach; the first of these.
  int weigh(double x, double a, std::vector<double>& weights) const {
    const int first = std::clamp(static_cast<int>(std::floor((x - low - 2 * a) / cell)), 0, count);
    const int last = std::clamp(static_cast<int>(std::ceil((x - low + 2 * a) / cell)), 0, count);
    weights.clear();
    for (int i = first; i < last; ++i) {
      const double at = low + (i + 0.5) * cell;
      const double mirrored = spline((at - 2 * low + x) / a);
      const double beyond = wall_at_high ? spline((2 * high - x - at) / a) : 0;
      weights.push_back(spline((at - x) / a) + mirrored + beyond);
    }
    return first;
  }
};

std::array<Axis, 3> axes_of(const Scene& scene, const Box3& tank) {
  const double cell = scene.spacing / (scene.dimension == 2 ? 6 : 4);
  std::array<Axis, 3> axes{};
  for (int d = 0; d < 3; ++d) {
    const double length = tank.max[d] - tank.min[d];
    const int count = d < scene.dimension ? static_cast<int>(std::round(length / cell)) : 1;
    axes[static_cast<std::size_t>(d)] = {tank.min[d], tank.max[d], cell, count, d != kUp};
  }
  return axes;
}

}  // namespace

double floor_area(const Scene& scene) {
  const Vec3 extent = scene.domain.box.extent();
  return extent.x() * (scene.dimension == 3 ? extent.z() : 1);
}

double covered_volume(const Scene& scene, const Simulation& simulation, const Box3& tank) {
  const std::array<Axis, 3> axes = axes_of(scene, tank);
  const double a = 0.5 * scene.numerics.mlsrk.support_radius * scene.spacing;
  const auto place = [&](int i, int j, int k) {
    return static_cast<std::size_t>((i * axes[1].count + j) * axes[2].count + k);
  };
  std::vector<double> sums(place(axes[0].count, 0, 0), 0.0);
  std::array<std::vector<double>, 3> w;
  simulation.visit_points([&](const PointState& p) {
    const int i0 = axes[0].weigh(p.position.x(), a, w[0]);
    const int j0 = axes[1].weigh(p.position.y(), a, w[1]);
    const int k0 = scene.dimension == 3 ? axes[2].weigh(p.position.z(), a, w[2]) : (w[2] = {1.0}, 0);
    for (std::size_t i = 0; i < w[0].size(); ++i)
      for (std::size_t j = 0; j < w[1].size(); ++j) {
        const std::size_t row = place(i0 + static_cast<int>(i), j0 + static_cast<int>(j), k0);
        for (std::size_t k = 0; k < w[2].size(); ++k) sums[row + k] += w[0][i] * w[1][j] * w[2][k];
      }
  });
  double line = 0;
  for (int i = -4; i <= 4; ++i) line += spline(i * scene.spacing / a);
  const double half = 0.5 * std::pow(line, scene.dimension);
  const auto covered = std::count_if(sums.begin(), sums.end(), [&](double s) { return s > half; });
  return static_cast<double>(covered) * std::pow(axes[0].cell, scene.dimension);
}

double compression_under_weight(const Scene& scene, double depth) {
  const auto& law = std::get<DruckerPragerParameters>(scene.materials.front().law);
  // Without shear, stretches along all axes of space count alike: lambda + 2 mu/d.
  const double bulk = law.elastic.lame_lambda() + 2 * law.elastic.lame_mu() / scene.dimension;
  return law.elastic.density * -scene.gravity.y() * depth / 2 / bulk;
}

}  // namespace lather::testing_support
