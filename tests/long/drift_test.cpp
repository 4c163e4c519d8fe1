// A million steps of what stays as it is: a block at rest, and foam that is slowly sheared. What drifts, and
// by how much.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "sim/plan/plan.h"
#include "sim/simulation.h"

namespace lather {
namespace {

constexpr int kFrames = 100;
constexpr double kSteps = 1e6;

/// An elastic block, eight spacings wide, on the floor of its domain; runs for kSteps planned steps.
const char* const kBlock = R"({
  "lather": 1, "dimension": 2, "spacing": 0.01, "duration": 1, "frame_rate": 1,
  "domain": {"min": [0, 0], "max": [0.16, 0.16], "boundary": "stick"},
  "materials": [{"name": "jelly", "model": "neo-hookean", "density": 1000, "youngs_modulus": 1e5,
                 "poisson_ratio": 0.3, "viscosity": 50}],
  "bodies": [{"name": "block", "material": "jelly",
              "shape": {"type": "box", "size": [0.08, 0.08], "translate": [0.08, 0.04]}}]})";

/// Shaving cream between walls eight spacings apart, sheared by 3 in all.
const char* const kFoam = R"({
  "lather": 1, "dimension": 2, "spacing": 0.01, "duration": 1, "frame_rate": 1, "gravity": [0, 0],
  "domain": {"min": [-0.08, -0.08], "max": [0.08, 0.08], "periodic": [true, false, false]},
  "materials": [{"name": "foam", "preset": "shaving-cream", "tear_threshold": "infinity"}],
  "bodies": [{"name": "slab", "material": "foam", "shape": {"type": "box", "size": [0.2, 0.12]}}],
  "obstacles": [
    {"name": "upper wall", "adhesive": true, "shape": {"type": "box", "size": [1, 0.04], "translate": [0, 0.06]}},
    {"name": "lower wall", "adhesive": true,
     "shape": {"type": "box", "size": [1, 0.04], "translate": [0, -0.06]}}]})";

Report run_a_million_steps(const char* document, std::vector<Override> changes, double shear) {
  const Plan plan = make_plan(parse_scene(document, "", changes));
  const double duration = kSteps * plan.time_step;
  changes.push_back({"/duration", std::to_string(duration)});
  changes.push_back({"/frame_rate", std::to_string(kFrames / duration)});
  if (shear > 0)
    changes.push_back({"/obstacles/0/motion", R"({"type": "linear", "velocity": [)" +
                                                  std::to_string(shear * 0.08 / duration) + ", 0]}"});
  const auto simulation = Simulation::create(make_plan(parse_scene(document, "", changes)), 1);
  for (int i = 0; i <= kFrames; ++i) simulation->step_to_frame(i, [](const Progress&) { return true; });
  return simulation->report();
}

double elastic(const FrameMeasure& f) {
  return f.elastic_volume_energy + f.elastic_shear_energy;
}

/// What the frames after `first` span: elastic energy over its mean there, centre of mass and extent of the
/// points over `length`, volume ratio.
struct Drift {
  double energy = 0;
  double kinetic = 0;  ///< the most, over the mean elastic energy
  double place = 0;
  double height = 0;
  double mass = 0;  ///< over that at the start
};

Drift drift_of(const Report& r, int first, double length) {
  Drift d;
  double mean = 0;
  for (int i = first; i <= kFrames; ++i)
    mean += elastic(r.frames[static_cast<std::size_t>(i)]) / (kFrames - first + 1);
  const FrameMeasure& from = r.frames[static_cast<std::size_t>(first)];
  for (int i = first; i <= kFrames; ++i) {
    const FrameMeasure& f = r.frames[static_cast<std::size_t>(i)];
    d.energy = std::max(d.energy, std::abs(elastic(f) - elastic(from)) / mean);
    d.kinetic = std::max(d.kinetic, f.kinetic_energy / mean);
    d.place = std::max(d.place, std::abs(f.center_of_mass.y() - from.center_of_mass.y()) / length);
    d.height = std::max(d.height, std::abs(f.highest.y() - from.highest.y()) / length);
    d.mass = std::max(d.mass, std::abs(f.mass / r.frames.front().mass - 1));
  }
  std::printf("elastic energy, J:");
  for (int i = 0; i <= kFrames; i += kFrames / 10)
    std::printf(" %.4g", elastic(r.frames[static_cast<std::size_t>(i)]));
  std::printf("\n");
  std::printf("%llu steps: energy %.1e, kinetic %.1e, centre %.1e, height %.1e, mass %.1e\n",
              static_cast<unsigned long long>(r.steps), d.energy, d.kinetic, d.place, d.height, d.mass);
  return d;
}

class BlockAtRest : public testing::TestWithParam<std::vector<Override>> {};
TEST_P(BlockAtRest, StaysWhereItIs) {
  const Report r = run_a_million_steps(kBlock, GetParam(), 0);
  // The particles' block rings for a fifth of a million steps; the grid's is still after a tenth.
  const Drift d = drift_of(r, 25, 0.08);
  EXPECT_GE(r.steps, kSteps * 0.99);
  EXPECT_LT(d.mass, 1e-12);
  // Four times what was seen, of the particles' block: it creeps, the grid's does a thousandth of that.
  EXPECT_LT(d.energy, 8e-3);
  EXPECT_LT(d.kinetic, 1e-4);
  EXPECT_LT(d.place, 1e-3);
  EXPECT_LT(d.height, 1e-3);
}
INSTANTIATE_TEST_SUITE_P(Ways, BlockAtRest,
                         testing::Values(std::vector<Override>{{"/numerics/transfer", "flip"}},
                                         std::vector<Override>{{"/numerics/transfer", "apic"}},
                                         std::vector<Override>{{"/solver", "mlsrk"}}));

class FoamSlowlySheared : public testing::TestWithParam<std::vector<Override>> {};
TEST_P(FoamSlowlySheared, FlowsAsItBegan) {
  const Report r = run_a_million_steps(kFoam, GetParam(), 3);
  const Drift d = drift_of(r, 50, 0.08);
  EXPECT_GE(r.steps, kSteps * 0.99);
  EXPECT_LT(d.mass, 1e-12);
  // Rows of points pass the grid's nodes and one another: a few percent of the energy, to and fro.
  EXPECT_LT(d.energy, 0.1);
  EXPECT_LT(d.kinetic, 1e-3);
  // Nothing pushes up or down.
  EXPECT_LT(d.place, 1e-6);
  EXPECT_LT(d.height, 1e-6);
}
INSTANTIATE_TEST_SUITE_P(Ways, FoamSlowlySheared,
                         testing::Values(std::vector<Override>{{"/numerics/transfer", "flip"}},
                                         std::vector<Override>{{"/numerics/transfer", "apic"}}));

}  // namespace
}  // namespace lather
