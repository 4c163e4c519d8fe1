#include "sim/report/measure.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "sim/math/counter_rng.h"
#include "sim/math/parallel.h"
#include "sim/report/elastic_energy.h"

namespace lather {
namespace {

constexpr std::size_t kChunkTiles = 256;

template <class Real>
class PointMeasure {
 public:
  PointMeasure(const Scene& scene, const Material& material, const ParticleSet<Real>& set)
      : scene_(scene),
        laws_(material.laws()),
        density_(material.density()),
        density_curve_(material.phase ? material.phase->curve_of("density") : nullptr),
        tear_threshold_(static_cast<Real>(material.tearing.tear_threshold)),
        set_(set),
        volume_(scene.point_volume()),
        moment_((scene.numerics.kernel == Kernel::kCubic ? 1.0 / 3.0 : 0.25) * scene.spacing *
                scene.spacing) {}

  [[nodiscard]] static FrameMeasure empty(const Scene& scene) {
    FrameMeasure m;
    constexpr double kNone = std::numeric_limits<double>::infinity();
    if (scene.has_phases()) m.phases = {0, kNone, -kNone, 0};
    m.lowest.setConstant(std::numeric_limits<double>::infinity());
    m.highest.setConstant(-std::numeric_limits<double>::infinity());
    m.min_volume_ratio = std::numeric_limits<double>::infinity();
    return m;
  }

  void add(FrameMeasure& m, std::size_t t, int lane) const {
    const double volume = volume_ * set_.share(t, lane);
    const double mass = density_ * volume;
    const Vec3 x = set_.position(t, lane);
    const Vec3 v = set_.velocity(t, lane);
    ++m.points;
    m.mass += mass;
    m.momentum += mass * v;
    m.angular_momentum += mass * (x.cross(v) + affine_spin(t, lane));
    m.center_of_mass += mass * x;
    m.lowest = m.lowest.cwiseMin(x);
    m.highest = m.highest.cwiseMax(x);
    m.kinetic_energy += 0.5 * mass * v.squaredNorm();
    m.gravity_energy -= mass * scene_.gravity.dot(x);
    m.max_speed = std::max(m.max_speed, v.norm());
    const double j = set_.volume_change(t, lane);
    const Law& law = law_of(t, lane);
    const double rest_volume = mass / rest_density(t, lane);  // swollen or shrunk
    if (set_.layout().has(Field::kConcentration))
      add_phase(*m.phases, concentration(t, lane), mass, rest_volume);
    const ElasticEnergy e = elastic_energy(law, state_of(t, lane, j));
    m.elastic_volume_energy += rest_volume * e.volume;
    m.elastic_shear_energy += rest_volume * e.shear;
    m.min_volume_ratio = std::min(m.min_volume_ratio, 1 + j);
    m.max_volume_ratio = std::max(m.max_volume_ratio, 1 + j);
    if (set_.layout().has(Field::kPlasticity) && at(t, lane, Field::kPlasticity, 0) > tear_threshold_)
      m.weak_fraction += 1;
  }

  /// Sums and extremes of the points with a concentration.
  static void fold(PhaseMeasure& sum, const PhaseMeasure& part) {
    sum.component_mass += part.component_mass;
    sum.rest_volume += part.rest_volume;
    sum.least = std::min(sum.least, part.least);
    sum.largest = std::max(sum.largest, part.largest);
  }

 private:
  static void add_phase(PhaseMeasure& sum, double c, double mass, double rest_volume) {
    fold(sum, {mass * c, c, c, rest_volume});
  }
  [[nodiscard]] double concentration(std::size_t t, int lane) const {
    return set_.template values<double>(t, Field::kConcentration)[lane];
  }
  [[nodiscard]] double rest_density(std::size_t t, int lane) const {
    return density_curve_ != nullptr ? value_at(*density_curve_, concentration(t, lane)) : density_;
  }
  /// The law at the nearest tabulated concentration.
  [[nodiscard]] const Law& law_of(std::size_t t, int lane) const {
    if (laws_.size() == 1) return laws_.front();
    const double c = std::clamp(concentration(t, lane), 0.0, 1.0);
    return laws_[static_cast<std::size_t>(std::lround(c * kConcentrationNodes))];
  }
  [[nodiscard]] double at(std::size_t t, int lane, Field f, int c) const {
    return static_cast<double>(set_.template values<Real>(t, f, c)[lane]);
  }

  [[nodiscard]] ElasticState state_of(std::size_t t, int lane, double volume_change) const {
    ElasticState s;
    s.volume_change = volume_change;
    if (set_.layout().has(Field::kElasticStrain)) {
      for (int c = 0; c < 3; ++c) s.trace_elastic_strain += at(t, lane, Field::kElasticStrain, c);
      return s;
    }
    s.deformation = set_.deformation_change(t, lane);
    s.plastic_volume_change = set_.plastic_volume_change(t, lane);
    return s;
  }

  [[nodiscard]] Vec3 affine_spin(std::size_t t, int lane) const {
    if (!set_.layout().has(Field::kAffine)) return Vec3::Zero();
    const int d = scene_.dimension;
    const auto c = [&](int a, int b) {
      return a < d && b < d ? at(t, lane, Field::kAffine, a * d + b) : 0.0;
    };
    return moment_ * Vec3(c(2, 1) - c(1, 2), c(0, 2) - c(2, 0), c(1, 0) - c(0, 1));
  }

  const Scene& scene_;
  std::vector<Law> laws_;       // by concentration, or one
  double density_;              // at t = 0
  const Curve* density_curve_;  // null: it does not change
  double tear_threshold_;       ///< as rounded for the kernels
  const ParticleSet<Real>& set_;
  double volume_;
  double moment_;
};

/// Chains the bits of whole tiles (random_bits is a good mixer).
std::uint64_t fingerprint(const std::byte* bytes, std::size_t count) {
  std::uint64_t hash = count;
  for (std::size_t i = 0; i + 8 <= count; i += 8) {  // tiles are multiples of 64 bytes
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + i, 8);
    hash = random_bits(hash, word);
  }
  return hash;
}

void fold(FrameMeasure& sum, const FrameMeasure& part) {
  sum.points += part.points;
  sum.fingerprint = random_bits(sum.fingerprint, part.fingerprint);
  sum.mass += part.mass;
  sum.momentum += part.momentum;
  sum.angular_momentum += part.angular_momentum;
  sum.center_of_mass += part.center_of_mass;  // times mass, until the end
  sum.lowest = sum.lowest.cwiseMin(part.lowest);
  sum.highest = sum.highest.cwiseMax(part.highest);
  sum.kinetic_energy += part.kinetic_energy;
  sum.elastic_volume_energy += part.elastic_volume_energy;
  sum.elastic_shear_energy += part.elastic_shear_energy;
  sum.gravity_energy += part.gravity_energy;
  sum.max_speed = std::max(sum.max_speed, part.max_speed);
  sum.min_volume_ratio = std::min(sum.min_volume_ratio, part.min_volume_ratio);
  sum.max_volume_ratio = std::max(sum.max_volume_ratio, part.max_volume_ratio);
  sum.weak_fraction += part.weak_fraction;  // a count, until the end
  if (sum.phases) PointMeasure<float>::fold(*sum.phases, *part.phases);
}

}  // namespace

template <class Real>
FrameMeasure measure_points(const Scene& scene, const std::vector<ParticleSet<Real>>& sets, int threads) {
  FrameMeasure sum = PointMeasure<Real>::empty(scene);
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const ParticleSet<Real>& set = sets[s];
    const PointMeasure<Real> points(scene, scene.materials[s], set);
    const std::size_t chunks = (set.tiles() + kChunkTiles - 1) / kChunkTiles;
    sum = parallel_fold(
        threads, static_cast<std::int64_t>(chunks), sum,
        [&](std::int64_t c) {
          FrameMeasure part = PointMeasure<Real>::empty(scene);
          const std::size_t first = static_cast<std::size_t>(c) * kChunkTiles;
          const std::size_t end = std::min(first + kChunkTiles, set.tiles());
          part.fingerprint =
              fingerprint(set.tile(first), (end - first) * static_cast<std::size_t>(set.layout().stride));
          for (std::size_t t = first; t < end; ++t)
            for (int lane = 0; lane < kTile; ++lane)
              if (set.template values<std::uint32_t>(t, Field::kId)[lane] != kNoPoint)
                points.add(part, t, lane);
          return part;
        },
        fold);
  }
  if (sum.mass > 0) sum.center_of_mass /= sum.mass;
  if (sum.points > 0) sum.weak_fraction /= static_cast<double>(sum.points);
  if (sum.points == 0) {
    sum.lowest.setZero();
    sum.highest.setZero();
    sum.min_volume_ratio = 0;
  }
  if (sum.phases && sum.phases->largest < sum.phases->least) sum.phases = PhaseMeasure();  // no point has one
  return sum;
}

template FrameMeasure measure_points(const Scene&, const std::vector<ParticleSet<float>>&, int);
template FrameMeasure measure_points(const Scene&, const std::vector<ParticleSet<double>>&, int);

}  // namespace lather
