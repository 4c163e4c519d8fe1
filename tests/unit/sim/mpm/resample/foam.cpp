#include "tests/unit/sim/mpm/resample/foam.h"

#include "sim/plan/planned_fields.h"

namespace lather::testing_support {
namespace {

Plan plan_of(int dimension, bool periodic, const char* tear_threshold_of_a) {
  return make_plan(parse_scene(
      R"({"lather": 1, "domain": {"min": [-24, -24, -24], "max": [24, 24, 24], "periodic": [true, false, false]},
    "duration": 1, "spacing": 2, "gravity": [0, 0, 0],
    "materials": [{"name": "a", "preset": "shaving-cream"}, {"name": "b", "preset": "oobleck"}],
    "bodies": [{"name": "a", "material": "a", "shape": {"type": "sphere", "radius": 3}}],
    "numerics": {"precision": "double", "transfer": "apic", "resampling": {}}})",
      "",
      {{"/dimension", std::to_string(dimension)},
       {"/domain/periodic/0", periodic ? "true" : "false"},
       {"/materials/0/tear_threshold", tear_threshold_of_a},
       {"/materials/1/tear_threshold", "1"}}));
}

}  // namespace

Foam::Foam(int dimension, bool periodic) : Foam(dimension, periodic, "217.5") {}

Foam::Foam(int dimension, bool periodic, const char* tear_threshold_of_a)
    : dimension_(dimension),
      model_(std::make_unique<mpm::Model<double>>(plan_of(dimension, periodic, tear_threshold_of_a))),
      grid_(dimension, true) {
  const Scene& scene = model_->scene;
  for (int s = 0; s < 2; ++s)
    sets.emplace_back(dimension, planned_fields(scene, scene.materials[static_cast<std::size_t>(s)]),
                      scene.domain.box.min, scene.spacing);
  resampler = model_->resampler;
  resampler.allowed = [](const Vec3&) { return true; };
}

void Foam::add(const Vec3& x, std::size_t set, const Vec3& v) {
  sets[set].add(x, v, Mat3::Zero(), next_id++);
}

void Foam::sort() {
  std::vector<const std::vector<BlockRange>*> ranges;
  for (auto& set : sets) {
    set.sort(model_->bounds, 1);
    ranges.push_back(&set.ranges());
  }
  grid_.rebuild(ranges, model_->bounds, 1);
}

mpm::resample::PointBins Foam::bins() {
  sort();
  return {sets, grid_, model_->bounds, resampler.lattice, resampler.threads};
}

mpm::resample::Outcome Foam::avoid_void(std::uint64_t step) {
  sort();
  return mpm::resample::avoid_void(sets, grid_, resampler, {1, step}, next_id);
}

std::vector<Vec3> Foam::positions(std::size_t set) const {
  std::vector<Vec3> all;
  for (std::size_t t = 0; t < sets[set].tiles(); ++t)
    for (int lane = 0; lane < kTile; ++lane)
      if (sets[set].values<std::uint32_t>(t, Field::kId)[lane] != kNoPoint)
        all.push_back(sets[set].position(t, lane));
  return all;
}

double Foam::shares(std::size_t set) const {
  double sum = 0;
  for (std::size_t t = 0; t < sets[set].tiles(); ++t)
    for (int lane = 0; lane < kTile; ++lane)
      if (sets[set].values<std::uint32_t>(t, Field::kId)[lane] != kNoPoint) sum += sets[set].share(t, lane);
  return sum;
}

Vec3 Foam::momentum() const {
  Vec3 sum = Vec3::Zero();
  for (const auto& set : sets)
    for (std::size_t t = 0; t < set.tiles(); ++t)
      for (int lane = 0; lane < kTile; ++lane)
        if (set.values<std::uint32_t>(t, Field::kId)[lane] != kNoPoint)
          sum += set.share(t, lane) * set.velocity(t, lane);
  return sum;
}

}  // namespace lather::testing_support
