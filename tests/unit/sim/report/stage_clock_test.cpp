// What of a step runs on one thread alone: bounds that hold however long the machine lets a thread wait.

#include "sim/report/stage_clock.h"

#include <gtest/gtest.h>

#include <thread>

namespace lather {
namespace {

constexpr double kPause = 5e-3;  // s

void pause() {
  std::this_thread::sleep_for(std::chrono::duration<double>(kPause));
}

class StageClocks : public testing::TestWithParam<int> {};

TEST_P(StageClocks, TellWhatRunsAloneFromWhatIsShared) {
  const int threads = GetParam();
  StageClock clock(threads);
  clock.time(Stage::kSort, [&] {
    pause();
    parallel_for(threads, threads, 1, [](std::int64_t) { pause(); });
  });
  EXPECT_GE(clock.serial_seconds(Stage::kSort), kPause);
  EXPECT_GE(clock.seconds(Stage::kSort) - clock.serial_seconds(Stage::kSort), kPause);
}

TEST_P(StageClocks, FindNothingAloneInALoop) {
  const int threads = GetParam();
  StageClock clock(threads);
  parallel_for(threads, 2, 1, [&](std::int64_t) { clock.time(Stage::kRasterize, pause); });
  EXPECT_GE(clock.seconds(Stage::kRasterize), 2 * kPause);
  EXPECT_EQ(clock.serial_seconds(Stage::kRasterize), 0);
}

TEST_P(StageClocks, CountALoopWithinALoopOnce) {
  const int threads = GetParam();
  const auto start = std::chrono::steady_clock::now();
  const double before = ParallelTime::seconds();
  parallel_for(threads, 1, 1, [&](std::int64_t) {
    EXPECT_TRUE(ParallelTime::inside());
    parallel_for(1, 2, 1, [](std::int64_t) { pause(); });
  });
  const double in_loops = ParallelTime::seconds() - before;
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_FALSE(ParallelTime::inside());
  EXPECT_GE(in_loops, 2 * kPause);
  EXPECT_LE(in_loops, took.count());
}

INSTANTIATE_TEST_SUITE_P(OnThreads, StageClocks, testing::Values(1, 2));

}  // namespace
}  // namespace lather
