// Standard cases of speed: that they run, and what their result says. How fast they are is nobody's to test.

#include "sim/study/bench/bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/scene/value.h"
#include "sim/simulation.h"

namespace lather::study {
namespace {

const BenchCase& case_named(const std::string& name) {
  return *std::find_if(bench_cases().begin(), bench_cases().end(),
                       [&](const BenchCase& c) { return c.name == name; });
}

BenchResult quick_run(const BenchCase& bench) {
  return run_bench(bench, BenchRequest{1000, 1, best_kernel_level(), 0.001});
}

TEST(Bench, HasEachCaseOnce) {
  std::set<std::string> names;
  for (const BenchCase& c : bench_cases()) EXPECT_TRUE(names.insert(c.name).second) << c.name;
  EXPECT_GT(names.size(), 15U);
}

TEST(Bench, EveryCaseStepsAndSharesItsTimeAmongItsStages) {
  for (const BenchCase& c : bench_cases()) {
    SCOPED_TRACE(c.name);
    const BenchResult r = quick_run(c);
    EXPECT_EQ(r.name, c.name);
    EXPECT_NEAR(static_cast<double>(r.points), 1000, 100);
    EXPECT_EQ(r.threads, 1);
    EXPECT_GE(r.steps, 5U);
    EXPECT_GT(r.slowest, 0);
    EXPECT_LE(r.slowest, r.point_steps_per_second);
    EXPECT_LE(r.point_steps_per_second, r.fastest);
    EXPECT_GT(r.bytes_per_point, 20);
    double all = 0;
    for (const StageShare& s : r.stages) all += s.share;
    EXPECT_NEAR(all, 1, 1e-12);
  }
}

// What a case is named for has to happen in it.
TEST(Bench, TheCasesOfAStageRunIt) {
  const auto runs = [](const char* name, const char* stage) {
    const BenchResult r = quick_run(case_named(name));
    return std::any_of(r.stages.begin(), r.stages.end(),
                       [&](const StageShare& s) { return s.name == stage; });
  };
  EXPECT_TRUE(runs("mpm/cubic/flip/resampling/float", "avoid a void"));
  EXPECT_TRUE(runs("mpm/cubic/flip/tearing/float", "detect tearing"));
  EXPECT_TRUE(runs("mpm/cubic/flip/obstacles/float", "grid collisions"));
  EXPECT_TRUE(runs("mlsrk/tensor-3/phases/float", "phases"));
  EXPECT_FALSE(runs("mpm/cubic/flip/herschel-bulkley/float", "avoid a void"));
  EXPECT_FALSE(runs("mlsrk/tensor-3/neo-hookean/float", "phases"));
}

// Each round has as many resamplings as any other: one in 50 steps.
TEST(Bench, ARoundOfTheCaseThatResamplesIsOneInterval) {
  EXPECT_EQ(quick_run(case_named("mpm/cubic/flip/resampling/float")).steps, 5U * 50U);
}

TEST(Bench, TheFoamOfTheCasesYieldsEverywhere) {
  const Scene scene = case_named("mpm/cubic/flip/herschel-bulkley/float").scene(1000);
  const double yield_stress = scene.materials.front().herschel_bulkley().yield_stress;
  const auto simulation = Simulation::create(make_plan(scene), 1);
  int left = 10;
  simulation->step_to_frame(1, [&](const Progress&) { return --left > 0; });
  int points = 0;
  int yielding = 0;
  simulation->visit_points([&](const PointState& p) {
    const auto& s = p.stress;
    const double mean = (s[0] + s[1] + s[2]) / 3;
    const double squared = std::pow(s[0] - mean, 2) + std::pow(s[1] - mean, 2) + std::pow(s[2] - mean, 2) +
                           2 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
    ++points;
    if (squared > 2.0 / 3 * yield_stress * yield_stress) ++yielding;
  });
  EXPECT_GT(yielding, 0.95 * points);
}

TEST(Bench, AMachineDoesSomething) {
  const MachinePeak peak = measure_peak(KernelLevel::kV2);
  for (const double rate : {peak.fma_gflops, peak.fma_gflops_double, peak.l2_gbs, peak.dram_gbs}) {
    EXPECT_GT(rate, 0);
    EXPECT_TRUE(std::isfinite(rate));
  }
}

TEST(Bench, TheJsonHoldsWhatWasMeasured) {
  BenchResult r;
  r.name = "some/case";
  r.points = 10;
  r.threads = 2;
  r.point_steps_per_second = 5;
  r.stages = {{"sort", 0.25}, {"rasterize", 0.75}};
  const Value json = parse_json(to_json({4, 2, 8, 1}, KernelLevel::kV3, {r}));
  const auto at = [&](const char* pointer) { return write_json(*at_pointer(json, pointer)); };
  EXPECT_EQ(at("/machine/fma_gflops"), "4");
  EXPECT_EQ(at("/machine/fma_gflops_double"), "2");
  EXPECT_EQ(at("/machine/l2_gbs"), "8");
  EXPECT_EQ(at("/machine/dram_gbs"), "1");
  EXPECT_EQ(at("/machine/kernel_level"), "\"x86-64-v3\"");
  EXPECT_EQ(at("/cases/0/name"), "\"some/case\"");
  EXPECT_EQ(at("/cases/0/threads"), "2");
  EXPECT_EQ(at("/cases/0/point_steps_per_second"), "5");
  EXPECT_EQ(at("/cases/0/stages/rasterize"), "0.75");
}

}  // namespace
}  // namespace lather::study
