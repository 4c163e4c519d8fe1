// Probes: forces are what momentum says, series do not change the run, flux counts what passes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "tests/support/run_scene.h"

namespace lather {
namespace {

using testing_support::run;

/// A soft elastic block falls obliquely on a tilted obstacle in a slip box.
std::string block_scene(const std::string& probes) {
  return R"({"lather": 1, "domain": {"min": [0, 0, -0.2], "max": [0.4, 0.4, 0.2]}, "duration": 0.2, "frame_rate": 20,
    "spacing": 0.025, "materials": [{"name": "jelly", "density": 500, "bulk_modulus": 4000, "shear_modulus": 1500,
                                    "yield_stress": "infinity"}],
    "bodies": [{"name": "block", "material": "jelly", "velocity": [0.4, -1, 0],
                "shape": {"type": "box", "size": [0.1, 0.1, 0.1], "translate": [0.2, 0.2, 0]}}],
    "obstacles": [{"name": "plate", "friction": 0.3,
                   "shape": {"type": "box", "size": [0.3, 0.08, 0.3], "translate": [0.2, 0.06, 0], "rotate_deg": [0, 0, 10]}}],
    "numerics": {"time_step": 1e-3}, "probes": [)" +
         probes + "]}";
}

constexpr const char* kLoads =
    R"({"type": "force", "name": "plate", "obstacle": "plate"}, {"type": "walls", "name": "box", "about": [0.2, 0, 0]})";

const ProbeSeries& series(const Report& r, const std::string& name) {
  for (const ProbeSeries& p : r.probes)
    if (p.name == name) return p;
  throw std::runtime_error("no probe " + name);
}

double value(const ProbeSeries& p, std::size_t row, std::size_t column) {
  return p.values[row * p.columns.size() + column];
}

Vec3 vector(const ProbeSeries& p, std::size_t row, std::size_t first) {
  return {value(p, row, first), value(p, row, first + 1), value(p, row, first + 2)};
}

struct Variant {
  const char* name;
  const char* transfer;
  const char* precision;
  const char* kernel;
  int dimension;
};
void PrintTo(const Variant& variant, std::ostream* out) {
  *out << variant.name;
}

class ProbeVariants : public testing::TestWithParam<Variant> {};

TEST_P(ProbeVariants, ImpulsesOnObstaclesAndWallsAreTheChangeOfMomentum) {
  const Variant& v = GetParam();
  const Report r = run(block_scene(kLoads), {{"/numerics/transfer", v.transfer},
                                             {"/numerics/precision", v.precision},
                                             {"/numerics/kernel", v.kernel},
                                             {"/dimension", std::to_string(v.dimension)}});
  const ProbeSeries& plate = series(r, "plate");
  const ProbeSeries& walls = series(r, "box");
  ASSERT_EQ(plate.times.size(), 4U);
  const double m = r.frames[0].mass;
  // A step rounds the momentum of each point once and of each node a few times, each by half an epsilon of
  // the largest speed (under 3 m/s), independently: as in the test of free flight, 8 epsilon sqrt(steps) m v.
  const bool single = std::string(v.precision) == "float";
  const double epsilon =
      single ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon();
  const double bound = 8 * epsilon * std::sqrt(200.0) * m * 3;
  double before = 0;
  Vec3 given = Vec3::Zero();
  for (std::size_t i = 0; i < plate.times.size(); ++i) {
    given += (vector(plate, i, 0) + vector(walls, i, 0)) * (plate.times[i] - before);
    before = plate.times[i];
    const Vec3 weight(0, -9.81 * m * before, 0);
    const Vec3 change = r.frames[i + 1].momentum - r.frames[0].momentum;
    EXPECT_LT((change - (weight - given)).norm(), bound) << i;
  }
  double largest = 0;
  for (std::size_t i = 0; i < plate.times.size(); ++i)
    largest = std::max(largest, vector(plate, i, 0).norm());
  EXPECT_GT(largest, m * 9.81);  // it has landed
}

INSTANTIATE_TEST_SUITE_P(Variants, ProbeVariants,
                         testing::Values(Variant{"FlipCubicFloat3D", "flip", "float", "cubic", 3},
                                         Variant{"ApicCubicDouble3D", "apic", "double", "cubic", 3},
                                         Variant{"FlipQuadraticDouble3D", "flip", "double", "quadratic", 3},
                                         Variant{"FlipCubicDouble2D", "flip", "double", "cubic", 2}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Probes, ARestingBlockPressesWithItsWeightAndTurnsAboutAPoint) {
  // Off centre on a level plate: 0.05 m beside the point that torque is taken about. APIC's PIC damps it to
  // rest.
  const std::string probes =
      R"({"type": "force", "name": "plate", "obstacle": "plate", "about": [0.15, 0.1, 0], "interval": 0.1})";
  const Report r = run(block_scene(probes), {{"/obstacles/0/shape/rotate_deg", "[0, 0, 0]"},
                                             {"/obstacles/0/friction", "0"},
                                             {"/bodies/0/velocity", "[0, 0, 0]"},
                                             {"/bodies/0/shape/translate", "[0.2, 0.15, 0]"},
                                             {"/numerics/flip_blend", "0.5"},
                                             {"/numerics/flip_blend_reference_step", "1e-3"},
                                             {"/duration", "0.8"}});
  const ProbeSeries& p = series(r, "plate");
  const double weight = 9.81 * r.frames[0].mass;
  ASSERT_EQ(p.times.size(), 8U);
  const Vec3 force = vector(p, 7, 0);
  const Vec3 torque = vector(p, 7, 3);
  // It still breathes a little: what the mean over 0.1 s differs from the weight by is its change of
  // momentum, which is exact (above); 1 % of the weight over 0.1 s is a change of 1 cm/s.
  EXPECT_NEAR(force.y(), -weight, 0.01 * weight);
  EXPECT_NEAR(force.x(), 0, 0.01 * weight);
  // Force acts under the block's middle: x_block - x_about = 0.05 m, so M_z = -0.05 m g. 3 %: the lattice
  // fixes the middle to a quarter of the distance of points.
  EXPECT_NEAR(torque.z(), -0.05 * weight, 0.03 * 0.05 * weight);
  EXPECT_NEAR(torque.x(), 0, 0.03 * 0.05 * weight);
}

constexpr const char* kAll =
    R"({"type": "force", "name": "plate", "obstacle": "plate", "interval": 0.0033}, {"type": "walls", "name": "box"},
       {"type": "point", "name": "inside", "at": [0.2, 0.15, 0], "interval": 0.004},
       {"type": "point", "name": "on the plate", "at": [0.2, 0.12, 0], "obstacle": "plate"},
       {"type": "plane", "name": "gate", "point": [0.2, 0.14, 0], "interval": 0.01},
       {"type": "plane", "name": "disc", "point": [0.2, 0.14, 0], "radius": 0.03},
       {"type": "plane", "name": "slot", "point": [0.2, 0.14, 0], "along": [1, 0, 0], "size": [0.04, 0.2]})";

std::vector<Override> moving_plate(const char* precision) {
  return {{"/numerics/precision", precision},
          {"/domain/periodic", "[true, false, false]"},
          {"/obstacles/0/motion", R"({"type": "linear", "velocity": [0, 0.1, 0]})"}};
}

TEST(Probes, DoNotChangeTheRun) {
  for (const char* precision : {"float", "double"}) {
    const Report with = run(block_scene(kAll), moving_plate(precision));
    const Report without = run(block_scene(""), moving_plate(precision));
    EXPECT_EQ(with.steps, without.steps);
    for (std::size_t f = 0; f < with.frames.size(); ++f)
      EXPECT_EQ(with.frames[f].fingerprint, without.frames[f].fingerprint) << f;
    EXPECT_TRUE(without.probes.empty());
  }
}

TEST(Probes, AreBitEqualForAnyNumberOfThreadsAndAfterRestoring) {
  for (const char* precision : {"float", "double"}) {
    const Plan plan = make_plan(parse_scene(block_scene(kAll), "", moving_plate(precision)));
    const auto go_on = [](const Progress&) { return true; };
    const auto whole = Simulation::create(plan, 1);
    for (int f = 1; f <= 2; ++f) whole->step_to_frame(f, go_on);
    int left = 7;  // within an interval of every probe
    whole->step_to_frame(3, [&](const Progress&) { return --left > 0; });
    const std::string saved = whole->save();
    for (int f = 3; f <= 4; ++f) whole->step_to_frame(f, go_on);
    const auto resumed = Simulation::create(plan, 3);
    resumed->restore(saved);
    for (int f = 3; f <= 4; ++f) resumed->step_to_frame(f, go_on);
    const auto threads = Simulation::create(plan, 4);
    for (int f = 1; f <= 4; ++f) threads->step_to_frame(f, go_on);
    for (std::size_t p = 0; p < plan.scene.probes.size(); ++p) {
      const ProbeSeries& expected = whole->report().probes[p];
      EXPECT_FALSE(expected.times.empty());
      for (const auto* other : {resumed.get(), threads.get()}) {
        EXPECT_EQ(other->report().probes[p].times, expected.times) << expected.name;
        EXPECT_EQ(other->report().probes[p].values, expected.values) << expected.name;
      }
    }
  }
}

TEST(Probes, SampleAtTheFirstStepAtOrAfterTheirTimes) {
  const Report r = run(block_scene(kAll), {});
  const ProbeSeries& p = series(r, "plate");
  // Every 3.3 ms with steps of 1 ms: at the steps' ends 4, 7, 10, 14, … ms; in all floor(200/3.3) = 60.
  ASSERT_EQ(p.times.size(), 60U);
  for (std::size_t i = 0; i < p.times.size(); ++i)
    EXPECT_NEAR(p.times[i], 1e-3 * std::ceil(3.3 * static_cast<double>(i + 1) - 1e-6), 1e-9);
  EXPECT_EQ(series(r, "inside").times.size(), 51U);  // at t = 0, too
  EXPECT_EQ(series(r, "gate").times.size(), 20U);
}

TEST(Probes, FluxTimesTimeIsTheMassThatHasPassedAndWhatIsAboveIsMissing) {
  // The block falls freely through the plane y = 0.14 m and lands on nothing.
  const Report r = run(block_scene(kAll), {{"/obstacles/0/shape/translate", "[0.2, -0.2, 0]"}});
  const ProbeSeries& gate = series(r, "gate");
  const double m = r.frames[0].mass;
  double passed = 0;
  double before = 0;
  for (std::size_t i = 0; i < gate.times.size(); ++i) {
    passed += value(gate, i, 0) * (gate.times[i] - before);
    before = gate.times[i];
    // All are multiples of the mass of a point: equal to the rounding of sums.
    EXPECT_NEAR(value(gate, i, 1), passed, 1e-12 * m);
    EXPECT_NEAR(m + value(gate, i, 1), value(gate, i, 2), 1e-9 * m);
  }
  EXPECT_NEAR(passed, -m, 1e-9 * m);
  // Midway the plane cuts the block: 0.1 m x 0.1 m, to a layer of points at either side that the tent blurs.
  double widest = 0;
  for (std::size_t i = 0; i < gate.times.size(); ++i) widest = std::max(widest, value(gate, i, 3));
  EXPECT_NEAR(widest, 0.01, 0.0005);
  // The disc takes its share of the columns of points, the slot 4/10: each 3 % of a column's quarter.
  const ProbeSeries& disc = series(r, "disc");
  const ProbeSeries& slot = series(r, "slot");
  EXPECT_NEAR(value(disc, 3, 1) / -m, std::numbers::pi * 0.0009 / 0.01, 0.05);
  EXPECT_NEAR(value(slot, 3, 1) / -m, 0.4, 0.11);  // 3 or 4 of 8 columns and drift
}

TEST(Probes, APointInStaticMaterialReadsItsDensityAndVelocity) {
  const std::string probe = R"({"type": "point", "name": "inside", "at": [0.21, 0.205, 0]},
                               {"type": "point", "name": "outside", "at": [0.05, 0.35, 0]})";
  for (const int dimension : {2, 3}) {
    const Report r = run(block_scene(probe), {{"/gravity", "[0, 0, 0]"},
                                              {"/dimension", std::to_string(dimension)},
                                              {"/bodies/0/velocity", "[0.5, -0.25, 0]"},
                                              {"/duration", "0.05"}});
    const ProbeSeries& p = series(r, "inside");
    // Tents sum to 1 over a lattice of half their width: exact but for single precision (1e-5 after 50
    // steps).
    EXPECT_NEAR(value(p, 0, 0), 0.5, 1e-6);
    EXPECT_NEAR(value(p, 0, 1), -0.25, 1e-6);
    EXPECT_NEAR(value(p, 0, 3), 500, 500 * 1e-5);
    EXPECT_NEAR(value(p, 0, 4), 1, 1e-5);
    EXPECT_NEAR(value(p, 0, 5), 0, 1e-9);
    EXPECT_NEAR(value(p, 1, 3), 500, 500 * 1e-3);
    for (std::size_t c = 0; c < 7; ++c) EXPECT_EQ(value(series(r, "outside"), 1, c), 0.0);
  }
}

TEST(Probes, APointUnderAHeapReadsItsPressure) {
  // A layer 0.15 m high without sides, at rest after damping: the pressure carries what lies above.
  const std::string probe =
      R"({"type": "point", "name": "deep", "at": [0.05, 0.05, 0.05]},
         {"type": "plane", "name": "level", "point": [0.05, 0.05, 0.05]})";
  const Report r = run(block_scene(probe), {{"/domain/min", "[0, 0, 0]"},
                                            {"/domain/max", "[0.1, 0.2, 0.1]"},
                                            {"/domain/periodic", "[true, false, true]"},
                                            {"/obstacles", "[]"},
                                            {"/materials/0/shear_modulus", "1"},
                                            {"/bodies/0/velocity", "[0, 0, 0]"},
                                            {"/bodies/0/shape/size", "[0.1, 0.15, 0.1]"},
                                            {"/bodies/0/shape/translate", "[0.05, 0.075, 0.05]"},
                                            {"/numerics/flip_blend", "0.5"},
                                            {"/numerics/flip_blend_reference_step", "1e-3"},
                                            {"/duration", "1"}});
  const ProbeSeries& p = series(r, "deep");
  // What lies above the level weighs on 0.01 m^2. 6 %: a layer of points, 12.5 mm of 0.1 m, counts wholly or
  // not at all, so that the sum is off by half of a layer at most.
  const ProbeSeries& level = series(r, "level");
  const double above = value(level, level.times.size() - 1, 2);
  EXPECT_NEAR(value(p, p.times.size() - 1, 5), above * 9.81 / 0.01, 0.06 * 490);
  EXPECT_LT(value(p, p.times.size() - 1, 6), 20);
}

TEST(Probes, BesideASlipWallPressureIsReadHighThenLowAndItsMeanIsRight) {
  // A column of liquid 8 cells wide between slip walls, at rest. No kernel reaches into a wall, so that the
  // first free node beside it misses a sixth of the pressure on its wall side; see docs/probes.md.
  std::string probes;
  for (int i = 0; i < 8; ++i)  // the middles of the cells
    probes += std::string(i > 0 ? "," : "") + R"({"type": "point", "name": ")" + std::to_string(i) +
              R"(", "at": [)" + std::to_string(0.025 * (i + 0.5)) + ", 0.1]}";
  const Report r = run(block_scene(probes), {{"/dimension", "2"},
                                             {"/domain/min", "[0, 0]"},
                                             {"/domain/max", "[0.2, 0.3]"},
                                             {"/gravity", "[0, -9.81]"},
                                             {"/obstacles", "[]"},
                                             {"/materials/0/bulk_modulus", "2e5"},
                                             {"/materials/0/shear_modulus", "300"},
                                             {"/materials/0/yield_stress", "2"},
                                             {"/materials/0/viscosity", "5"},
                                             {"/materials/0/flow_index", "1"},
                                             {"/bodies/0/velocity", "[0, 0]"},
                                             {"/bodies/0/shape", R"({"type": "box", "size": [0.2, 0.2, 1],
                                                                     "translate": [0.1, 0.1, 0]})"},
                                             {"/numerics/flip_blend", "0.5"},
                                             {"/numerics/flip_blend_reference_step", "1e-3"},
                                             {"/numerics/time_step", "4e-4"},
                                             {"/duration", "1"}});
  std::vector<double> pressure;  // over the hydrostatic
  for (int i = 0; i < 8; ++i) {
    const ProbeSeries& p = series(r, std::to_string(i));
    pressure.push_back(value(p, p.times.size() - 1, 5) / (500 * 9.81 * 0.1));
  }
  const double mean = std::accumulate(pressure.begin(), pressure.end(), 0.0) / 8;
  // The mean over the width carries the weight above. 2 %: it sways by 1 % yet, and is compressed by 0.5 %.
  EXPECT_NEAR(mean, 1, 0.02);
  for (const std::size_t wall : {0U, 7U}) EXPECT_NEAR(pressure[wall] / mean, 1.15, 0.05);
  for (std::size_t i = 1; i < 7; ++i) EXPECT_NEAR(pressure[i] / mean, 0.95, 0.03) << i;
}

TEST(Probes, CsvHoldsEveryValueUnderItsNameAndUnit) {
  const Report r = run(block_scene(R"({"type": "walls", "name": "a, \"b\""})"), {{"/duration", "0.1"}});
  const std::string csv = probes_csv(r.probes);
  EXPECT_EQ(csv.rfind("probe,quantity,unit,time,value\n", 0), 0U);
  EXPECT_NE(csv.find("\"a, \"\"b\"\"\",force_x,N,0.05,"), std::string::npos) << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6 * 2);
  EXPECT_NE(to_json(r).find("\"torque_z\""), std::string::npos);
}

}  // namespace
}  // namespace lather
