// What a report says of points by every law, against closed forms and the laws' own stresses.

#include "sim/report/measure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/plan/planned_fields.h"
#include "sim/report/elastic_energy.h"

namespace lather {
namespace {

const ElasticParameters kElastic = {1000, 5e3, 0.3};

double sum(const ElasticEnergy& e) {
  return e.volume + e.shear;
}

double energy_of(const Law& law, const Mat3& G, double plastic = 0) {
  ElasticState s;
  s.deformation = G;
  s.plastic_volume_change = plastic;
  return sum(elastic_energy(law, s));
}

TEST(ElasticEnergy, OfASolidGivesItsStress) {
  // Kirchhoff stress is dPsi/dF F^T = mu (F F^T - I) + lambda log J I [MLSRK eq. 22 times J].
  const Law law = NeoHookeanParameters{kElastic, {}};
  Mat3 G;
  G << 0.1, 0.2, -0.05, 0.03, -0.1, 0.07, 0.02, -0.04, 0.15;
  const Mat3 F = Mat3::Identity() + G;
  Mat3 slope;
  const double h = 1e-5;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Mat3 step = Mat3::Zero();
      step(i, j) = h;
      slope(i, j) = (energy_of(law, G + step) - energy_of(law, G - step)) / (2 * h);
    }
  const Mat3 expected = kElastic.lame_mu() * (F * F.transpose() - Mat3::Identity()) +
                        kElastic.lame_lambda() * std::log(F.determinant()) * Mat3::Identity();
  // Central differences leave h^2 of the third derivative: 1e-10 of the moduli, a few kPa.
  EXPECT_LT((slope * F.transpose() - expected).norm(), 1e-5);
}

TEST(ElasticEnergy, OfASolidKeepsItsDigitsAtSmallStrain) {
  // Linear elasticity: lambda/2 (tr e)^2 + mu e:e. The rest is of third order, 1e-7 of it; what rounding in
  // tr G - log J takes, 1e-16 / 1e-7, is smaller.
  const Law law = NeoHookeanParameters{kElastic, {}};
  Mat3 e;
  e << 3e-8, 1e-8, 0, 1e-8, -1e-8, 2e-8, 0, 2e-8, 5e-8;
  const double trace = e.trace();
  const double expected = kElastic.lame_lambda() / 2 * trace * trace + kElastic.lame_mu() * e.squaredNorm();
  EXPECT_NEAR(energy_of(law, e) / expected, 1, 1e-6);
}

TEST(ElasticEnergy, OfSnowAndSandGrowsWithTheirHardening) {
  Mat3 G = Mat3::Zero();
  G(0, 0) = -0.02;
  G(1, 0) = 0.01;
  const double soft = energy_of(NeoHookeanParameters{kElastic, {}}, G);
  const SnowParameters snow = {kElastic, 0.025, 0.0075, 10};
  DruckerPragerParameters sand;
  sand.elastic = kElastic;
  sand.hardening = 10;
  for (const Law& law : {Law(snow), Law(sand)}) {
    EXPECT_DOUBLE_EQ(energy_of(law, G), soft);
    EXPECT_NEAR(energy_of(law, G, -0.1), soft * std::exp(1.0), 1e-12 * soft);
  }
}

TEST(ElasticEnergy, OfALiquidIsTheWorkOfItsPressureAndNothingInTension) {
  for (const double gamma : {1.0, 7.0}) {
    const LiquidParameters p = {1000, 1e5, gamma, {}};
    const auto energy = [&](double j) {
      ElasticState s;
      s.volume_change = j;
      return elastic_energy(p, s);
    };
    const double j = -0.1;
    const double h = 1e-6;
    const double pressure = p.bulk_modulus / gamma * (std::pow(1 + j, -gamma) - 1);
    // Central differences: h^2 of the third derivative and 1e-16 / h of rounding, over K.
    EXPECT_NEAR((energy(j - h).volume - energy(j + h).volume) / (2 * h), pressure, 1e-8 * p.bulk_modulus);
    EXPECT_NEAR(energy(-1e-4).volume, 0.5 * p.bulk_modulus * 1e-8, 1e-3 * p.bulk_modulus * 1e-8);
    EXPECT_EQ(energy(0.1).volume, 0);
    EXPECT_EQ(energy(j).shear, 0);
  }
}

/// One point of a material at (1, 2, 3) m with 2 m/s along x, in the MLSRK solver.
template <class Real>
struct OnePoint {
  explicit OnePoint(const Law& law, int dimension = 3) {
    scene.solver = Solver::kMlsrk;
    scene.dimension = dimension;
    scene.spacing = 0.1;
    scene.points_per_cell = 1;
    Material m;
    m.law = law;
    scene.materials = {m};
    sets.emplace_back(dimension, planned_fields(scene, m), Vec3::Zero(), scene.spacing);
    slot = sets[0].add({1, 2, dimension == 3 ? 3.0 : 0.0}, {2, 0, 0}, Mat3::Zero(), 0);
  }
  void put(Field field, int component, double value) {
    sets[0].template values<Real>(slot.tile, field, component)[slot.lane] = static_cast<Real>(value);
  }
  [[nodiscard]] FrameMeasure measure() const { return measure_points(scene, sets, 1); }

  Scene scene;
  std::vector<ParticleSet<Real>> sets;
  PointSlot slot;
};

TEST(Measure, TakesMassAndEnergyFromTheMaterialsLaw) {
  OnePoint<double> jelly(NeoHookeanParameters{kElastic, {}});
  jelly.put(Field::kDeformation, 0, 0.1);   // xx
  jelly.put(Field::kDeformation, 1, 0.2);   // xy
  jelly.put(Field::kDeformation, 8, -0.3);  // zz
  const FrameMeasure m = jelly.measure();
  EXPECT_DOUBLE_EQ(m.mass, 1);
  EXPECT_DOUBLE_EQ(m.kinetic_energy, 2);
  EXPECT_NEAR((m.angular_momentum - Vec3(0, 6, -4)).norm(), 0, 1e-9);  // positions to 1e-16 of 0.1 m
  EXPECT_DOUBLE_EQ(m.min_volume_ratio, 1.1 * 0.7);
  EXPECT_DOUBLE_EQ(m.max_volume_ratio, 1.1 * 0.7);
  const double log_J = std::log(1.1 * 0.7);
  const double trace = 1.1 * 1.1 + 0.2 * 0.2 + 1 + 0.7 * 0.7;
  EXPECT_NEAR(m.elastic_volume_energy, 1e-3 * kElastic.lame_lambda() / 2 * log_J * log_J, 1e-12);
  EXPECT_NEAR(m.elastic_shear_energy, 1e-3 * kElastic.lame_mu() * ((trace - 3) / 2 - log_J), 1e-12);
}

TEST(Measure, ReadsAPlaneDeformationByItsOwnLayout) {
  OnePoint<float> jelly(NeoHookeanParameters{kElastic, {}}, 2);
  const double xx = 0.25;
  const double xy = 0.5;
  const double yx = 0.125;
  const double yy = -0.25;
  const double entries[] = {xx, xy, yx, yy, 0};
  for (int c = 0; c < 5; ++c) jelly.put(Field::kDeformation, c, entries[c]);
  EXPECT_DOUBLE_EQ(jelly.measure().min_volume_ratio, 1.25 * 0.75 - 0.5 * 0.125);
}

TEST(Measure, TheVolumeOfSnowIsElasticAndPlastic) {
  SnowParameters law;
  law.elastic = kElastic;
  OnePoint<double> snow(law);
  snow.put(Field::kDeformation, 4, -0.02);
  snow.put(Field::kPlasticVolume, 0, -0.1);
  EXPECT_DOUBLE_EQ(snow.measure().min_volume_ratio, 0.98 * 0.9);
}

TEST(Measure, ALiquidHasItsVolumeAndNoShear) {
  OnePoint<double> water(LiquidParameters{500, 1e5, 7, {1, 0}});
  water.put(Field::kVolumeChange, 0, -0.05);
  const FrameMeasure m = water.measure();
  EXPECT_DOUBLE_EQ(m.mass, 0.5);
  EXPECT_DOUBLE_EQ(m.min_volume_ratio, 0.95);
  EXPECT_GT(m.elastic_volume_energy, 0);
  EXPECT_EQ(m.elastic_shear_energy, 0);
}

}  // namespace
}  // namespace lather
