// Standard cases of speed: that they run, and what their result says. How fast they are is nobody's to test.

#include "sim/study/bench/bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "sim/scene/value.h"
#include "sim/simulation.h"
#include "sim/study/bench/papers.h"
#include "sim/study/bench/trends.h"

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
    double serial = 0;
    for (const StageShare& s : r.stages) {
      all += s.share;
      serial += s.serial;
      EXPECT_GE(s.serial, 0);
    }
    EXPECT_NEAR(all, 1, 1e-12);
    EXPECT_LE(serial, r.serial_share + 1e-9);
    EXPECT_LE(r.serial_share, 1);
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
  EXPECT_TRUE(runs("mpm/cubic/apic/semi-implicit/float", "solve velocities"));
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

BenchResult result_of(const std::string& name, std::uint64_t points, int threads, double rate) {
  BenchResult r;
  r.name = name;
  r.points = points;
  r.threads = threads;
  r.point_steps_per_second = r.slowest = r.fastest = rate;
  return r;
}

// Two threads at 1.9 times the speed; a step of 100 times the points in 100^1.5 times the time.
TEST(Bench, TrendsAreThoseOfTheResults) {
  const std::vector<BenchResult> results = {
      result_of("some/case", 100, 1, 10), result_of("some/case", 1000, 1, 10 / std::sqrt(10.0)),
      result_of("some/case", 10000, 1, 1), result_of("some/case", 100, 2, 19), result_of("other", 100, 2, 5)};
  const std::vector<Speedup> faster = speedups(results);
  ASSERT_EQ(faster.size(), 1U);
  EXPECT_EQ(faster.front().name, "some/case");
  EXPECT_EQ(faster.front().threads, 2);
  EXPECT_DOUBLE_EQ(faster.front().speedup, 1.9);
  const std::vector<Growth> growing = growths(results);
  ASSERT_EQ(growing.size(), 1U);
  EXPECT_EQ(growing.front().from, 100U);
  EXPECT_EQ(growing.front().to, 10000U);
  EXPECT_NEAR(growing.front().exponent, 1.5, 1e-12);
}

TEST(Bench, SizesThatShowGrowthAreThoseOfCasesAndGrow) {
  for (const ScalingCase& c : scaling_cases()) {
    EXPECT_EQ(case_named(c.name).name, c.name);
    EXPECT_GE(c.points.size(), 3U);
    EXPECT_TRUE(std::is_sorted(c.points.begin(), c.points.end()));
  }
}

// A frame every three steps, so that rounds cross frames.
TEST(Bench, FramesDoNotEndARound) {
  BenchCase bench{"short frames", [](std::uint64_t points) {
                    Scene scene = case_named("mpm/quadratic/flip/herschel-bulkley/float").scene(points);
                    scene.frame_rate = 1 / (3 * scene.numerics.time_step);
                    return scene;
                  }};
  bench.steps = 7;
  const BenchResult r = quick_run(bench);
  EXPECT_EQ(r.steps, 5U * 7U);
  EXPECT_GT(r.slowest, 0);
}

constexpr const char* kPaperList = R"({"scenes": [
  {"name": "a", "scene": "a.json", "machine": "m", "frame_rate": 30, "time_step": 1e-5, "start": 0.05,
   "seconds_per_frame": [60, 90]},
  {"name": "b", "scene": "b.json", "machine": "m", "frame_rate": 48, "time_step": 1e-4, "seconds_per_frame": null,
   "set": ["/solver=mpm"]}]})";

TEST(Bench, ScenesOfPapersAreReadWithWhatIsPrinted) {
  const std::vector<PaperScene> papers = read_paper_scenes(kPaperList);
  ASSERT_EQ(papers.size(), 2U);
  EXPECT_EQ(papers[0].least, 60);
  EXPECT_EQ(papers[0].most, 90);
  EXPECT_FALSE(papers[1].most);
  EXPECT_EQ(papers[0].start, 0.05);
  EXPECT_EQ(papers[1].start, 0);
  EXPECT_EQ(papers[1].set, std::vector<std::string>{"/solver=mpm"});
  const auto refused = [](const char* list) {
    try {
      (void)read_paper_scenes(list);
      return std::string();
    } catch (const InputError& error) {
      return error.problems().front().pointer;
    }
  };
  EXPECT_EQ(refused(R"({"scenes": [{"name": 3}]})"), "/scenes/0/name");
  EXPECT_EQ(refused(R"({"scenes": [{"name": "a", "scene": "a", "machine": "m", "frame_rate": 0}]})"),
            "/scenes/0/frame_rate");
  EXPECT_EQ(refused(R"({"scenes": 3})"), "/scenes");
}

// 2000 steps of 1000 points to a frame of 1/50 s, at a million point-steps a second.
TEST(Bench, AFrameOfAPaperTakesAllItsPointsThroughAllItsSteps) {
  PaperRun run;
  run.paper.frame_rate = 50;
  run.time_step = 1e-5;
  run.result = result_of("a", 1000, 1, 1e6);
  EXPECT_DOUBLE_EQ(run.steps_per_frame(), 2000);
  EXPECT_DOUBLE_EQ(run.seconds_per_frame(), 2);
  EXPECT_EQ(write_json(*at_pointer(to_json({run}), "/0/printed")), "null");
}

TEST(Bench, ARoundOfAPapersSceneIsOneIntervalOfResampling) {
  Scene scene = case_named("mpm/cubic/flip/resampling/float").scene(1000);
  const double interval = scene.numerics.resampling->interval;
  EXPECT_EQ(paper_case({}, scene).steps, 50);
  PaperScene later;
  later.start = 1;
  scene.numerics.time_step /= 4;
  EXPECT_EQ(paper_case(later, scene).steps, 200);
  EXPECT_NEAR(paper_case(later, scene).scene(0).numerics.resampling->interval, 4 * interval, 1e-9 * interval);
  scene.numerics.resampling.reset();
  EXPECT_EQ(paper_case({}, scene).steps, 0);
}

TEST(Bench, TheJsonHoldsWhatWasMeasured) {
  BenchResult r;
  r.name = "some/case";
  r.points = 10;
  r.threads = 2;
  r.point_steps_per_second = 5;
  r.memory_bytes = 4000;
  r.stages = {{"sort", 0.25, 0.125}, {"rasterize", 0.75}};
  r.serial_share = 0.5;
  BenchResult one = r;
  one.threads = 1;
  one.fastest = 4;
  r.fastest = 6;
  const Value json = to_json({4, 2, 8, 1}, KernelLevel::kV3, {r, one});
  const auto at = [&](const char* pointer) { return write_json(*at_pointer(json, pointer)); };
  EXPECT_EQ(at("/machine/fma_gflops"), "4");
  EXPECT_EQ(at("/machine/fma_gflops_double"), "2");
  EXPECT_EQ(at("/machine/l2_gbs"), "8");
  EXPECT_EQ(at("/machine/dram_gbs"), "1");
  EXPECT_EQ(at("/machine/kernel_level"), "\"x86-64-v3\"");
  EXPECT_EQ(at("/cases/0/name"), "\"some/case\"");
  EXPECT_EQ(at("/cases/0/threads"), "2");
  EXPECT_EQ(at("/cases/0/point_steps_per_second"), "5");
  EXPECT_EQ(at("/cases/0/memory_bytes"), "4000");
  EXPECT_EQ(at("/cases/0/stages/rasterize"), "0.75");
  EXPECT_EQ(at("/cases/0/serial_share"), "0.5");
  EXPECT_EQ(at("/cases/0/serial_stages"), R"({"sort":0.125})");
  EXPECT_EQ(at("/speedups/0/speedup"), "1.5");
  EXPECT_EQ(at("/growths"), "[]");
}

}  // namespace
}  // namespace lather::study
