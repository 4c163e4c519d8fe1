// An empty domain costs nothing: what is allocated follows the points, wherever the domain ends.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/mlsrk/cloud.h"
#include "sim/mpm/step.h"
#include "sim/plan/planned_fields.h"
#include "sim/plan/seed.h"
#include "sim/plan/void_search.h"
#include "sim/study/bench/bench.h"

namespace lather::study {
namespace {

constexpr std::uint64_t kPoints = 4096;

Scene scene_of(const std::string& name) {
  return std::find_if(bench_cases().begin(), bench_cases().end(),
                      [&](const BenchCase& c) { return c.name == name; })
      ->scene(kPoints);
}

/// What a body takes.
struct Taken {
  std::size_t point_blocks = 0;
  std::size_t grid_blocks = 0;
  std::size_t tiles = 0;
  std::size_t point_bytes = 0;
  std::size_t solver_bytes = 0;
  bool operator==(const Taken&) const = default;
};

std::vector<ParticleSet<float>> seeded(const Scene& scene) {
  std::vector<ParticleSet<float>> sets;
  sets.emplace_back(scene.dimension, planned_fields(scene, scene.materials.front()), scene.domain.box.min,
                    scene.spacing);
  seed_points(scene,
              [&](const Seed& s) { sets.front().add(s.position, s.velocity, s.velocity_gradient, s.id); });
  return sets;
}

Taken taken_on_a_grid(const Scene& scene) {
  const mpm::Model<float> model(make_plan(scene));
  mpm::State<float> state;
  state.sets = seeded(scene);
  mpm::Stepper<float> stepper(model, 1);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(stepper.step(state, scene.numerics.time_step).extremes.finite);
  return {stepper.grid().point_blocks().size(), stepper.grid().grid_blocks().size(),
          state.sets.front().tiles(), state.sets.front().bytes(), stepper.bytes()};
}

Taken taken_by_particles(const Scene& scene) {
  std::vector<ParticleSet<float>> sets = seeded(scene);
  (void)sets.front().sort(cell_bounds(scene), 1);
  mlsrk::Cloud<float> cloud(scene);
  cloud.build(sets, cell_bounds(scene));
  return {sets.front().ranges().size(), 0, cloud.tiles().size(), sets.front().bytes(), cloud.bytes()};
}

/// The share of the domain's cells that a body of kPoints fills, 8 points to a cell.
double filled_share(const Scene& scene) {
  const double cells = scene.domain.box.extent().prod() / std::pow(scene.spacing, 3);
  return static_cast<double>(kPoints) / 8 / cells;
}

TEST(EmptyDomain, TakesNoBlockAndNoByteOfTheGrid) {
  const Scene small = scene_of("mpm/cubic/flip/herschel-bulkley/float");
  const Scene huge = scene_of("mpm/cubic/flip/huge-domain/float");
  ASSERT_GT(filled_share(small), 0.1);
  ASSERT_LT(filled_share(huge), 1e-10);
  const Taken taken = taken_on_a_grid(small);
  EXPECT_EQ(taken, taken_on_a_grid(huge));
  EXPECT_GE(taken.point_blocks, kPoints / 512);           // a block has 64 cells
  EXPECT_LE(taken.grid_blocks, 27 * taken.point_blocks);  // itself and what lies around it
}

// On a lattice: jitter depends on a point's place in the domain.
TEST(EmptyDomain, TakesNoTileAndNoByteOfTheCloud) {
  Scene small = scene_of("mlsrk/tensor-3/neo-hookean/float");
  Scene huge = scene_of("mlsrk/tensor-3/huge-domain/float");
  small.jitter = huge.jitter = 0;
  const Taken taken = taken_by_particles(small);
  EXPECT_EQ(taken, taken_by_particles(huge));
  EXPECT_GE(taken.tiles, kPoints / kTile);
}

// The search for voids takes the box around the points, however far these spread, up to a limit.
TEST(EmptyDomain, IsExpectedToTakeTheSearchForVoidsAtMost) {
  const std::uint64_t small = make_plan(scene_of("mpm/cubic/flip/herschel-bulkley/float")).memory_bytes;
  const std::uint64_t huge = make_plan(scene_of("mpm/cubic/flip/huge-domain/float")).memory_bytes;
  EXPECT_LE(huge, small + static_cast<std::uint64_t>(kMostSearchedCells));
}

}  // namespace
}  // namespace lather::study
