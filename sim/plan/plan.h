#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/kernel_level.h"
#include "sim/scene/scene.h"

/// Scene -> Plan: everything that is derived before a run, resolved once and stored with the job.
namespace lather {

/// The quality that a budget came to, and what it promises.
struct BudgetChoice {
  Quality quality = Quality::kOwn;
  double seconds = 0;  ///< that the run should take, wall clock, on the machine and threads it was chosen for
  double error = 0;    ///< largest error of the quality on exact cases, dimensionless
};

/// What is chosen at submission beyond the scene.
struct Choices {
  KernelLevel kernel_level = best_kernel_level();
  std::optional<BudgetChoice> budget = std::nullopt;  ///< where the scene has one
};

/// One key of the numerics that the scene's quality has a say in.
struct QualityKey {
  std::string pointer;  ///< e.g. "/numerics/kernel"
  std::string value;    ///< in use, JSON
  bool kept = true;     ///< false: the scene says otherwise than the quality, and wins
};

struct PlannedField {
  std::string name;
  int bytes = 0;  ///< per particle
};

struct PlannedMaterial {
  std::string name;
  std::uint64_t points = 0;          ///< at the start and emitted over the run
  std::uint64_t points_emitted = 0;  ///< of them, by emitters
  std::vector<PlannedField> fields;
  int bytes_per_point = 0;         ///< of a full tile, padding included, over its 16 lanes
  double wave_speed = 0;           ///< m/s
  double own_viscosity = 0;        ///< of the law at a shear rate of 1/s, Pa s; 0 where it is no fluid
  double numerical_viscosity = 0;  ///< of the blend of velocities at the planned step, Pa s; 0 with APIC
  double step_viscosity = 0;       ///< of the time step itself, Pa s; see step_viscosity()
};

struct Plan {
  Scene scene;
  Choices choices;

  std::vector<QualityKey> quality;  ///< none: the scene names no quality
  std::vector<PlannedMaterial> materials;
  std::vector<std::string> stages;   ///< in the order in which they run, by the names of the report
  std::vector<std::string> scalars;  ///< point scalars that every frame carries
  int frames = 0;                    ///< pictures: last_frame + 1
  double step_bound = 0;             ///< s: spacing / wave speed, without the safety factor
  double time_step = 0;              ///< s: planned (an automatic step shrinks when points are fast)
  std::uint64_t steps = 0;           ///< expected
  std::uint64_t points = 0;          ///< all materials, at the start and emitted over the run
  std::uint64_t points_emitted = 0;  ///< of them, by emitters
  std::uint64_t memory_bytes =
      0;  ///< expected peak: particles, their sorted copy, grid, block buffers, frame
  std::vector<std::string> warnings;

  /// The one that its budget came to, else the scene's own.
  [[nodiscard]] Quality chosen_quality() const {
    return choices.budget ? choices.budget->quality : scene.quality;
  }
};

/// Throws InputError when the scene cannot be planned (a body without points, a level the machine lacks, …).
[[nodiscard]] Plan make_plan(const Scene& scene, const Choices& choices = {});

/// Scene, the bytes of its meshes (base64), choices and all derived numbers. read_plan() takes scene, meshes
/// and choices from it and derives the rest anew.
[[nodiscard]] std::string to_json(const Plan& plan);
[[nodiscard]] Plan read_plan(std::string_view json);

/// The scene of a plan, changed by overrides (pointers into the scene). Needs no kernels, so any machine can
/// draw what another one simulated.
[[nodiscard]] Scene read_plan_scene(std::string_view json, const std::vector<Override>& overrides = {});

/// The plan's JSON with that changed scene in place of its own; its numbers stay those of the run.
[[nodiscard]] std::string with_changed_scene(std::string_view json, const std::vector<Override>& overrides);

}  // namespace lather
