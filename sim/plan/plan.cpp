#include "sim/plan/plan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/plan/planned_fields.h"
#include "sim/plan/seed.h"
#include "sim/plan/stages.h"
#include "sim/plan/step_bound.h"
#include "sim/plan/void_search.h"

namespace lather {
namespace {

std::string number(double value, const char* unit) {
  char text[64];
  std::snprintf(text, sizeof text, "%.3g %s", value, unit);
  return text;
}

TileLayout layout_of(const Scene& scene, const std::vector<Field>& fields) {
  return scene.numerics.precision == Precision::kFloat ? make_layout<float>(scene.dimension, fields)
                                                       : make_layout<double>(scene.dimension, fields);
}

std::vector<std::string> planned_stages(const Scene& scene) {
  std::vector<std::string> stages;
  const bool walls =
      scene.domain.boundary != Boundary::kOpen && !(scene.domain.periodic[0] && scene.domain.periodic[1] &&
                                                    (scene.dimension == 2 || scene.domain.periodic[2]));
  const bool contact = walls || !scene.obstacles.empty();
  const auto any_material = [&](bool (TearingParameters::*property)() const) {
    return std::any_of(scene.materials.begin(), scene.materials.end(),
                       [&](const Material& m) { return (m.tearing.*property)(); });
  };
  const bool tears = any_material(&TearingParameters::tears);
  const bool recovers = any_material(&TearingParameters::recovers);
  const bool semi_implicit = scene.numerics.integration == Integration::kSemiImplicit;
  for (int i = 0; i < kStageCount; ++i) {
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

/// Upper end of what a run takes: points twice (sorting), block buffers and grid, a frame and its neighbour
/// in the queue.
std::uint64_t expected_memory(const Plan& plan) {
  const Scene& s = plan.scene;
  const double real = s.numerics.precision == Precision::kFloat ? 4 : 8;
  // Resampling adds points: the paper's scenes grow by up to a third.
  const double points = (s.numerics.resampling ? 1.5 : 1.0) * static_cast<double>(plan.points);
  double particles = 0;
  for (const PlannedMaterial& m : plan.materials)
    particles += static_cast<double>(m.points) * m.bytes_per_point;
  particles *= points / static_cast<double>(plan.points);
  const double points_per_block = std::pow(4, s.dimension) * s.points_per_cell;
  // Half as many blocks again as a full packing needs, and a shell of grid blocks around them.
  const double blocks = 1.5 * points / points_per_block + 27;
  const double quads = s.numerics.transfer == Transfer::kApic ? 1 : 2;
  const double buffers = blocks * quads * 4 * real * (std::pow(8, s.dimension) + 4);
  const double vectors = s.numerics.integration == Integration::kSemiImplicit ? 4 : 0;  // the solver's
  const double grid = 3 * blocks * (quads + vectors) * 4 * real * std::pow(4, s.dimension);
  const double resampling = s.numerics.resampling ? 60 * points : 0;  // the points' bins, distances
  double cells = 1;
  for (int a = 0; a < s.dimension; ++a) cells *= s.domain.box.extent()[a] / s.spacing;
  const double voids = std::min(cells, kMostSearchedCells);
  const double frame = 3.0 * points * (29 + 4 * static_cast<double>(plan.scalars.size()));
  // The skin's grid and mesh by its area, at the most that of loose points; files are made one at a time.
  const double skin = s.wants_skin() ? 600.0 * points : 0;
  const double files = s.output.particles.empty() ? 0 : 200.0 * points;
  const double samples =
      static_cast<double>(s.output.width) * s.output.height * s.output.supersampling * s.output.supersampling;
  return static_cast<std::uint64_t>(2.2 * particles + buffers + grid + frame + resampling + voids + skin +
                                    files + samples * 60 + 128e6);
}

void warn(Plan& plan) {
  const Scene& s = plan.scene;
  for (PlannedMaterial& m : plan.materials) {
    const auto at = std::find_if(s.materials.begin(), s.materials.end(),
                                 [&](const Material& x) { return x.name == m.name; });
    const HerschelBulkleyParameters& law = at->herschel_bulkley;
    // A flow curve has a viscosity of its own only where it is Newtonian; elsewhere compare at a shear rate
    // of 1/s.
    if (law.viscosity > 0 && m.numerical_viscosity > law.viscosity)
      plan.warnings.push_back(
          "Material \"" + m.name + "\": the FLIP/PIC blend adds a viscosity of " +
          number(m.numerical_viscosity, "Pa s") + ", more than the material's own (" +
          number(law.viscosity, "Pa s at 1/s") +
          "); use \"transfer\": \"apic\" or a flip_blend closer to 1 where flow matters.");
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
  if ((s.look.color_by == "plasticity" || s.look.color_by == "weak") && !tears)
    plan.warnings.push_back("Points are coloured by \"" + s.look.color_by +
                            "\", which is 0 everywhere: no material has a finite tear_threshold.");
  if (s.numerics.integration == Integration::kExplicit && s.numerics.time_step > plan.step_bound)
    plan.warnings.push_back("The fixed time step, " + number(s.numerics.time_step, "s") +
                            ", is longer than a pressure wave takes through a cell, " +
                            number(plan.step_bound, "s") +
                            ": the run will probably end with a runaway state.");
}

}  // namespace

std::vector<std::string> planned_scalars(const Scene& scene) {
  std::vector<std::string> scalars;
  if (scene.look.color_by != "material") scalars.push_back(scene.look.color_by);
  for (const std::string& name : scene.output.scalars)
    if (name != scene.look.color_by) scalars.push_back(name);
  return scalars;
}

std::vector<Field> planned_fields(const Scene& scene, const Material& material) {
  std::vector<Field> fields = {Field::kFraction,      Field::kVelocity, Field::kVolumeChange,
                               Field::kElasticStrain, Field::kId,       Field::kCell};
  if (scene.numerics.transfer == Transfer::kApic) fields.push_back(Field::kAffine);
  const std::vector<std::string> scalars = planned_scalars(scene);
  if (std::find(scalars.begin(), scalars.end(), "plastic_strain") != scalars.end())
    fields.push_back(Field::kPlasticStrain);
  if (scene.numerics.resampling) fields.push_back(Field::kShare);
  if (material.tearing.tears()) {
    fields.push_back(Field::kDeformation);
    fields.push_back(Field::kPlasticity);
  }
  return fields;
}

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
  const double per_frame = steps_for(frame_span, planned_step(scene));
  plan.time_step = frame_span / per_frame;
  plan.steps = static_cast<std::uint64_t>(per_frame * scene.last_frame());
  plan.scalars = planned_scalars(scene);

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
    m.wave_speed = wave_speed(scene.materials[i].herschel_bulkley);
    const double density = scene.materials[i].herschel_bulkley.density;
    m.numerical_viscosity = blend_viscosity(scene, density, plan.time_step);
    if (scene.numerics.integration == Integration::kSemiImplicit)
      m.numerical_viscosity += density * missing_diffusion(scene, plan.time_step);
    plan.points += m.points;
    plan.points_emitted += m.points_emitted;
    plan.materials.push_back(std::move(m));
  }
  plan.stages = planned_stages(scene);
  plan.memory_bytes = expected_memory(plan);
  warn(plan);
  return plan;
}

}  // namespace lather
