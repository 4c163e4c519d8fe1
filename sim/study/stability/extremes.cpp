#include "sim/study/stability/extremes.h"

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "sim/plan/step_bound.h"

namespace lather::study {
namespace {

constexpr int kFrames = 10;
constexpr double kFastest = 1e6;  // m/s, that a scene allows

std::vector<Factor> material_factors(Solver solver, const std::string& model) {
  const auto of_material = [](const char* key, std::vector<Value> levels) {
    return Factor{std::string("/materials/0/") + key, std::move(levels)};
  };
  std::vector<Factor> factors = {of_material("density", {1e-3, 1000.0, 2e4})};
  const auto add = [&](std::vector<Factor> more) {
    std::move(more.begin(), more.end(), std::back_inserter(factors));
  };
  const auto add_elastic = [&] {
    add({of_material("youngs_modulus", {100.0, 1e5, 2e11}),
         of_material("poisson_ratio", {0.0, 0.3, 0.4999})});
  };
  const auto add_viscous = [&] {
    add({of_material("viscosity", {0.0, 1.0, 1e9}), of_material("bulk_viscosity", {0.0, 1e9})});
  };
  if (model == "herschel-bulkley")
    add({of_material("bulk_modulus", {100.0, 1e5, 2e11}),
         {"shear_over_bulk", {1e-6, 1e-2, 1e3}},
         of_material("yield_stress", {0.0, 30.0, 1e9}),
         of_material("viscosity", {0.0, 10.0, 1e9}),
         of_material("flow_index", {0.05, 1.0, 10.0})});
  if (model == "herschel-bulkley" && solver == Solver::kMpm)
    add({of_material("tear_threshold", {"infinity", 0.3}), of_material("recovery_time", {"infinity", 0.25})});
  if (model != "herschel-bulkley" && model != "liquid") add_elastic();
  if (model == "liquid")
    add({of_material("bulk_modulus", {100.0, 1e5, 2e11}), of_material("exponent", {1.0, 7.0, 100.0})});
  if (model != "herschel-bulkley" && model != "snow") add_viscous();
  if (model == "drucker-prager")
    add({of_material("friction_angle_deg", {0.0, 30.0, 89.0}), of_material("cohesion", {0.0, 0.1, 100.0})});
  if (model == "snow")
    add({of_material("critical_compression", {0.0, 0.025, 0.9}),
         of_material("critical_stretch", {0.0, 0.0075, 100.0})});
  if (model == "drucker-prager" || model == "snow") add({of_material("hardening", {0.0, 10.0, 1000.0})});
  return factors;
}

std::vector<Factor> numerics_factors(Solver solver, const std::string& model) {
  std::vector<Value> integrations = {"explicit"};
  if (model == "herschel-bulkley") integrations.emplace_back("semi-implicit");
  if (solver == Solver::kMpm)
    return {{"/numerics/kernel", {"quadratic", "cubic"}},
            {"/numerics/transfer", {"flip", "apic"}},
            {"/numerics/flip_blend", {0.0, 0.95, 1.0}},
            {"/numerics/integration", std::move(integrations)}};
  return {{"/numerics/mlsrk/basis", {"constant", "linear", "quadratic"}},
          {"/numerics/mlsrk/kernel_shape", {"tensor", "radial"}},
          {"/numerics/mlsrk/support_radius", {1.5, 3.0, 4.0}},
          {"/numerics/mlsrk/regularization", {0.0, 1e-3, 1.0}},
          {"/numerics/mlsrk/velocity_blend", {0.0, 0.95, 1.0}},
          {"/numerics/mlsrk/inertial_mass", {"lumped", "own"}},
          {"/numerics/mlsrk/volume_correction", {true, false}}};
}

Array vector_of(const Vec3& v, int dimension) {
  Array numbers;
  for (int axis = 0; axis < dimension; ++axis) numbers.emplace_back(v[axis]);
  return numbers;
}

double number_in(const Value& level) {
  return std::get<double>(level.data);
}

}  // namespace

const std::vector<std::string>& extreme_models() {
  static const std::vector<std::string> kModels = {"herschel-bulkley", "neo-hookean", "drucker-prager",
                                                   "snow", "liquid"};
  return kModels;
}

std::vector<Factor> extreme_factors(Solver solver, const std::string& model) {
  std::vector<Factor> factors = {{"/dimension", {std::int64_t{2}, std::int64_t{3}}},
                                 {"/numerics/precision", {"float", "double"}},
                                 {"spacing", {1e-6, 0.01, 1000.0}},
                                 {"gravities", {0.0, 1.0, 1000.0}},
                                 {"mach", {0.0, 0.1, 1.0}},
                                 {"/numerics/safety_factor", {0.1, 0.4, 1.0}},
                                 {"floor", {0.0, 0.5, 10.0, "adhesive"}},
                                 {"/domain/boundary", {"slip", "stick", "open"}}};
  for (std::vector<Factor> more : {numerics_factors(solver, model), material_factors(solver, model)})
    std::move(more.begin(), more.end(), std::back_inserter(factors));
  return factors;
}

Value extreme_scene(Solver solver, const std::string& model, const std::vector<Factor>& factors,
                    const Choice& choice, int steps) {
  const auto level = [&](const std::string& name) -> const Value& {
    for (std::size_t f = 0;; ++f)
      if (factors.at(f).name == name) return factors[f].levels.at(static_cast<std::size_t>(choice.at(f)));
  };
  const auto dimension = static_cast<int>(std::get<std::int64_t>(level("/dimension").data));
  const double h = number_in(level("spacing"));
  const auto vector = [&](const Vec3& v) { return vector_of(v, dimension); };
  const Object box = {
      {"type", "box"}, {"size", vector(Vec3::Constant(6 * h))}, {"translate", vector(Vec3::Constant(5 * h))}};
  const Object floor = {{"type", "plane"}, {"translate", vector({0, h, 0})}};
  Value scene =
      Object{{"lather", std::int64_t{1}},
             {"solver", solver == Solver::kMpm ? "mpm" : "mlsrk"},
             {"dimension", std::int64_t{dimension}},
             {"domain", Object{{"min", vector(Vec3::Zero())}, {"max", vector(Vec3::Constant(12 * h))}}},
             {"gravity", vector({0, -9.81 * number_in(level("gravities")), 0})},
             {"duration", 1e6},
             {"frame_rate", 1e-3},
             {"spacing", h},
             {"materials", Array{Object{{"name", "extreme"}, {"model", model}}}},
             {"bodies", Array{Object{{"name", "block"}, {"material", "extreme"}, {"shape", box}}}},
             {"obstacles", Array{Object{{"name", "floor"}, {"shape", floor}}}}};
  for (std::size_t f = 0; f < factors.size(); ++f)
    if (factors[f].name.front() == '/')
      set_at_pointer(scene, factors[f].name, factors[f].levels.at(static_cast<std::size_t>(choice[f])));
  const Value& hold = level("floor");
  if (hold.text() != nullptr)
    set_at_pointer(scene, "/obstacles/0/adhesive", true);
  else
    set_at_pointer(scene, "/obstacles/0/friction", hold);
  if (model == "herschel-bulkley") {
    const double bulk = std::get<double>(at_pointer(scene, "/materials/0/bulk_modulus")->data);
    set_at_pointer(scene, "/materials/0/shear_modulus", bulk * number_in(level("shear_over_bulk")));
  }
  const Scene still = parse_scene(write_json(scene));
  const double speed = std::min(number_in(level("mach")) * wave_speed(still.materials.front().law), kFastest);
  set_at_pointer(scene, "/bodies/0/velocity", vector({0.6 * speed, -0.8 * speed, 0}));
  const double duration = steps * planned_step(still, step_bound(still));
  set_at_pointer(scene, "/duration", duration);
  set_at_pointer(scene, "/frame_rate", kFrames / duration);
  return scene;
}

}  // namespace lather::study
