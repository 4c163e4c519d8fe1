#include <algorithm>
#include <memory>

#include "sim/mpm/step.h"
#include "sim/plan/planned_fields.h"
#include "sim/plan/seed.h"
#include "sim/plan/step_bound.h"
#include "sim/study/scene_parts.h"
#include "tests/bench/kernels/kernel_case.h"

namespace lather::bench {
namespace {

constexpr std::uint64_t kPoints = 4096;  // eight blocks of 512
constexpr int kSteps = 8;                // until the scene's foam yields
constexpr double kRate = 10;             // 1/s, of the shear that gather() and laws meet

/// The fullest block of a scene after a few steps.
template <class Real>
class Block {
 public:
  Block(const Scene& scene, KernelLevel level) : plan_(make_plan(scene, Choices{level})), model_(plan_) {
    mpm::State<Real> state;
    state.sets.emplace_back(scene.dimension, planned_fields(scene, scene.materials.front()),
                            scene.domain.box.min, scene.spacing);
    seed_points(scene, [&](const Seed& s) {
      state.sets.front().add(s.position, s.velocity, s.velocity_gradient, s.id);
    });
    mpm::Stepper<Real> stepper(model_, 1);
    const double dt = scene.numerics.time_step;
    for (int i = 0; i < kSteps; ++i) (void)stepper.step(state, dt);
    stepper.sort_when_drifted(state);

    const auto& ranges = state.sets.front().ranges();
    const auto fullest = std::max_element(ranges.begin(), ranges.end(),
                                          [](const auto& a, const auto& b) { return a.count < b.count; });
    const mpm::BlockPoints<Real> points = mpm::block_points(
        state.sets.front(), static_cast<std::int32_t>(fullest - ranges.begin()), model_.materials.front());
    layout_ = *points.layout;
    count_ = points.count;
    place_ = mpm::BlockGrid<Real>::place(fullest->block);
    const std::size_t tiles = (static_cast<std::size_t>(count_) + kTile - 1) / kTile;
    before_.assign(points.tiles, points.tiles + tiles * static_cast<std::size_t>(layout_.stride));
    tiles_.resize(before_.size() + kAlignment);
    step_ = {static_cast<Real>(dt), static_cast<Real>(scene.spacing), {}, Real(0), Real(0.25)};
    step_.flip = static_cast<Real>(flip_share(scene.numerics, dt));
    const auto reals = static_cast<std::size_t>(mpm::buffer_reals(scene.dimension));
    momentum_.assign(reals, Real(0));
    force_.assign(reals, Real(0));
    restore(before_.size());
  }

  [[nodiscard]] std::int64_t count() const { return count_; }

  void scatter() {
    std::fill(momentum_.begin(), momentum_.end(), Real(0));
    std::fill(force_.begin(), force_.end(), Real(0));
    model_.kernels.scatter(points(), place_, step_, momentum_.data(), force_.data());
  }

  /// The velocities that gather() meets: the shear v_x = rate y, a thousandth of it as this step's increment.
  void shear_grid() {
    for (int n = 0; n < mpm::power(mpm::kBufferWidth, 3); ++n) {
      const double y = n / mpm::kBufferWidth % mpm::kBufferWidth * static_cast<double>(step_.cell);
      momentum_[static_cast<std::size_t>(n * mpm::kQuad + 1)] = static_cast<Real>(kRate * y);
      force_[static_cast<std::size_t>(n * mpm::kQuad + 1)] = static_cast<Real>(1e-3 * kRate * y);
    }
  }
  void gather() {
    restore(before_.size());
    model_.kernels.gather(points(), place_, step_, momentum_.data(), force_.data());
  }

  void stress() {
    Real tau[6 * kTile];
    (void)first_tile().material->kernels.stress(first_tile(), tau);
  }
  void deform() {
    restore(static_cast<std::size_t>(layout_.stride));
    Real increment[9 * kTile] = {};
    std::fill_n(increment + kTile, kTile, step_.dt * static_cast<Real>(kRate));
    first_tile().material->kernels.deform(first_tile(), step_.dt, increment);
  }

 private:
  static constexpr std::size_t kAlignment = 64;  // of tiles, bytes

  [[nodiscard]] std::byte* tiles() {
    void* start = tiles_.data();
    std::size_t space = tiles_.size();
    return static_cast<std::byte*>(std::align(kAlignment, before_.size(), start, space));
  }
  /// So many bytes of the points as the run left them. A small part of what is measured.
  void restore(std::size_t bytes) { std::copy_n(before_.begin(), bytes, tiles()); }
  [[nodiscard]] mpm::BlockPoints<Real> points() {
    return {tiles(), count_, &layout_, &model_.materials.front()};
  }
  [[nodiscard]] mpm::PointTile<Real> first_tile() { return {tiles(), &layout_, &model_.materials.front()}; }

  Plan plan_;
  mpm::Model<Real> model_;
  TileLayout layout_;
  std::int32_t count_ = 0;
  mpm::BlockPlace place_{};
  mpm::StepConstants<Real> step_{};
  std::vector<std::byte> before_;
  std::vector<std::byte> tiles_;
  std::vector<Real> momentum_;
  std::vector<Real> force_;
};

template <class Real>
void add_transfers(std::vector<KernelCase>& cases) {
  for (const char* scheme : {"cubic/flip", "cubic/apic", "quadratic/flip", "quadratic/apic"}) {
    const auto make_block = [scheme](KernelLevel level) {
      const std::string name = std::string("mpm/") + scheme + "/herschel-bulkley/float";
      return std::make_shared<Block<Real>>(bench_scene(name, kPoints), level);
    };
    const std::string end = std::string("/") + scheme + "/" + precision_name<Real>();
    cases.push_back({"mpm/scatter" + end, [make_block](KernelLevel level) {
                       const auto block = make_block(level);
                       return KernelWork{block->count(), [block] { block->scatter(); }};
                     }});
    cases.push_back({"mpm/gather" + end, [make_block](KernelLevel level) {
                       const auto block = make_block(level);
                       block->shear_grid();
                       return KernelWork{block->count(), [block] { block->gather(); }};
                     }});
  }
}

/// A law's own parameters; all are as stiff as the foam of the bench.
std::vector<std::pair<std::string, Law>> laws() {
  const HerschelBulkleyParameters foam = {1000, 1e5, 1e3, 1e-3, 10, 0.5};
  HerschelBulkleyParameters elastic = foam;
  elastic.yield_stress = 1e9;
  const NeoHookeanParameters jelly = {{1000, 1e5, 0.3}, {}};
  DruckerPragerParameters sand;
  sand.elastic = jelly.elastic;
  sand.friction_angle_deg = 30;
  SnowParameters snow;
  snow.elastic = jelly.elastic;
  LiquidParameters water;
  water.density = 1000;
  water.bulk_modulus = 1e5;
  return {{"herschel-bulkley", foam}, {"elastic", elastic}, {"neo-hookean", jelly},
          {"drucker-prager", sand},   {"snow", snow},       {"liquid", water}};
}

template <class Real>
void add_laws(std::vector<KernelCase>& cases) {
  for (const auto& [name, law] : laws()) {
    const auto make_block = [own = law](KernelLevel level) {
      Scene scene = bench_scene("mpm/quadratic/apic/herschel-bulkley/float", kPoints);
      scene.materials.front() = study::material_of(own);
      return std::make_shared<Block<Real>>(scene, level);
    };
    const std::string end = "/" + name + "/" + precision_name<Real>();
    cases.push_back({"law/stress" + end, [make_block](KernelLevel level) {
                       const auto block = make_block(level);
                       return KernelWork{kTile, [block] { block->stress(); }};
                     }});
    cases.push_back({"law/deform" + end, [make_block](KernelLevel level) {
                       const auto block = make_block(level);
                       return KernelWork{kTile, [block] { block->deform(); }};
                     }});
  }
}

}  // namespace

void add_mpm_cases(std::vector<KernelCase>& cases) {
  add_transfers<float>(cases);
  add_transfers<double>(cases);
  add_laws<float>(cases);
  add_laws<double>(cases);
}

}  // namespace lather::bench
