#include <cmath>

#include "sim/plan/step_bound.h"
#include "sim/study/bench/bench.h"
#include "sim/study/scene_parts.h"

namespace lather::study {
namespace {

constexpr double kSpacing = 0.01;  // m
constexpr double kRate = 10;       // 1/s, of the shear that all bodies start with

/// A foam that yields from its first step on: its shear stress grows by a thousandth of the modulus a step.
constexpr HerschelBulkleyParameters kFoam = {100, 1e5, 1e3, 1e-3, 10, 0.5};

constexpr double kHugeDomain = 32'000;  // cells along each axis, near the most that there can be

/// A cube (a square in 2D) of about `points` points about the origin, under shear, in a free space twice as
/// wide, or `huge`.
Scene sheared_block(Scene scene, std::uint64_t points, bool huge = false) {
  const double cells = static_cast<double>(points) / scene.points_per_cell;
  const double side = scene.spacing * std::round(std::pow(cells, 1.0 / scene.dimension));
  scene.name = "bench";
  scene.gravity = Vec3::Zero();
  const double half_width = huge ? kHugeDomain / 2 * scene.spacing : side;
  scene.domain.box = {Vec3::Constant(-half_width), Vec3::Constant(half_width)};
  scene.domain.boundary = Boundary::kOpen;
  scene.bodies.push_back(body_of(scene, box_at(Vec3::Zero(), Vec3::Constant(side))));
  scene.bodies.front().velocity_gradient(0, 1) = kRate;
  scene.numerics.time_step = planned_step(scene, step_bound(scene));
  scene.numerics.flip_blend_reference_step = scene.numerics.time_step;
  scene.numerics.mlsrk.velocity_blend_reference_step = scene.numerics.time_step;
  set_frames(scene, 1e5 * scene.numerics.time_step, 1);
  return scene;
}

Scene grid_scene(int dimension, const Law& law) {
  Scene scene;
  scene.dimension = dimension;
  scene.spacing = kSpacing;
  scene.points_per_cell = dimension == 3 ? 8 : 4;
  scene.materials.push_back(material_of(law));
  return scene;
}

Scene foam_scene(Kernel kernel = Kernel::kCubic, Transfer transfer = Transfer::kFlip) {
  Scene scene = grid_scene(3, kFoam);
  scene.numerics.kernel = kernel;
  scene.numerics.transfer = transfer;
  return scene;
}

Scene jittered_particles(int dimension, const Law& law, KernelShape shape, double support) {
  Scene scene = particle_scene("bench", kSpacing, law);
  scene.dimension = dimension;
  scene.jitter = 0.5;
  scene.numerics.precision = Precision::kFloat;
  scene.numerics.mlsrk.kernel_shape = shape;
  scene.numerics.mlsrk.support_radius = support;
  return scene;
}

constexpr NeoHookeanParameters kJelly = {{1000, 1e5, 0.3}, {}};

/// A case whose scene is `start` with the block in it.
BenchCase block(const std::string& name, const Scene& start, bool huge = false) {
  return {name, [start, huge](std::uint64_t points) { return sheared_block(start, points, huge); }};
}

std::vector<BenchCase> grid_cases() {
  std::vector<BenchCase> cases = {
      block("mpm/cubic/flip/herschel-bulkley/float", foam_scene()),
      block("mpm/cubic/apic/herschel-bulkley/float", foam_scene(Kernel::kCubic, Transfer::kApic)),
      block("mpm/quadratic/flip/herschel-bulkley/float", foam_scene(Kernel::kQuadratic)),
      block("mpm/quadratic/apic/herschel-bulkley/float", foam_scene(Kernel::kQuadratic, Transfer::kApic)),
  };
  HerschelBulkleyParameters elastic = kFoam;
  elastic.yield_stress = 1e9;
  cases.push_back(block("mpm/cubic/flip/elastic/float", grid_scene(3, elastic)));
  Scene tearing = foam_scene();
  tearing.materials.front().tearing = {1, 0.1};
  cases.push_back(block("mpm/cubic/flip/tearing/float", tearing));
  cases.push_back({"mpm/cubic/flip/resampling/float",
                   [](std::uint64_t points) {
                     Scene scene = sheared_block(foam_scene(), points);
                     scene.numerics.resampling = Resampling{50 * scene.numerics.time_step};
                     return scene;
                   },
                   50});
  cases.push_back({"mpm/cubic/flip/obstacles/float", [](std::uint64_t points) {
                     Scene scene = sheared_block(foam_scene(), points);
                     const double half = scene.domain.box.max.y() / 2;
                     Obstacle ground;
                     ground.name = "ground";
                     ground.shape = box_at({0, -1.5 * half, 0}, Vec3(4, 1.1, 4) * half);
                     ground.friction = 0.5;
                     scene.obstacles.push_back(ground);
                     scene.gravity = {0, -9.81, 0};
                     return scene;
                   }});
  Scene semi_implicit = foam_scene(Kernel::kCubic, Transfer::kApic);
  semi_implicit.numerics.integration = Integration::kSemiImplicit;
  cases.push_back(block("mpm/cubic/apic/semi-implicit/float", semi_implicit));
  cases.push_back(block("mpm/cubic/flip/huge-domain/float", foam_scene(), true));
  Scene precise = foam_scene();
  precise.numerics.precision = Precision::kDouble;
  cases.push_back(block("mpm/cubic/flip/herschel-bulkley/double", precise));
  cases.push_back(block("mpm/cubic/flip/herschel-bulkley/float/2d", grid_scene(2, kFoam)));
  return cases;
}

std::vector<BenchCase> particle_cases() {
  std::vector<BenchCase> cases;
  const auto of = [](const Law& law) { return jittered_particles(3, law, KernelShape::kTensor, 3); };
  for (const auto& [text, support] : {std::pair{"3", 3.0}, {"2.5", 2.5}, {"2", 2.0}})
    for (const auto& [shape_name, shape] :
         {std::pair{"tensor-", KernelShape::kTensor}, {"radial-", KernelShape::kRadial}})
      cases.push_back(block(std::string("mlsrk/") + shape_name + text + "/neo-hookean/float",
                            jittered_particles(3, kJelly, shape, support)));
  DruckerPragerParameters sand;
  sand.elastic = kJelly.elastic;
  sand.friction_angle_deg = 30;
  cases.push_back(block("mlsrk/tensor-3/drucker-prager/float", of(sand)));
  LiquidParameters water;
  water.density = 1000;
  water.bulk_modulus = 1e5;
  cases.push_back(block("mlsrk/tensor-3/liquid/float", of(water)));
  Scene wet = of(kJelly);
  wet.materials.front().phase = Phase{0.5, 1e-6, {}};
  cases.push_back(block("mlsrk/tensor-3/phases/float", wet));
  cases.push_back(block("mlsrk/tensor-3/huge-domain/float", of(kJelly), true));
  Scene precise = of(kJelly);
  precise.numerics.precision = Precision::kDouble;
  cases.push_back(block("mlsrk/tensor-3/neo-hookean/double", precise));
  cases.push_back(
      block("mlsrk/tensor-3/neo-hookean/float/2d", jittered_particles(2, kJelly, KernelShape::kTensor, 3)));
  return cases;
}

}  // namespace

const std::vector<BenchCase>& bench_cases() {
  static const std::vector<BenchCase> cases = [] {
    std::vector<BenchCase> all = grid_cases();
    for (BenchCase& c : particle_cases()) all.push_back(std::move(c));
    return all;
  }();
  return cases;
}

const std::vector<ScalingCase>& scaling_cases() {
  static const std::vector<ScalingCase> cases = {
      {"mpm/cubic/flip/herschel-bulkley/float", {10'000, 30'000, 100'000, 300'000, 1'000'000, 4'000'000}},
      {"mlsrk/tensor-3/neo-hookean/float", {10'000, 30'000, 100'000, 300'000, 1'000'000}}};
  return cases;
}

}  // namespace lather::study
