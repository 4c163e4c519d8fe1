#include <memory>

#include "sim/mlsrk/step.h"
#include "sim/plan/planned_fields.h"
#include "sim/plan/seed.h"
#include "tests/bench/kernels/kernel_case.h"

namespace lather::bench {
namespace {

using namespace mlsrk;

constexpr std::uint64_t kPoints = 4096;
constexpr double kRate = 10;      // 1/s, of the shear that all points are in
constexpr double kStress = 1000;  // Pa

/// The tile with most other tiles around it of a cloud of jittered points under uniform stress and shear, and
/// what its kernels read of the other tiles.
template <class Real>
class Tile {
 public:
  Tile(const Scene& scene, KernelLevel level)
      : plan_(make_plan(scene, Choices{level})), model_(plan_), cloud_(scene) {
    std::vector<ParticleSet<Real>> sets;
    sets.emplace_back(scene.dimension, planned_fields(scene, scene.materials.front()), scene.domain.box.min,
                      scene.spacing);
    seed_points(scene,
                [&](const Seed& s) { sets.front().add(s.position, s.velocity, s.velocity_gradient, s.id); });
    (void)sets.front().sort(model_.bounds, 1);
    sets.front().order_within_blocks(1);
    cloud_.build(sets, model_.bounds);
    cloud_.refresh(sets, 1);
    for (std::uint32_t slot = 0; slot < cloud_.slots(); ++slot)
      cloud_.put_volume(slot, static_cast<Real>(scene.point_volume()));

    std::int32_t most = -1;
    for (std::size_t t = 0; t < cloud_.tiles().size(); ++t) {
      const Surroundings<Real> around = cloud_.around(t, scratch_);
      std::int32_t near = 0;
      for (std::int32_t n = 0; n < around.block_count; ++n) near += around.blocks[n].tiles;
      if (near > most) most = near, tile_ = t;
    }
    fill_rows(scene);
    step_ = {static_cast<Real>(scene.numerics.time_step), {}, static_cast<Real>(1 / cloud_.scale()), false};
  }

  [[nodiscard]] std::int64_t count() const { return cloud_.tiles()[tile_].count; }

  void shape_functions() { shape_functions_of(tile_); }
  void momentum() {
    Real lumped[kTile];
    Real rows[kTile * kVelocityRows];
    std::copy_n(velocity_.data() + tile_ * kTile * kVelocityRows, kTile * kVelocityRows, rows);
    model_.kernels.momentum(step_, cloud_.around(tile_, scratch_), shape_.data(), stress_.data(), rows,
                            lumped);
  }
  void gradients() {
    Real gradient[9 * kTile];
    Real smooth[3 * kTile];
    model_.kernels.gradients(model_.shape, step_.inverse_scale, cloud_.around(tile_, scratch_),
                             own_shape(tile_), velocity_.data(), gradient, smooth);
  }

 private:
  [[nodiscard]] Real* own_shape(std::size_t tile) {
    return shape_.data() + tile * kTile * static_cast<std::size_t>(model_.kernels.shape_reals);
  }
  void shape_functions_of(std::size_t tile) {
    Real crowding[kTile];
    Real fallen[kTile];
    model_.kernels.shape_functions(model_.shape, cloud_.around(tile, scratch_), own_shape(tile), crowding,
                                   fallen);
  }

  void fill_rows(const Scene& scene) {
    const auto mass = static_cast<Real>(scene.materials.front().density() * scene.point_volume());
    velocity_.assign(cloud_.slots() * kVelocityRows, Real(0));
    stress_.assign(cloud_.slots() * kStressReals, Real(0));
    for (std::uint32_t slot = 0; slot < cloud_.slots(); ++slot) {
      Real* velocity = velocity_.data() + slot / kTile * kTile * kVelocityRows + slot % kTile;
      velocity[0] = static_cast<Real>(kRate * cloud_.position(slot).y());
      velocity[3 * kTile] = mass;
      Real* stress = stress_.data() + slot * kStressReals;
      std::fill_n(stress, 6, static_cast<Real>(kStress * scene.point_volume()));
      stress[kStressReals - 1] = mass;
    }
    shape_.assign(cloud_.slots() * static_cast<std::size_t>(model_.kernels.shape_reals), Real(0));
    for (std::size_t t = 0; t < cloud_.tiles().size(); ++t) shape_functions_of(t);
  }

  Plan plan_;
  Model<Real> model_;
  Cloud<Real> cloud_;
  typename Cloud<Real>::Scratch scratch_;
  std::size_t tile_ = 0;
  MomentumStep<Real> step_{};
  std::vector<Real> velocity_;
  std::vector<Real> stress_;
  std::vector<Real> shape_;
};

template <class Real>
void add_tile(std::vector<KernelCase>& cases, const std::string& kernel) {
  const std::pair<const char*, void (Tile<Real>::*)()> works[] = {
      {"shape-functions", &Tile<Real>::shape_functions},
      {"momentum", &Tile<Real>::momentum},
      {"gradients", &Tile<Real>::gradients}};
  for (const auto& [name, work] : works)
    cases.push_back({std::string("mlsrk/") + name + "/" + kernel + "/" + precision_name<Real>(),
                     [kernel, work = work](KernelLevel level) {
                       const Scene scene = bench_scene("mlsrk/" + kernel + "/neo-hookean/float", kPoints);
                       const auto tile = std::make_shared<Tile<Real>>(scene, level);
                       return KernelWork{tile->count(), [tile, work] { ((*tile).*work)(); }};
                     }});
}

}  // namespace

void add_mlsrk_cases(std::vector<KernelCase>& cases) {
  for (const char* kernel : {"tensor-3", "radial-3", "tensor-2.5", "radial-2.5"})
    add_tile<float>(cases, kernel);
  add_tile<double>(cases, "tensor-3");
}

}  // namespace lather::bench
