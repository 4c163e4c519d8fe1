#include <cstdio>
#include <string>

#include "server/command/commands.h"
#include "server/command/scene_source.h"
#include "server/run/budget.h"
#include "sim/plan/plan.h"
#include "sim/scene/quality.h"

namespace lather::server {
namespace {

void row(const char* name, const std::string& value) {
  std::printf("%-14s %s\n", name, value.c_str());
}

std::string bytes_text(double bytes) {
  static constexpr const char* kUnits[] = {"B", "KiB", "MiB", "GiB", "TiB"};
  int unit = 0;
  while (bytes >= 1024 && unit < 4) {
    bytes /= 1024;
    ++unit;
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %s", bytes, kUnits[unit]);
  return text;
}

std::string quantity(double value, const char* unit) {
  char text[48];
  std::snprintf(text, sizeof text, "%.4g %s", value, unit);
  return text;
}

void print_material(const PlannedMaterial& material) {
  std::printf("\nmaterial %s: %llu points, %d bytes each, sound %.4g m/s\n", material.name.c_str(),
              static_cast<unsigned long long>(material.points), material.bytes_per_point,
              material.wave_speed);
  if (material.own_viscosity > 0 || material.numerical_viscosity > 0)
    std::printf("  viscosity: own %.3g Pa s at 1/s, of the blend %.3g, of the time step %.3g\n",
                material.own_viscosity, material.numerical_viscosity, material.step_viscosity);
  for (const PlannedField& field : material.fields)
    std::printf("  %-24s %3d bytes\n", field.name.c_str(), field.bytes);
}

void print_quality(const Plan& plan) {
  row("quality", quality_point(plan.scene.solver, plan.chosen_quality()).name);
  for (const QualityKey& key : plan.quality)
    std::printf("  %-32s %s%s\n", key.pointer.c_str(), key.value.c_str(),
                key.kept ? "" : " (the scene's own)");
  if (!plan.choices.budget) return;
  const BudgetChoice& choice = *plan.choices.budget;
  row("predicted",
      quantity(choice.seconds, "s") + ", largest error on exact cases " + quantity(choice.error, ""));
}

void print_plan(const Plan& plan) {
  const Output& output = plan.scene.output;
  row("scene", plan.scene.name);
  row("kernels", to_string(plan.choices.kernel_level));
  row("points", std::to_string(plan.points));
  row("frames", std::to_string(plan.frames) + " of " + std::to_string(output.width) + " x " +
                    std::to_string(output.height) + " pixels");
  row("time step", quantity(plan.time_step, "s") + " (bound " + quantity(plan.step_bound, "s)"));
  row("steps", std::to_string(plan.steps));
  row("points x steps", quantity(static_cast<double>(plan.points) * static_cast<double>(plan.steps), ""));
  row("memory", bytes_text(static_cast<double>(plan.memory_bytes)));
  if (!plan.quality.empty()) print_quality(plan);
  for (const PlannedMaterial& material : plan.materials) print_material(material);
  std::printf("\nstages of a step\n");
  for (const std::string& stage : plan.stages) std::printf("  %s\n", stage.c_str());
  for (const std::string& warning : plan.warnings) std::printf("\nwarning: %s\n", warning.c_str());
}

}  // namespace

int plan_command(const PlanOptions& options) {
  const Plan plan = plan_in_budget(read_scene(options.scene), 0, "auto");
  if (options.json)
    std::printf("%s\n", to_json(plan).c_str());
  else
    print_plan(plan);
  return 0;
}

}  // namespace lather::server
