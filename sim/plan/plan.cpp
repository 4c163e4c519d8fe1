#include "sim/plan/plan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "sim/plan/memory.h"
#include "sim/plan/planned_fields.h"
#include "sim/plan/seed.h"
#include "sim/plan/stages.h"
#include "sim/plan/step_bound.h"
#include "sim/scene/quality.h"

namespace lather {
namespace {

/// Numbers by what they are worth: 2 and 2.0 are the same.
bool same(const Value& a, const Value& b) {
  const auto number_of = [](const Value& value) -> std::optional<double> {
    if (const auto* whole = std::get_if<std::int64_t>(&value.data)) return static_cast<double>(*whole);
    if (const auto* real = std::get_if<double>(&value.data)) return *real;
    return std::nullopt;
  };
  const std::optional<double> left = number_of(a);
  return left ? left == number_of(b) : write_json(a) == write_json(b);
}

std::string number(double value, const char* unit) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3g %s", value, unit);
  return text;
}

TileLayout layout_of(const Scene& scene, const std::vector<Field>& fields) {
  return scene.numerics.precision == Precision::kFloat ? make_layout<float>(scene.dimension, fields)
                                                       : make_layout<double>(scene.dimension, fields);
}

bool has_contact(const Scene& scene) {
  const bool walls =
      scene.domain.boundary != Boundary::kOpen && !(scene.domain.periodic[0] && scene.domain.periodic[1] &&
                                                    (scene.dimension == 2 || scene.domain.periodic[2]));
  return walls || !scene.obstacles.empty();
}

std::vector<std::string> mlsrk_stages(const Scene& scene) {
  std::vector<std::string> stages;
  for (const Stage stage : kMlsrkStages) {
    if (stage == Stage::kParticleCollisions && !has_contact(scene) && scene.grips.empty()) continue;
    if (stage == Stage::kPhases && !scene.has_phases()) continue;
    stages.emplace_back(kStageNames[static_cast<std::size_t>(stage)]);
  }
  return stages;
}

std::vector<std::string> mpm_stages(const Scene& scene) {
  std::vector<std::string> stages;
  const bool contact = has_contact(scene);
  const auto any_material = [&](bool (TearingParameters::*property)() const) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [&](const Material& m) { return (m.tearing.*property)(); });
  };
  const bool tears = any_material(&TearingParameters::tears);
  const bool recovers = any_material(&TearingParameters::recovers);
  const bool semi_implicit = scene.numerics.integration == Integration::kSemiImplicit;
  for (int i = 0; i < kMpmStageCount; ++i) {
    const auto stage = static_cast<Stage>(i);
    if (scene.emitters.empty() && stage == Stage::kEmit) continue;
    if (!contact && (stage == Stage::kGridCollisions || stage == Stage::kParticleCollisions)) continue;
    if (stage == Stage::kAvoidVoid && !scene.numerics.resampling) continue;
    if (stage == Stage::kRemoveSubgrid && !(tears && scene.numerics.subgrid_removal)) continue;
    if (!tears &&
        (stage == Stage::kDetectTearing || stage == Stage::kLimitForces || stage == Stage::kLimitDeformation))
      continue;
    if (!recovers && stage == Stage::kRecovery) continue;
    if (!semi_implicit && stage == Stage::kSolveVelocities) continue;
    stages.emplace_back(kStageNames[static_cast<std::size_t>(i)]);
  }
  return stages;
}

/// Every key that the scene's quality sets, with what the scene has there.
std::vector<QualityKey> quality_keys(const Scene& scene, Quality quality) {
  std::vector<QualityKey> keys;
  if (quality == Quality::kOwn) return keys;
  const Value document = parse_json(to_json(scene));
  const std::function<void(const Value&, const std::string&)> visit = [&](const Value& set,
                                                                          const std::string& at) {
    for (const auto& [key, value] : *set.object()) {
      const std::string pointer = at + "/" + key;
      if (value.object() != nullptr) {
        visit(value, pointer);
        continue;
      }
      const Value* used = at_pointer(document, pointer);
      keys.push_back({pointer, write_json(*used), same(*used, value)});
    }
  };
  visit(parse_json(quality_point(scene.solver, quality).numerics), "/numerics");
  return keys;
}

/// The material's viscosity at a shear rate of 1/s, Pa s: a flow curve has one of its own only where it is
/// Newtonian. 0 where the material is no fluid, or has none.
double own_viscosity(const Material& material) {
  if (const auto* foam = std::get_if<HerschelBulkleyParameters>(&material.law)) return foam->viscosity;
  if (const auto* liquid = std::get_if<LiquidParameters>(&material.law)) return liquid->viscous.viscosity;
  return 0;
}

void warn_of_numerical_viscosity(Plan& plan, const PlannedMaterial& material) {
  const double own = material.own_viscosity;
  const double numerical = material.numerical_viscosity;
  if (own == 0) return;
  if (material.step_viscosity > own)
    plan.warnings.push_back("Material \"" + material.name + "\": the time step adds a viscosity of " +
                            number(material.step_viscosity, "Pa s") + ", more than the material's own (" +
                            number(own, "Pa s at 1/s") + "); take shorter steps where flow matters.");
  if (numerical <= own) return;
  const bool grid = plan.scene.solver == Solver::kMpm;
  plan.warnings.push_back(
      "Material \"" + material.name + "\": the " + (grid ? "FLIP/PIC blend" : "blend of velocities") +
      " adds a viscosity of " + number(numerical, "Pa s") + ", more than the material's own (" +
      number(own, "Pa s at 1/s") + "); use " +
      (grid ? "\"transfer\": \"apic\" or a flip_blend closer to 1" : "a velocity_blend closer to 1") +
      " where flow matters.");
}

/// Colours by what no material has.
void warn_of_colours(Plan& plan) {
  const Scene& s = plan.scene;
  const auto none = [&](const auto& has) {
    return std::none_of(s.materials.begin(), s.materials.end(), has);
  };
  const std::string& by = s.look.color_by;
  const std::string everywhere = "Points are coloured by \"" + by + "\", which is 0 everywhere: no material ";
  if ((by == "plasticity" || by == "weak") && none([](const Material& m) { return m.tearing.tears(); }))
    plan.warnings.push_back(everywhere + "has a finite tear_threshold.");
  if (by == "plastic_strain" &&
      none([](const Material& m) { return std::holds_alternative<HerschelBulkleyParameters>(m.law); }))
    plan.warnings.push_back(everywhere + "is of the model \"herschel-bulkley\".");
  if (by == "concentration" && !s.has_phases()) plan.warnings.push_back(everywhere + "has a \"phase\".");
}

/// What the MLSRK solver takes from neighbours, the grid solver adds up step by step.
void warn_of_volumes(Plan& plan) {
  if (plan.scene.solver != Solver::kMpm) return;
  std::string names;
  for (const Material& m : plan.scene.materials)
    if (m.takes_volume_correction()) names += (names.empty() ? "\"" : ", \"") + m.name + "\"";
  if (names.empty()) return;
  plan.warnings.push_back("Volumes of " + names +
                          " follow from the deformation alone, as the solver \"mpm\" has no correction from "
                          "neighbours: what has splashed may fill too little space, or too much.");
}

void warn_of_the_step(Plan& plan) {
  const Scene& s = plan.scene;
  if (s.numerics.integration != Integration::kExplicit || s.numerics.time_step <= plan.step_bound) return;
  const char* limit = s.solver == Solver::kMpm ? "is longer than a pressure wave takes through a cell, "
                                               : "is longer than waves and viscosity allow, ";
  plan.warnings.push_back("The fixed time step, " + number(s.numerics.time_step, "s") + ", " + limit +
                          number(plan.step_bound, "s") + ": the run will probably end with a runaway state.");
}

void warn(Plan& plan) {
  const Scene& s = plan.scene;
  for (std::size_t i = 0; i < plan.materials.size(); ++i) {
    const PlannedMaterial& m = plan.materials[i];
    warn_of_numerical_viscosity(plan, m);
    if (m.points > 0 && m.points < 100)
      plan.warnings.push_back("Material \"" + m.name + "\" has only " + std::to_string(m.points) +
                              " points.");
  }
  const bool tears = std::any_of(s.materials.begin(), s.materials.end(),
                                 [](const Material& m) { return m.tearing.tears(); });
  if (s.numerics.subgrid_removal && !tears)
    plan.warnings.push_back(
        "/numerics/subgrid_removal removes nothing: only weak points go, and no material has a finite "
        "tear_threshold.");
  if (s.budget && !plan.choices.budget)
    plan.warnings.push_back("The budget is not looked at here: the numerics are the scene's own.");
  warn_of_colours(plan);
  warn_of_volumes(plan);
  warn_of_the_step(plan);
}

/// What the solver adds to a material's viscosity at the planned step, Pa s.
double numerical_viscosity(const Scene& scene, double density, double dt) {
  if (scene.solver == Solver::kMlsrk) return velocity_blend_viscosity(scene, density, dt);
  const double blend = blend_viscosity(scene, density, dt);
  return scene.numerics.integration == Integration::kSemiImplicit
             ? blend + density * missing_diffusion(scene, dt)
             : blend;
}

}  // namespace

Plan make_plan(const Scene& scene, const Choices& choices) {
  if (!machine_has(choices.kernel_level))
    throw InputError(
        {{"/choices/kernel_level", to_string(choices.kernel_level), to_string(best_kernel_level()),
          "This machine lacks the kernel level that the job was planned for; run it on one that has it."}});
  Plan plan;
  plan.scene = scene;
  plan.choices = choices;
  plan.step_bound = step_bound(scene);
  plan.frames = scene.last_frame() + 1;
  const double frame_span = 1 / scene.frame_rate;
  const double per_frame = steps_for(frame_span, planned_step(scene, plan.step_bound));
  plan.time_step = frame_span / per_frame;
  plan.steps = static_cast<std::uint64_t>(per_frame * scene.last_frame());
  plan.scalars = planned_scalars(scene);
  plan.quality = quality_keys(scene, plan.chosen_quality());

  const PointCounts points = count_points(scene);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const std::vector<Field> fields = planned_fields(scene, scene.materials[i]);
    const TileLayout layout = layout_of(scene, fields);
    PlannedMaterial m;
    m.name = scene.materials[i].name;
    m.points = points.at_start[i] + points.emitted[i];
    m.points_emitted = points.emitted[i];
    for (const Field f : fields) {
      const int at = static_cast<int>(f);
      m.fields.push_back({to_string(f), layout.components[at] * layout.component_bytes[at]});
    }
    m.bytes_per_point = layout.stride / kTile;
    m.wave_speed = wave_speed(scene.materials[i].law);
    m.own_viscosity = own_viscosity(scene.materials[i]);
    m.step_viscosity = step_viscosity(scene, scene.materials[i].law, plan.time_step);
    m.numerical_viscosity = numerical_viscosity(scene, scene.materials[i].density(), plan.time_step);
    plan.points += m.points;
    plan.points_emitted += m.points_emitted;
    plan.materials.push_back(std::move(m));
  }
  plan.stages = scene.solver == Solver::kMlsrk ? mlsrk_stages(scene) : mpm_stages(scene);
  plan.memory_bytes = expected_memory(plan);
  warn(plan);
  return plan;
}

}  // namespace lather
