#include "tests/scenes/galton.h"

#include <algorithm>
#include <cmath>

#include "tests/scenes/scene_run.h"

namespace lather::testing_support {
namespace {

/// Cubic spline; its scale does not matter here.
double spline(double q) {
  q = std::abs(q);
  if (q >= 2) return 0;
  return q < 1 ? 2.0 / 3 - q * q * (1 - q / 2) : (2 - q) * (2 - q) * (2 - q) / 6;
}

/// Values at the middles of square cells.
struct Raster {
  Vec3 corner;
  double cell;
  int columns;
  int rows;
  std::vector<double> values = std::vector<double>(static_cast<std::size_t>(columns) * rows, 0.0);

  /// Adds the product of splines of support 2 a around x.
  void add(const Vec3& x, double a) {
    const auto range = [&](double place, int count) {
      const int low = static_cast<int>(std::floor((place - 2 * a) / cell));
      const int high = static_cast<int>(std::ceil((place + 2 * a) / cell));
      return std::pair{std::clamp(low, 0, count), std::clamp(high, 0, count)};
    };
    const Vec3 place = x - corner;
    const auto [left, right] = range(place.x(), columns);
    const auto [bottom, top] = range(place.y(), rows);
    for (int i = left; i < right; ++i) {
      const double across = spline(((i + 0.5) * cell - place.x()) / a);
      for (int j = bottom; j < top; ++j)
        values[static_cast<std::size_t>(i) * rows + j] += across * spline(((j + 0.5) * cell - place.y()) / a);
    }
  }
};

/// By how much the weight of water that lies `depth` deep presses it together, on the mean.
double compression(const Scene& scene, double depth) {
  const auto& law = std::get<DruckerPragerParameters>(scene.materials.front().law);
  const double bulk = law.elastic.lame_lambda() + law.elastic.lame_mu();  // of the plane, without shear
  return law.elastic.density * -scene.gravity.y() * depth / 2 / bulk;
}

}  // namespace

double covered_area(const Scene& scene, const Simulation& simulation, const Box3& within) {
  constexpr int kFineness = 6;  // cells a spacing
  const double cell = scene.spacing / kFineness;
  const Vec3 extent = within.extent();
  Raster raster{within.min, cell, static_cast<int>(std::round(extent.x() / cell)),
                static_cast<int>(std::round(extent.y() / cell))};
  const double a = 0.5 * scene.numerics.mlsrk.support_radius * scene.spacing;
  simulation.visit_points([&](const PointState& p) { raster.add(p.position, a); });
  double full = 0;
  for (int i = -4; i <= 4; ++i) full += spline(i * scene.spacing / a);
  const auto covered = std::count_if(raster.values.begin(), raster.values.end(),
                                     [&](double value) { return value > 0.5 * full * full; });
  return static_cast<double>(covered) * cell * cell;
}

double area_kept(const std::string& size, const std::vector<Override>& overrides, int threads) {
  const Scene scene = scene_file("galton-board", size, overrides);
  const Box3 tank{{-0.5, 0, 0}, {0.5, scene.domain.box.max.y(), 0}};
  double first = 0;
  double sum = 0;
  int frames = 0;
  run_scene(scene, threads, [&](int frame, const Simulation& simulation) {
    if (frame == 0) first = covered_area(scene, simulation, tank);
    if (frame / scene.frame_rate < scene.duration - 0.25) return;
    sum += covered_area(scene, simulation, tank);
    ++frames;
  });
  return sum / frames / first / (1 - compression(scene, first / tank.extent().x()));
}

}  // namespace lather::testing_support
